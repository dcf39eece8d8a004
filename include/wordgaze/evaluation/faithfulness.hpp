#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "wordgaze/core/rng.hpp"
#include "wordgaze/evaluation/decision_observer.hpp"
#include "wordgaze/evaluation/mean.hpp"
#include "wordgaze/evaluation/roles.hpp"

namespace wordgaze::evaluation {

/// One way to change a view: blank some cells, or all but them.
struct Change {
  enum class Test : std::uint8_t { deletion, insertion };
  enum class Cells : std::uint8_t {
    brightest,  ///< the k brightest of the map
    others,     ///< k random ones of the other cells that are seen
    objects,    ///< k random ones of the other objects
  };
  Test test;
  Cells cells;
  int count;  ///< k
};

inline constexpr std::array<int, 2> kDeletedCells{1, 4};
/// All of them, by test, then k, then cells.
inline constexpr auto kChanges = [] {
  std::array<Change, 12> changes{};
  std::size_t i = 0;
  for (const auto test : {Change::Test::deletion, Change::Test::insertion}) {
    for (const int count : kDeletedCells) {
      for (const auto cells :
           {Change::Cells::brightest, Change::Cells::others, Change::Cells::objects}) {
        changes[i++] = {test, cells, count};
      }
    }
  }
  return changes;
}();

/// Total variation between the policy before and after each change; NaN where a change was not
/// possible, for want of cells.
using Shifts = std::array<double, kChanges.size()>;

/// Tries all changes on a decision. Blank is the code of an unseen cell.
Shifts shifts(const DecisionContext& context, std::span<const float> map, const Roles& roles,
              core::Rng& rng);

/// Faithfulness of a map: do the cells that it calls important move the policy?
struct Faithfulness {
  std::array<Mean, kChanges.size()> shift;

  void add(const Shifts& shifts);
  const Mean& of(Change::Test test, Change::Cells cells, int count) const;
};

}  // namespace wordgaze::evaluation
