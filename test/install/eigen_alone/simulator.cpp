// A user who wants the simulator alone: a level of one's own, and a robot that turns about in it.
#include <cstdio>

#include <wordgaze/babyai/layout.hpp>
#include <wordgaze/babyai/stages.hpp>
#include <wordgaze/env/environment.hpp>

using namespace wordgaze;

static void ball_behind_door(babyai::Layout& layout) {
  const auto ball = layout.add_object({1, 0}, grid::Type::ball);
  const auto door = layout.add_door({0, 0}, grid::Direction::right, {}, true);
  babyai::generators::add_key(layout, {0, 0}, door);
  layout.place_agent(grid::RoomIndex{0, 0});
  layout.ask(babyai::Verb::pickup, layout.describe(ball));
}

int main() {
  babyai::register_level({.id = "Own-BallBehindDoor-v0",
                          .generate = ball_behind_door,
                          .room_size = 6,
                          .rows = 1,
                          .columns = 2});
  env::Environment rooms("Own-BallBehindDoor-v0");
  rooms.reset(1);
  for (int turn = 0; turn < 4; ++turn) rooms.step(grid::Action::left);
  std::printf("%s: %d steps\n", rooms.mission().c_str(), rooms.step_count());
  return rooms.step_count() == 4 ? 0 : 1;
}
