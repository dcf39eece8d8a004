#include "wordgaze/evaluation/faithfulness.hpp"

#include <gtest/gtest.h>

#include "evaluation/one_decision.hpp"

namespace wordgaze::evaluation {
namespace {

using Cells = Change::Cells;
using Kind = Change::Test;

/// An agent that sees one cell only, and a map that says so or points elsewhere.
Faithfulness measure(std::size_t pointed, Role elsewhere = Role::empty) {
  test::OneDecision at(false);
  at.see_only(test::kCellInFront);
  const auto decision = at.decide(2);
  core::Rng rng(1);
  std::array<float, grid::kViewCells> map{};
  map[pointed] = 1;
  Roles roles;
  roles.fill(elsewhere);
  Faithfulness faithfulness;
  faithfulness.add(shifts(decision, map, roles, rng));
  return faithfulness;
}

TEST(Faithfulness, OfAMapThatNamesTheOnlyCellThatMattersIsPerfect) {
  const auto faithfulness = measure(test::kCellInFront);
  EXPECT_GT(faithfulness.of(Kind::deletion, Cells::brightest, 1).value(), 1e-3);
  EXPECT_NEAR(faithfulness.of(Kind::deletion, Cells::others, 1).value(), 0, 1e-6);
  EXPECT_NEAR(faithfulness.of(Kind::deletion, Cells::others, 4).value(), 0, 1e-6);
  EXPECT_NEAR(faithfulness.of(Kind::insertion, Cells::brightest, 1).value(), 0, 1e-6);
  // Without the cell that matters, keeping others is the same as blanking it.
  EXPECT_NEAR(faithfulness.of(Kind::insertion, Cells::others, 1).value(),
              faithfulness.of(Kind::deletion, Cells::brightest, 1).value(), 1e-6);
}

TEST(Faithfulness, OfAMapThatNamesAnotherCellIsNone) {
  const auto faithfulness = measure(0);
  EXPECT_NEAR(faithfulness.of(Kind::deletion, Cells::brightest, 1).value(), 0, 1e-6);
  EXPECT_GT(faithfulness.of(Kind::insertion, Cells::brightest, 1).value(), 1e-3);
}

TEST(Faithfulness, LeavesOutChangesForWantOfCells) {
  const auto faithfulness = measure(test::kCellInFront, Role::unseen);
  for (const int k : kDeletedCells) {
    EXPECT_EQ(faithfulness.of(Kind::deletion, Cells::brightest, k).count, 1);
    EXPECT_EQ(faithfulness.of(Kind::deletion, Cells::others, k).count, 0);
    EXPECT_EQ(faithfulness.of(Kind::deletion, Cells::objects, k).count, 0);
  }
}

TEST(Faithfulness, RefusesNumbersOfCellsThatAreNotMeasured) {
  EXPECT_THROW(Faithfulness{}.of(Kind::deletion, Cells::brightest, 49), std::invalid_argument);
}

}  // namespace
}  // namespace wordgaze::evaluation
