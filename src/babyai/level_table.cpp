#include "level_table.hpp"

#include "generators.hpp"

namespace wordgaze::babyai {
namespace {

using namespace generators;

constexpr int square(int n) { return n * n; }

constexpr std::array kGoTo{Verb::go_to};
constexpr std::array kPickup{Verb::pickup};
constexpr std::array kOneClause{Form::clause};

}  // namespace

// What a row does not say is a maze of 3 x 3 rooms of 8 x 8 cells with BabyAI's own step limit.
std::span<const LevelSpec> level_table() {
  // clang-format off
  static const std::vector<LevelSpec> table{
      // go to
      {.id = "BabyAI-GoToRedBallGrey-v0", .generate = go_to_red_ball_among_grey, .rows = 1, .columns = 1, .objects = 7},
      {.id = "BabyAI-GoToRedBall-v0", .generate = go_to_red_ball, .rows = 1, .columns = 1, .objects = 7},
      {.id = "BabyAI-GoToRedBallNoDists-v0", .generate = go_to_red_ball, .rows = 1, .columns = 1},
      {.id = "BabyAI-GoToObj-v0", .generate = go_to_only_object, .rows = 1, .columns = 1},
      {.id = "BabyAI-GoToObjS4-v0", .generate = go_to_only_object, .room_size = 4, .rows = 1, .columns = 1},
      {.id = "BabyAI-GoToObjS6-v1", .generate = go_to_only_object, .room_size = 6, .rows = 1, .columns = 1},
      {.id = "BabyAI-GoToLocal-v0", .generate = go_to_local, .rows = 1, .columns = 1, .objects = 8},
      {.id = "BabyAI-GoToLocalS5N2-v0", .generate = go_to_local, .room_size = 5, .rows = 1, .columns = 1, .objects = 2},
      {.id = "BabyAI-GoToLocalS6N2-v0", .generate = go_to_local, .room_size = 6, .rows = 1, .columns = 1, .objects = 2},
      {.id = "BabyAI-GoToLocalS6N3-v0", .generate = go_to_local, .room_size = 6, .rows = 1, .columns = 1, .objects = 3},
      {.id = "BabyAI-GoToLocalS6N4-v0", .generate = go_to_local, .room_size = 6, .rows = 1, .columns = 1, .objects = 4},
      {.id = "BabyAI-GoToLocalS7N4-v0", .generate = go_to_local, .room_size = 7, .rows = 1, .columns = 1, .objects = 4},
      {.id = "BabyAI-GoToLocalS7N5-v0", .generate = go_to_local, .room_size = 7, .rows = 1, .columns = 1, .objects = 5},
      {.id = "BabyAI-GoToLocalS8N2-v0", .generate = go_to_local, .rows = 1, .columns = 1, .objects = 2},
      {.id = "BabyAI-GoToLocalS8N3-v0", .generate = go_to_local, .rows = 1, .columns = 1, .objects = 3},
      {.id = "BabyAI-GoToLocalS8N4-v0", .generate = go_to_local, .rows = 1, .columns = 1, .objects = 4},
      {.id = "BabyAI-GoToLocalS8N5-v0", .generate = go_to_local, .rows = 1, .columns = 1, .objects = 5},
      {.id = "BabyAI-GoToLocalS8N6-v0", .generate = go_to_local, .rows = 1, .columns = 1, .objects = 6},
      {.id = "BabyAI-GoToLocalS8N7-v0", .generate = go_to_local, .rows = 1, .columns = 1, .objects = 7},
      {.id = "BabyAI-GoTo-v0", .generate = go_to, .objects = 18},
      {.id = "BabyAI-GoToOpen-v0", .generate = go_to_with_open_doors, .objects = 18},
      {.id = "BabyAI-GoToObjMaze-v0", .generate = go_to, .objects = 1},
      {.id = "BabyAI-GoToObjMazeOpen-v0", .generate = go_to_with_open_doors, .objects = 1},
      {.id = "BabyAI-GoToObjMazeS4R2-v0", .generate = go_to, .room_size = 4, .rows = 2, .columns = 2, .objects = 1},
      {.id = "BabyAI-GoToObjMazeS4-v0", .generate = go_to, .room_size = 4, .objects = 1},
      {.id = "BabyAI-GoToObjMazeS5-v0", .generate = go_to, .room_size = 5, .objects = 1},
      {.id = "BabyAI-GoToObjMazeS6-v0", .generate = go_to, .room_size = 6, .objects = 1},
      {.id = "BabyAI-GoToObjMazeS7-v0", .generate = go_to, .room_size = 7, .objects = 1},
      {.id = "BabyAI-GoToImpUnlock-v0", .generate = go_to_after_unlocking},
      {.id = "BabyAI-GoToSeq-v0", .generate = any_mission, .objects = 18,
       .missions = {.locked_room = 0, .locations = false, .unblocking = false, .verbs = kGoTo}},
      {.id = "BabyAI-GoToSeqS5R2-v0", .generate = any_mission, .room_size = 5, .rows = 2, .columns = 2, .objects = 4,
       .missions = {.locked_room = 0, .locations = false, .unblocking = false, .verbs = kGoTo}},
      {.id = "BabyAI-GoToRedBlueBall-v0", .generate = go_to_red_or_blue_ball, .rows = 1, .columns = 1, .objects = 7},
      {.id = "BabyAI-GoToDoor-v0", .generate = go_to_door, .room_size = 7},
      {.id = "BabyAI-GoToObjDoor-v0", .generate = go_to_object_or_door, .objects = 8},

      // open
      {.id = "BabyAI-Open-v0", .generate = open, .objects = 18},
      {.id = "BabyAI-OpenRedDoor-v0", .generate = open_red_door, .room_size = 5, .rows = 1, .columns = 2},
      {.id = "BabyAI-OpenDoor-v0", .generate = open_door},
      {.id = "BabyAI-OpenDoorDebug-v0", .generate = open_door, .strict = true},
      {.id = "BabyAI-OpenDoorColor-v0", .generate = open_door_by_color},
      {.id = "BabyAI-OpenDoorLoc-v0", .generate = open_door_by_location},
      {.id = "BabyAI-OpenTwoDoors-v0", .generate = open_two_doors, .room_size = 6, .max_steps = 20 * square(6)},
      {.id = "BabyAI-OpenRedBlueDoors-v0", .generate = open_red_then_blue_door, .room_size = 6, .max_steps = 20 * square(6)},
      {.id = "BabyAI-OpenRedBlueDoorsDebug-v0", .generate = open_red_then_blue_door, .room_size = 6, .max_steps = 20 * square(6), .strict = true},
      {.id = "BabyAI-OpenDoorsOrderN2-v0", .generate = open_doors_in_order, .room_size = 6, .max_steps = 20 * square(6), .objects = 2},
      {.id = "BabyAI-OpenDoorsOrderN4-v0", .generate = open_doors_in_order, .room_size = 6, .max_steps = 20 * square(6), .objects = 4},
      {.id = "BabyAI-OpenDoorsOrderN2Debug-v0", .generate = open_doors_in_order, .room_size = 6, .max_steps = 20 * square(6), .objects = 2, .strict = true},
      {.id = "BabyAI-OpenDoorsOrderN4Debug-v0", .generate = open_doors_in_order, .room_size = 6, .max_steps = 20 * square(6), .objects = 4, .strict = true},

      // pick up
      {.id = "BabyAI-Pickup-v0", .generate = pick_up, .objects = 18},
      {.id = "BabyAI-UnblockPickup-v0", .generate = unblock_and_pick_up, .objects = 20},
      {.id = "BabyAI-PickupLoc-v0", .generate = any_mission, .rows = 1, .columns = 1, .objects = 8,
       .missions = {.locked_room = 0, .unblocking = false, .verbs = kPickup, .forms = kOneClause}},
      {.id = "BabyAI-PickupDist-v0", .generate = pick_up_among_distractors, .room_size = 7, .rows = 1, .columns = 1, .objects = 5},
      {.id = "BabyAI-PickupDistDebug-v0", .generate = pick_up_among_distractors, .room_size = 7, .rows = 1, .columns = 1, .objects = 5, .strict = true},
      {.id = "BabyAI-PickupAbove-v0", .generate = pick_up_above, .room_size = 6, .max_steps = 8 * square(6)},

      // put next
      {.id = "BabyAI-PutNextLocal-v0", .generate = put_next_local, .rows = 1, .columns = 1, .objects = 8},
      {.id = "BabyAI-PutNextLocalS5N3-v0", .generate = put_next_local, .room_size = 5, .rows = 1, .columns = 1, .objects = 3},
      {.id = "BabyAI-PutNextLocalS6N4-v0", .generate = put_next_local, .room_size = 6, .rows = 1, .columns = 1, .objects = 4},
      {.id = "BabyAI-PutNextS4N1-v0", .generate = put_next, .room_size = 4, .rows = 1, .columns = 2, .max_steps = 8 * square(4), .objects = 1},
      {.id = "BabyAI-PutNextS5N2-v0", .generate = put_next, .room_size = 5, .rows = 1, .columns = 2, .max_steps = 8 * square(5), .objects = 2},
      {.id = "BabyAI-PutNextS5N1-v0", .generate = put_next, .room_size = 5, .rows = 1, .columns = 2, .max_steps = 8 * square(5), .objects = 1},
      {.id = "BabyAI-PutNextS6N3-v0", .generate = put_next, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 8 * square(6), .objects = 3},
      {.id = "BabyAI-PutNextS7N4-v0", .generate = put_next, .room_size = 7, .rows = 1, .columns = 2, .max_steps = 8 * square(7), .objects = 4},
      {.id = "BabyAI-PutNextS5N2Carrying-v0", .generate = put_next_carrying, .room_size = 5, .rows = 1, .columns = 2, .max_steps = 8 * square(5), .objects = 2},
      {.id = "BabyAI-PutNextS6N3Carrying-v0", .generate = put_next_carrying, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 8 * square(6), .objects = 3},
      {.id = "BabyAI-PutNextS7N4Carrying-v0", .generate = put_next_carrying, .room_size = 7, .rows = 1, .columns = 2, .max_steps = 8 * square(7), .objects = 4},

      // unlock
      {.id = "BabyAI-Unlock-v0", .generate = unlock},
      {.id = "BabyAI-UnlockLocal-v0", .generate = unlock_local},
      {.id = "BabyAI-UnlockLocalDist-v0", .generate = unlock_local, .objects = 3},
      {.id = "BabyAI-KeyInBox-v0", .generate = key_in_box},
      {.id = "BabyAI-UnlockPickup-v0", .generate = unlock_and_pick_up, .room_size = 6, .rows = 1, .columns = 2},
      {.id = "BabyAI-UnlockPickupDist-v0", .generate = unlock_and_pick_up, .room_size = 6, .rows = 1, .columns = 2, .objects = 4},
      {.id = "BabyAI-BlockedUnlockPickup-v0", .generate = unblock_unlock_and_pick_up, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 16 * square(6)},
      {.id = "BabyAI-UnlockToUnlock-v0", .generate = unlock_to_unlock, .room_size = 6, .rows = 1, .columns = 3, .max_steps = 30 * square(6)},

      // others
      {.id = "BabyAI-ActionObjDoor-v0", .generate = act_on_object_or_door, .room_size = 7, .objects = 5},
      {.id = "BabyAI-FindObjS5-v0", .generate = find_object, .room_size = 5, .max_steps = 20 * square(5)},
      {.id = "BabyAI-FindObjS6-v0", .generate = find_object, .room_size = 6, .max_steps = 20 * square(6)},
      {.id = "BabyAI-FindObjS7-v0", .generate = find_object, .room_size = 7, .max_steps = 20 * square(7)},
      {.id = "BabyAI-KeyCorridor-v0", .generate = key_corridor, .room_size = 6, .max_steps = 30 * square(6)},
      {.id = "BabyAI-KeyCorridorS3R1-v0", .generate = key_corridor, .room_size = 3, .rows = 1, .max_steps = 30 * square(3)},
      {.id = "BabyAI-KeyCorridorS3R2-v0", .generate = key_corridor, .room_size = 3, .rows = 2, .max_steps = 30 * square(3)},
      {.id = "BabyAI-KeyCorridorS3R3-v0", .generate = key_corridor, .room_size = 3, .max_steps = 30 * square(3)},
      {.id = "BabyAI-KeyCorridorS4R3-v0", .generate = key_corridor, .room_size = 4, .max_steps = 30 * square(4)},
      {.id = "BabyAI-KeyCorridorS5R3-v0", .generate = key_corridor, .room_size = 5, .max_steps = 30 * square(5)},
      {.id = "BabyAI-KeyCorridorS6R3-v0", .generate = key_corridor, .room_size = 6, .max_steps = 30 * square(6)},
      {.id = "BabyAI-OneRoomS8-v0", .generate = pick_up_only_ball, .rows = 1, .columns = 1},
      {.id = "BabyAI-OneRoomS12-v0", .generate = pick_up_only_ball, .room_size = 12, .rows = 1, .columns = 1},
      {.id = "BabyAI-OneRoomS16-v0", .generate = pick_up_only_ball, .room_size = 16, .rows = 1, .columns = 1},
      {.id = "BabyAI-OneRoomS20-v0", .generate = pick_up_only_ball, .room_size = 20, .rows = 1, .columns = 1},
      {.id = "BabyAI-MoveTwoAcrossS5N2-v0", .generate = move_two_across, .room_size = 5, .rows = 1, .columns = 2, .max_steps = 16 * square(5), .objects = 2},
      {.id = "BabyAI-MoveTwoAcrossS8N9-v0", .generate = move_two_across, .room_size = 8, .rows = 1, .columns = 2, .max_steps = 16 * square(8), .objects = 9},

      // any mission
      {.id = "BabyAI-Synth-v0", .generate = any_mission, .objects = 18,
       .missions = {.locations = false, .implicit_unlock = false, .forms = kOneClause}},
      {.id = "BabyAI-SynthS5R2-v0", .generate = any_mission, .room_size = 5, .rows = 2, .objects = 18,
       .missions = {.locations = false, .implicit_unlock = false, .forms = kOneClause}},
      {.id = "BabyAI-SynthLoc-v0", .generate = any_mission, .objects = 18,
       .missions = {.implicit_unlock = false, .forms = kOneClause}},
      {.id = "BabyAI-SynthSeq-v0", .generate = any_mission, .objects = 18, .missions = {.implicit_unlock = false}},
      {.id = "BabyAI-MiniBossLevel-v0", .generate = any_mission, .room_size = 5, .rows = 2, .columns = 2, .objects = 7,
       .missions = {.locked_room = 0.25}},
      {.id = "BabyAI-BossLevel-v0", .generate = any_mission, .objects = 18},
      {.id = "BabyAI-BossLevelNoUnlock-v0", .generate = any_mission, .objects = 18,
       .missions = {.locked_room = 0, .implicit_unlock = false}},

      // MiniGrid, to the goal
      {.id = "MiniGrid-Empty-5x5-v0", .generate = empty_room, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 4 * square(5), .rule = Rule::goal, .see_through_walls = true},
      {.id = "MiniGrid-Empty-Random-5x5-v0", .generate = empty_room_random_start, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 4 * square(5), .rule = Rule::goal, .see_through_walls = true},
      {.id = "MiniGrid-Empty-6x6-v0", .generate = empty_room, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 4 * square(6), .rule = Rule::goal, .see_through_walls = true},
      {.id = "MiniGrid-Empty-Random-6x6-v0", .generate = empty_room_random_start, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 4 * square(6), .rule = Rule::goal, .see_through_walls = true},
      {.id = "MiniGrid-Empty-8x8-v0", .generate = empty_room, .room_size = 8, .rows = 1, .columns = 1, .max_steps = 4 * square(8), .rule = Rule::goal, .see_through_walls = true},
      {.id = "MiniGrid-Empty-16x16-v0", .generate = empty_room, .room_size = 16, .rows = 1, .columns = 1, .max_steps = 4 * square(16), .rule = Rule::goal, .see_through_walls = true},
      {.id = "MiniGrid-DistShift1-v0", .generate = dist_shift_near, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 252, .rule = Rule::goal, .see_through_walls = true},
      {.id = "MiniGrid-DistShift2-v0", .generate = dist_shift_far, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 252, .rule = Rule::goal, .see_through_walls = true},
      {.id = "MiniGrid-DoorKey-5x5-v0", .generate = door_key, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 10 * square(5), .rule = Rule::goal},
      {.id = "MiniGrid-DoorKey-6x6-v0", .generate = door_key, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 10 * square(6), .rule = Rule::goal},
      {.id = "MiniGrid-DoorKey-8x8-v0", .generate = door_key, .room_size = 8, .rows = 1, .columns = 1, .max_steps = 10 * square(8), .rule = Rule::goal},
      {.id = "MiniGrid-DoorKey-16x16-v0", .generate = door_key, .room_size = 16, .rows = 1, .columns = 1, .max_steps = 10 * square(16), .rule = Rule::goal},
      {.id = "MiniGrid-LavaGapS5-v0", .generate = lava_gap, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 4 * square(5), .rule = Rule::goal},
      {.id = "MiniGrid-LavaGapS6-v0", .generate = lava_gap, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 4 * square(6), .rule = Rule::goal},
      {.id = "MiniGrid-LavaGapS7-v0", .generate = lava_gap, .room_size = 7, .rows = 1, .columns = 1, .max_steps = 4 * square(7), .rule = Rule::goal},
      {.id = "MiniGrid-LavaCrossingS9N1-v0", .generate = lava_crossing, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 4 * square(9), .rule = Rule::goal, .objects = 1},
      {.id = "MiniGrid-LavaCrossingS9N2-v0", .generate = lava_crossing, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 4 * square(9), .rule = Rule::goal, .objects = 2},
      {.id = "MiniGrid-LavaCrossingS9N3-v0", .generate = lava_crossing, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 4 * square(9), .rule = Rule::goal, .objects = 3},
      {.id = "MiniGrid-LavaCrossingS11N5-v0", .generate = lava_crossing, .room_size = 11, .rows = 1, .columns = 1, .max_steps = 4 * square(11), .rule = Rule::goal, .objects = 5},
      {.id = "MiniGrid-SimpleCrossingS9N1-v0", .generate = simple_crossing, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 4 * square(9), .rule = Rule::goal, .objects = 1},
      {.id = "MiniGrid-SimpleCrossingS9N2-v0", .generate = simple_crossing, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 4 * square(9), .rule = Rule::goal, .objects = 2},
      {.id = "MiniGrid-SimpleCrossingS9N3-v0", .generate = simple_crossing, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 4 * square(9), .rule = Rule::goal, .objects = 3},
      {.id = "MiniGrid-SimpleCrossingS11N5-v0", .generate = simple_crossing, .room_size = 11, .rows = 1, .columns = 1, .max_steps = 4 * square(11), .rule = Rule::goal, .objects = 5},
      {.id = "MiniGrid-FourRooms-v0", .generate = four_rooms, .room_size = 19, .rows = 1, .columns = 1, .max_steps = 100, .rule = Rule::goal},
      {.id = "MiniGrid-LockedRoom-v0", .generate = locked_room, .room_size = 19, .rows = 1, .columns = 1, .max_steps = 190, .rule = Rule::goal},
      {.id = "MiniGrid-MultiRoom-N2-S4-v0", .generate = multi_room, .room_size = 4, .rows = 1, .columns = 1, .max_steps = 40, .rule = Rule::goal, .objects = 2},
      {.id = "MiniGrid-MultiRoom-N4-S5-v0", .generate = multi_room, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 120, .rule = Rule::goal, .objects = 6},
      {.id = "MiniGrid-MultiRoom-N4-S5-v1", .generate = multi_room, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 80, .rule = Rule::goal, .objects = 4},
      {.id = "MiniGrid-MultiRoom-N6-v0", .generate = multi_room, .room_size = 10, .rows = 1, .columns = 1, .max_steps = 120, .rule = Rule::goal, .objects = 6},
      {.id = "MiniGrid-Dynamic-Obstacles-5x5-v0", .generate = dynamic_obstacles, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 4 * square(5), .rule = Rule::dynamic_obstacles, .see_through_walls = true, .actions = 3, .objects = 2},
      {.id = "MiniGrid-Dynamic-Obstacles-Random-5x5-v0", .generate = dynamic_obstacles_random_start, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 4 * square(5), .rule = Rule::dynamic_obstacles, .see_through_walls = true, .actions = 3, .objects = 2},
      {.id = "MiniGrid-Dynamic-Obstacles-6x6-v0", .generate = dynamic_obstacles, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 4 * square(6), .rule = Rule::dynamic_obstacles, .see_through_walls = true, .actions = 3, .objects = 3},
      {.id = "MiniGrid-Dynamic-Obstacles-Random-6x6-v0", .generate = dynamic_obstacles_random_start, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 4 * square(6), .rule = Rule::dynamic_obstacles, .see_through_walls = true, .actions = 3, .objects = 3},
      {.id = "MiniGrid-Dynamic-Obstacles-8x8-v0", .generate = dynamic_obstacles, .room_size = 8, .rows = 1, .columns = 1, .max_steps = 4 * square(8), .rule = Rule::dynamic_obstacles, .see_through_walls = true, .actions = 3, .objects = 4},
      {.id = "MiniGrid-Dynamic-Obstacles-16x16-v0", .generate = dynamic_obstacles, .room_size = 16, .rows = 1, .columns = 1, .max_steps = 4 * square(16), .rule = Rule::dynamic_obstacles, .see_through_walls = true, .actions = 3, .objects = 8},

      // MiniGrid, objects in one grid
      {.id = "MiniGrid-Fetch-5x5-N2-v0", .generate = fetch, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 5 * square(5), .rule = Rule::fetch, .see_through_walls = true, .objects = 2},
      {.id = "MiniGrid-Fetch-6x6-N2-v0", .generate = fetch, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 5 * square(6), .rule = Rule::fetch, .see_through_walls = true, .objects = 2},
      {.id = "MiniGrid-Fetch-8x8-N3-v0", .generate = fetch, .room_size = 8, .rows = 1, .columns = 1, .max_steps = 5 * square(8), .rule = Rule::fetch, .see_through_walls = true, .objects = 3},
      {.id = "MiniGrid-GoToDoor-5x5-v0", .generate = door_of_color, .room_size = 5, .rows = 1, .columns = 1, .max_steps = 4 * square(5), .rule = Rule::reach_and_declare, .see_through_walls = true},
      {.id = "MiniGrid-GoToDoor-6x6-v0", .generate = door_of_color, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 4 * square(6), .rule = Rule::reach_and_declare, .see_through_walls = true},
      {.id = "MiniGrid-GoToDoor-8x8-v0", .generate = door_of_color, .room_size = 8, .rows = 1, .columns = 1, .max_steps = 4 * square(8), .rule = Rule::reach_and_declare, .see_through_walls = true},
      {.id = "MiniGrid-GoToObject-6x6-N2-v0", .generate = object_of_color, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 5 * square(6), .rule = Rule::reach_and_declare, .see_through_walls = true, .objects = 2},
      {.id = "MiniGrid-GoToObject-8x8-N2-v0", .generate = object_of_color, .room_size = 8, .rows = 1, .columns = 1, .max_steps = 5 * square(8), .rule = Rule::reach_and_declare, .see_through_walls = true, .objects = 2},
      {.id = "MiniGrid-PutNear-6x6-N2-v0", .generate = put_near, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 5 * 6, .rule = Rule::put_near, .see_through_walls = true, .objects = 2},
      {.id = "MiniGrid-PutNear-8x8-N3-v0", .generate = put_near, .room_size = 8, .rows = 1, .columns = 1, .max_steps = 5 * 8, .rule = Rule::put_near, .see_through_walls = true, .objects = 3},
      {.id = "MiniGrid-Playground-v0", .generate = playground, .room_size = 19, .rows = 1, .columns = 1, .max_steps = 100, .rule = Rule::goal},
      {.id = "MiniGrid-RedBlueDoors-6x6-v0", .generate = red_then_blue_door, .room_size = 6, .rows = 1, .columns = 1, .max_steps = 20 * square(6), .rule = Rule::red_then_blue},
      {.id = "MiniGrid-RedBlueDoors-8x8-v0", .generate = red_then_blue_door, .room_size = 8, .rows = 1, .columns = 1, .max_steps = 20 * square(8), .rule = Rule::red_then_blue},
      {.id = "MiniGrid-MemoryS17Random-v0", .generate = memory_random_length, .room_size = 17, .rows = 1, .columns = 1, .max_steps = 5 * square(17), .rule = Rule::memory},
      {.id = "MiniGrid-MemoryS13Random-v0", .generate = memory_random_length, .room_size = 13, .rows = 1, .columns = 1, .max_steps = 5 * square(13), .rule = Rule::memory},
      {.id = "MiniGrid-MemoryS13-v0", .generate = memory, .room_size = 13, .rows = 1, .columns = 1, .max_steps = 5 * square(13), .rule = Rule::memory},
      {.id = "MiniGrid-MemoryS11-v0", .generate = memory, .room_size = 11, .rows = 1, .columns = 1, .max_steps = 5 * square(11), .rule = Rule::memory},
      {.id = "MiniGrid-MemoryS9-v0", .generate = memory, .room_size = 9, .rows = 1, .columns = 1, .max_steps = 5 * square(9), .rule = Rule::memory},
      {.id = "MiniGrid-MemoryS7-v0", .generate = memory, .room_size = 7, .rows = 1, .columns = 1, .max_steps = 5 * square(7), .rule = Rule::memory},

      // MiniGrid, rooms
      {.id = "MiniGrid-Unlock-v0", .generate = open_locked_door, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 8 * square(6), .rule = Rule::open_target},
      {.id = "MiniGrid-UnlockPickup-v0", .generate = box_behind_door, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 8 * square(6), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-BlockedUnlockPickup-v0", .generate = blocked_box_behind_door, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 16 * square(6), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-KeyCorridorS3R1-v0", .generate = ball_off_corridor, .room_size = 3, .rows = 1, .max_steps = 30 * square(3), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-KeyCorridorS3R2-v0", .generate = ball_off_corridor, .room_size = 3, .rows = 2, .max_steps = 30 * square(3), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-KeyCorridorS3R3-v0", .generate = ball_off_corridor, .room_size = 3, .max_steps = 30 * square(3), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-KeyCorridorS4R3-v0", .generate = ball_off_corridor, .room_size = 4, .max_steps = 30 * square(4), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-KeyCorridorS5R3-v0", .generate = ball_off_corridor, .room_size = 5, .max_steps = 30 * square(5), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-KeyCorridorS6R3-v0", .generate = ball_off_corridor, .room_size = 6, .max_steps = 30 * square(6), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-ObstructedMaze-1Dl-v0", .generate = obstructed_door, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 8 * square(6), .rule = Rule::pick_up_target, .maze = {.key_in_box = false, .blocked = false}},
      {.id = "MiniGrid-ObstructedMaze-1Dlh-v0", .generate = obstructed_door, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 8 * square(6), .rule = Rule::pick_up_target, .maze = {.blocked = false}},
      {.id = "MiniGrid-ObstructedMaze-1Dlhb-v0", .generate = obstructed_door, .room_size = 6, .rows = 1, .columns = 2, .max_steps = 8 * square(6), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-ObstructedMaze-2Dl-v0", .generate = obstructed_maze, .room_size = 6, .max_steps = 16 * square(6), .rule = Rule::pick_up_target, .maze = {.agent_column = 2, .key_in_box = false, .blocked = false, .quarters = 1}},
      {.id = "MiniGrid-ObstructedMaze-2Dlh-v0", .generate = obstructed_maze, .room_size = 6, .max_steps = 16 * square(6), .rule = Rule::pick_up_target, .maze = {.agent_column = 2, .blocked = false, .quarters = 1}},
      {.id = "MiniGrid-ObstructedMaze-2Dlhb-v0", .generate = obstructed_maze, .room_size = 6, .max_steps = 16 * square(6), .rule = Rule::pick_up_target, .maze = {.agent_column = 2, .quarters = 1}},
      {.id = "MiniGrid-ObstructedMaze-1Q-v0", .generate = obstructed_maze, .room_size = 6, .max_steps = 20 * square(6), .rule = Rule::pick_up_target, .maze = {.quarters = 1}},
      {.id = "MiniGrid-ObstructedMaze-2Q-v0", .generate = obstructed_maze, .room_size = 6, .max_steps = 44 * square(6), .rule = Rule::pick_up_target, .maze = {.agent_column = 2, .quarters = 2}},
      {.id = "MiniGrid-ObstructedMaze-Full-v0", .generate = obstructed_maze, .room_size = 6, .max_steps = 100 * square(6), .rule = Rule::pick_up_target},
      {.id = "MiniGrid-ObstructedMaze-2Dlhb-v1", .generate = obstructed_maze, .room_size = 6, .max_steps = 16 * square(6), .rule = Rule::pick_up_target, .maze = {.agent_column = 2, .quarters = 1, .keys_last = true}},
      {.id = "MiniGrid-ObstructedMaze-1Q-v1", .generate = obstructed_maze, .room_size = 6, .max_steps = 20 * square(6), .rule = Rule::pick_up_target, .maze = {.quarters = 1, .keys_last = true}},
      {.id = "MiniGrid-ObstructedMaze-2Q-v1", .generate = obstructed_maze, .room_size = 6, .max_steps = 44 * square(6), .rule = Rule::pick_up_target, .maze = {.agent_column = 2, .quarters = 2, .keys_last = true}},
      {.id = "MiniGrid-ObstructedMaze-Full-v1", .generate = obstructed_maze, .room_size = 6, .max_steps = 100 * square(6), .rule = Rule::pick_up_target, .maze = {.keys_last = true}},
  };
  // clang-format on
  return table;
}

}  // namespace wordgaze::babyai
