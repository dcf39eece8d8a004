#include "level_table.hpp"

#include "generators.hpp"

namespace wordgaze::babyai {

using namespace generators;  // the column of names below

std::span<const LevelSpec> level_table() {
  static const std::vector<LevelSpec> table{
      {.id = "BabyAI-GoToLocal-v0", .generate = go_to_local, .rows = 1, .columns = 1, .objects = 8},
  };
  return table;
}

}  // namespace wordgaze::babyai
