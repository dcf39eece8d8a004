#include "wordgaze/policy/level_file.hpp"

#include <stdexcept>
#include <string>

#include "wordgaze/core/formatted.hpp"
#include "wordgaze/core/require.hpp"
#include "wordgaze/io/config_file.hpp"

namespace wordgaze::policy {

babyai::LevelText read_level_file(const std::filesystem::path& path) {
  auto text = io::read_config<babyai::LevelText>(path);
  if (text.id.empty()) text.id = "Own-" + path.stem().string() + "-v0";
  return text;
}

babyai::LevelSpec load_level(const std::filesystem::path& path) {
  const babyai::LevelText text = read_level_file(path);
  try {
    return babyai::level_of(text);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(formatted("{}: {}", path.string(), error.what()));
  }
}

babyai::LevelSpec level_of(std::string_view env, std::string_view text) {
  if (text.empty()) return babyai::find_level(env);
  babyai::LevelSpec level = babyai::level_of(io::parse_config<babyai::LevelText>(text, "level"));
  require(level.id == env,
          "env = '{}', but level is the text of '{}'; give another level file, or level = \"\"",
          shortened(env), level.id);
  return level;
}

}  // namespace wordgaze::policy
