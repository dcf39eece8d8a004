#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace wordgaze::model {

/// Which words the true mask of L_TA silences (docs/reading.md): the words of ...
enum class MaskTruth {
  completed,    ///< clauses that are done: the paper's wording
  not_enabled,  ///< and of clauses whose turn has not come
  current,      ///< and, where several may be done next, of all but the first
};
constexpr std::array<std::string_view, 3> names(MaskTruth) {
  return {"completed", "not_enabled", "current"};
}

/// The clauses whose words stay bright, as bits: bit i is clause i.
inline std::uint8_t bright_clauses(MaskTruth truth, std::span<const std::uint8_t> completion,
                                   std::span<const std::uint8_t> declarable) {
  std::uint8_t bright = 0;
  for (std::size_t i = 0; i < completion.size(); ++i) {
    const bool keep = truth == MaskTruth::completed ? !completion[i] : declarable[i] != 0;
    if (!keep) continue;
    bright |= static_cast<std::uint8_t>(1u << i);
    if (truth == MaskTruth::current) break;
  }
  return bright;
}

/// The true mask of a word: 1 for bright clauses and for the words that join clauses.
constexpr bool is_bright(int clause, std::uint8_t bright) {
  return clause < 0 || ((bright >> clause) & 1u) != 0;
}

}  // namespace wordgaze::model
