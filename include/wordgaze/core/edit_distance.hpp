#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string_view>
#include <utility>
#include <vector>

namespace wordgaze {

/// Number of insertions, deletions and replacements of one character that turn `a` into `b`:
/// how far a name is from one that is known, for "did you mean ...?". What a text has more than a
/// long name counts in full: the work is bounded.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  constexpr std::size_t kLongestName = 100;
  const std::string_view begin_of_a = a.substr(0, kLongestName);
  const std::string_view begin_of_b = b.substr(0, kLongestName);
  const std::size_t excess = a.size() - begin_of_a.size() + b.size() - begin_of_b.size();
  if (excess > 0) return excess + edit_distance(begin_of_a, begin_of_b);
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

}  // namespace wordgaze
