#include "wordgaze/babyai/verifier.hpp"

#include <gtest/gtest.h>

#include "grid/drawn_world.hpp"
#include "wordgaze/babyai/parser.hpp"
#include "wordgaze/babyai/progress.hpp"
#include "wordgaze/grid/step.hpp"

namespace wordgaze::babyai {
namespace {

using grid::Action;
using grid::World;
using enum grid::Action;

// An instruction in a drawn world: plays actions and tells the verdicts.
class Play {
 public:
  Play(std::string_view mission, const std::vector<std::string_view>& rows,
       DoneMode mode = DoneMode::off, bool strict = false)
      : world(grid::drawn(rows)) {
    task_.instruction = parse_mission(mission);
    task_.instruction.strict = strict;
    for (Clause& clause : task_.instruction.clause) clause.strict = strict;
    task_.meaning = look_up(world, task_.instruction);
    verifier_.begin(world, task_.instruction, mode);
  }

  // The verdict on the last of some actions.
  Status operator()(std::initializer_list<Action> actions) {
    Status status = Status::none;
    for (Action action : actions) {
      step(world, action);
      if (action == drop) verifier_.refresh(world);
      status = verifier_.verify(world, task_, action);
    }
    return status;
  }

  std::vector<int> completion() const {
    return {verifier_.completion().begin(), verifier_.completion().end()};
  }
  std::vector<int> declarable() const {
    return {verifier_.declarable().begin(), verifier_.declarable().end()};
  }

  Progress in_sub_tasks() const { return progress(task_, world, verifier_); }

  World world;

 private:
  Task task_;
  Verifier verifier_;
};

TEST(Verifier, SeesTheAgentFaceItsTarget) {
  Play play("go to the red ball", {">..B"});
  EXPECT_EQ(play({forward}), Status::ongoing);
  EXPECT_EQ(play({forward}), Status::success);
  EXPECT_EQ(play.completion(), (std::vector{1}));
}

TEST(Verifier, KnowsWhereAThingStoodUntilTheNextDrop) {
  // The ball is gone from there, and still counts.
  Play play("go to the red ball and pick up the red key", {">B.K"});
  EXPECT_EQ(play({pickup}), Status::ongoing);
  EXPECT_EQ(play.completion(), (std::vector{1, 0}));
  Play stale("go to the red ball, then pick up the red key", {">B.", "..."});
  EXPECT_EQ(stale({pickup, right, right}), Status::ongoing);
}

TEST(Verifier, GoesByTheNewPlaceAfterADrop) {
  Play play("pick up the red ball, then go to the red ball", {">B.", "..."});
  EXPECT_EQ(play({pickup}), Status::success);  // it faces the place where the ball stood
  Play moved("go to the red ball", {"B>.", "..."});
  EXPECT_EQ(moved({left, left}), Status::success);
  EXPECT_EQ(moved({pickup, left}), Status::ongoing);
  EXPECT_EQ(moved({drop}), Status::success);  // looks down at it
}

TEST(Verifier, CountsAPickupWithEmptyHandsOnly) {
  Play play("pick up the red ball", {"...", "K>B"});
  play({left, left, pickup});
  EXPECT_EQ(play({right, right, pickup}), Status::ongoing);
  play({left, drop});
  EXPECT_EQ(play({right, pickup}), Status::success);
}

TEST(Verifier, CountsTheSecondPickupInTheStepOfTheFirst) {
  // Its hands before are looked at when its turn comes: empty, as far as it knows.
  Play play("pick up a ball, then pick up a red ball", {">B.b"});
  EXPECT_EQ(play({pickup}), Status::success);
}

TEST(Verifier, WantsTheObjectPutBesideTheOther) {
  Play play("put the red ball next to the red key", {"B>.K", "...."});
  play({left, left, pickup, right, right});
  EXPECT_EQ(play({drop}), Status::success);
  Play far("put the red ball next to the red key", {"B>..K", "....."});
  far({left, left, pickup, right, right});
  EXPECT_EQ(far({drop}), Status::ongoing);
}

std::vector<int> numbers(std::span<const std::uint8_t> flags) {
  return {flags.begin(), flags.end()};
}

TEST(Progress, OfPutNextIsToHaveTheObjectAndThenToPutIt) {
  Play play("put the red ball next to the red key", {"B>..K", "....."});
  const auto completion = [&] { return numbers(play.in_sub_tasks().completion()); };
  const auto enabled = [&] { return numbers(play.in_sub_tasks().enabled()); };
  EXPECT_EQ(completion(), (std::vector{0, 0}));
  EXPECT_EQ(enabled(), (std::vector{1, 0}));
  EXPECT_EQ(play.in_sub_tasks().object(0).type, grid::Type::ball);
  EXPECT_EQ(play.in_sub_tasks().object(1).type, grid::Type::key);
  play({left, left, pickup, right, right});
  EXPECT_EQ(completion(), (std::vector{1, 0}));
  EXPECT_EQ(enabled(), (std::vector{0, 1}));
  play({drop});  // not beside the key: all anew
  EXPECT_EQ(completion(), (std::vector{0, 0}));
  play({pickup, forward});
  EXPECT_EQ(play({drop}), Status::success);
  EXPECT_EQ(completion(), (std::vector{1, 1}));
  EXPECT_EQ(enabled(), (std::vector{0, 0}));
}

TEST(Progress, GoesByTheObjectInHand) {
  Play play("put the red ball next to the red key", {"K>.B"});
  play({left, left, pickup});
  EXPECT_EQ(numbers(play.in_sub_tasks().completion()), (std::vector{0, 0}));
}

TEST(Progress, CountsAnyOtherClauseAsOne) {
  Play play("put the red ball next to the red key, then pick up the red key", {"B>.K", "...."});
  EXPECT_EQ(numbers(play.in_sub_tasks().completion()), (std::vector{0, 0, 0}));
  EXPECT_EQ(numbers(play.in_sub_tasks().enabled()), (std::vector{1, 0, 0}));
  play({left, left, pickup, right, right, drop});
  EXPECT_EQ(numbers(play.in_sub_tasks().completion()), (std::vector{1, 1, 0}));
  EXPECT_EQ(numbers(play.in_sub_tasks().enabled()), (std::vector{0, 0, 1}));
}

TEST(Progress, HasTwoSubTasksForEachOfEightClauses) {
  std::string mission = "put the red ball next to the red key";
  for (int n = 1; n < 8; ++n) mission += ", then put the red ball next to the red key";
  Play play(mission, {"B>.K", "...."});
  EXPECT_EQ(play.in_sub_tasks().completion().size(), 16u);
  play({left, left, pickup, right, right, drop});
  const std::vector done = numbers(play.in_sub_tasks().completion());
  EXPECT_EQ(std::count(done.begin(), done.end(), 1), 2);
  EXPECT_EQ(numbers(play.in_sub_tasks().enabled())[2], 1);
}

TEST(Verifier, WantsADoorOpenedByToggling) {
  Play play("open the red door", {">c"});
  EXPECT_EQ(play({forward}), Status::ongoing);
  EXPECT_EQ(play({toggle}), Status::success);
  EXPECT_EQ(play({toggle}), Status::ongoing);
}

TEST(Verifier, WantsFirstWhatIsFirst) {
  Play before("go to the red ball, then go to the red key", {"K>B"});
  EXPECT_EQ(before.declarable(), (std::vector{1, 0}));
  EXPECT_EQ(before({left, left}), Status::ongoing);
  EXPECT_EQ(before.completion(), (std::vector{0, 0}));
  EXPECT_EQ(before({left, left}), Status::ongoing);
  EXPECT_EQ(before.completion(), (std::vector{1, 0}));
  EXPECT_EQ(before({left, left}), Status::success);

  Play after("go to the red ball after you go to the red key", {"K>B"});
  EXPECT_EQ(after.declarable(), (std::vector{0, 1}));
  after({left, left});
  EXPECT_EQ(after.completion(), (std::vector{0, 1}));
  EXPECT_EQ(after({left, left}), Status::success);
}

TEST(Verifier, TakesBothInAnyOrder) {
  Play play("go to the red ball and go to the red key", {"K>B"});
  EXPECT_EQ(play({left, left}), Status::ongoing);
  EXPECT_EQ(play.completion(), (std::vector{0, 1}));
  EXPECT_EQ(play.declarable(), (std::vector{1, 0}));
  EXPECT_EQ(play({left, left}), Status::success);
}

TEST(Verifier, FailsForTheWrongThingWhenStrict) {
  const bool strict = true;
  Play pick("pick up the red ball", {">bB"}, DoneMode::off, strict);
  EXPECT_EQ(pick({pickup}), Status::failure);
  Play open("open the red door", {">l"}, DoneMode::off, strict);
  EXPECT_EQ(open({toggle}), Status::failure);
  Play order("go to the red ball, then go to the red key", {"K>b", "..B"}, DoneMode::off, strict);
  EXPECT_EQ(order({left, left}), Status::failure);
  Play both("pick up the red ball and go to the red ball", {">bB"}, DoneMode::off, strict);
  EXPECT_EQ(both({pickup}), Status::ongoing);  // a failure of one of two is ignored
}

TEST(Verifier, AsksForDoneInExactMode) {
  Play early("go to the red ball", {">..B"}, DoneMode::exact);
  EXPECT_EQ(early({done}), Status::failure);
  Play play("go to the red ball", {">..B"}, DoneMode::exact);
  EXPECT_EQ(play({forward, forward}), Status::none);
  EXPECT_EQ(play({done}), Status::success);
}

TEST(Verifier, CannotEndTwoInOrderInExactMode) {
  // The done that completes the first is a failure for the second, as in the reference.
  Play play("go to the red ball, then go to the red key", {"K>B"}, DoneMode::exact);
  play({left, left, right, right});
  EXPECT_EQ(play({done}), Status::failure);
}

TEST(Verifier, ForgivesDoneForTwoAtOnceUnlessItIsAnEnumMember) {
  constexpr std::string_view kMission = "go to the red ball and go to the red key";
  Play number(kMission, {"K>.B"}, DoneMode::exact);
  EXPECT_EQ(number({done}), Status::ongoing);
  Play member(kMission, {"K>.B"}, DoneMode::exact_enum);
  EXPECT_EQ(member({done}), Status::failure);
}

TEST(Verifier, TakesEachDeclarationInItsTurnInSequentialMode) {
  Play play("go to the red ball, then go to the red key", {"K>B"}, DoneMode::sequential);
  EXPECT_EQ(play({left, right}), Status::ongoing);
  EXPECT_EQ(play({done}), Status::ongoing);
  EXPECT_EQ(play.completion(), (std::vector{1, 0}));
  EXPECT_EQ(play.declarable(), (std::vector{0, 1}));
  EXPECT_EQ(play({left, left}), Status::ongoing);
  EXPECT_EQ(play({done}), Status::success);
}

TEST(Verifier, FailsWhenThereIsNothingToDeclareInSequentialMode) {
  Play early("go to the red ball", {">..B"}, DoneMode::sequential);
  EXPECT_EQ(early({forward, done}), Status::failure);
  Play late("pick up the red ball", {">B"}, DoneMode::sequential);
  EXPECT_EQ(late({pickup, left, done}), Status::failure);
  Play held("pick up the red ball", {">B"}, DoneMode::sequential);
  EXPECT_EQ(held({pickup, pickup, done}), Status::failure);  // it was in hand already
  Play twice("go to the red ball, then go to the red ball", {">.B"}, DoneMode::sequential);
  EXPECT_EQ(twice({forward, done}), Status::ongoing);
  EXPECT_EQ(twice({done}), Status::failure);  // it must come true again
}

TEST(Verifier, GoesThroughAChainInItsOrderOfDoing) {
  constexpr std::string_view kMission =
      "go to the red ball, then go to the red key and go to the blue ball after you go to the red "
      "box, then go to the red key";
  const std::vector<std::string_view> rows{".X.", "K>B",
                                           ".b."};  // right: the first of the sentence
  Play play(kMission, rows, DoneMode::sequential);
  EXPECT_EQ(play.declarable(), (std::vector{0, 0, 0, 1, 0}));
  EXPECT_EQ(play({left, done}), Status::ongoing);
  EXPECT_EQ(play.completion(), (std::vector{0, 0, 0, 1, 0}));
  EXPECT_EQ(play.declarable(), (std::vector{0, 0, 0, 0, 1}));
  EXPECT_EQ(play({left, done}), Status::ongoing);
  EXPECT_EQ(play.declarable(), (std::vector{1, 0, 0, 0, 0}));
  EXPECT_EQ(play({left, left, done}), Status::ongoing);
  EXPECT_EQ(play.declarable(), (std::vector{0, 1, 1, 0, 0}));
  EXPECT_EQ(numbers(play.in_sub_tasks().enabled()), (std::vector{0, 1, 1, 0, 0}));
  EXPECT_EQ(play({right, done}), Status::ongoing);
  EXPECT_EQ(play.completion(), (std::vector{1, 0, 1, 1, 1}));
  EXPECT_EQ(play({right, done}), Status::success);

  Play early(kMission, rows, DoneMode::sequential);
  EXPECT_EQ(early({left, left, done}), Status::failure);  // the key before the box

  Play judged(kMission, rows);
  EXPECT_EQ(judged({left, left, left, left}), Status::ongoing);
  EXPECT_EQ(judged.completion(), (std::vector{1, 0, 0, 1, 1}));
  EXPECT_EQ(judged({right, right}), Status::success);
}

TEST(Verifier, FailsForAnyLaterPartOfAStrictChain) {
  constexpr std::string_view kMission =
      "go to the red ball, then go to the red key, then go to the blue ball";
  Play play(kMission, {"K>.", ".b.", "..B"}, DoneMode::off, true);
  EXPECT_EQ(play({right}), Status::failure);
}

TEST(Meaning, FitsADescriptionFromWhereTheAgentStands) {
  const World world = grid::drawn({"..B..",  //
                                   "..^..",  //
                                   "B.b.K"});
  const auto count = [&](const Description& d) {
    return std::popcount(matching_objects(world, d));
  };
  using grid::Type;
  EXPECT_EQ(count({.type = Type::ball}), 3);
  EXPECT_EQ(count({.type = Type::ball, .location = Location::front}), 1);
  EXPECT_EQ(count({.type = Type::ball, .location = Location::behind}), 2);
  EXPECT_EQ(count({.type = Type::ball, .location = Location::left}), 1);
  EXPECT_EQ(count({.type = Type::key, .location = Location::right}), 1);
  EXPECT_EQ(count({.type = Type::box}), 0);
}

TEST(Meaning, TakesWallsForGreyObjectsOfAnyType) {
  const World world = grid::drawn({"###", "#>#", "###"});
  EXPECT_EQ(matching_objects(world, {.color = grid::Color::grey}), grid::only(grid::kWall));
  EXPECT_TRUE(several(grid::only(grid::kWall)));
  EXPECT_EQ(matching_objects(world, {.color = grid::Color::red}), 0u);
}

}  // namespace
}  // namespace wordgaze::babyai
