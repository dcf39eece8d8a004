#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "wordgaze/babyai/progress.hpp"

namespace wordgaze::model {

/// Which words the true mask of L_TA silences (docs/reading.md): the words of ...
enum class MaskTruth {
  completed,    ///< sub-tasks that are done: the paper's wording
  not_enabled,  ///< and of sub-tasks whose turn has not come
  current,      ///< and, where several may be done next, of all but the first
};
constexpr std::array<std::string_view, 3> names(MaskTruth) {
  return {"completed", "not_enabled", "current"};
}

/// The sub-tasks whose words stay bright, as bits: bit i is sub-task i.
inline std::uint16_t bright_sub_tasks(MaskTruth truth, const babyai::Progress& progress) {
  const auto completion = progress.completion(), enabled = progress.enabled();
  std::uint16_t bright = 0;
  for (std::size_t i = 0; i < completion.size(); ++i) {
    const bool keep = truth == MaskTruth::completed ? !completion[i] : enabled[i] != 0;
    if (!keep) continue;
    bright |= static_cast<std::uint16_t>(1u << i);
    if (truth == MaskTruth::current) break;
  }
  return bright;
}

/// The true mask of a word: 1 for bright sub-tasks.
constexpr bool is_bright(int sub_task, std::uint16_t bright) {
  return sub_task >= 0 && ((bright >> sub_task) & 1u) != 0;
}

}  // namespace wordgaze::model
