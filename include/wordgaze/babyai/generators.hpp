#pragma once
#include "wordgaze/babyai/layout.hpp"

/// The generators of the level table, by family. Each draws what its level in the reference draws,
/// in the same order. (docs/simulator.md, Levels)
namespace wordgaze::babyai::generators {

void one_room_task(Layout& layout);

// go to
void go_to_red_ball(Layout& layout);
void go_to_red_ball_among_grey(Layout& layout);
void go_to_red_or_blue_ball(Layout& layout);
void go_to_only_object(Layout& layout);
void go_to_local(Layout& layout);
void go_to(Layout& layout);
void go_to_with_open_doors(Layout& layout);
void go_to_after_unlocking(Layout& layout);
void go_to_door(Layout& layout);
void go_to_object_or_door(Layout& layout);

// open
void open(Layout& layout);
void open_red_door(Layout& layout);
void open_door(Layout& layout);
void open_door_by_color(Layout& layout);
void open_door_by_location(Layout& layout);
void open_two_doors(Layout& layout);
void open_red_then_blue_door(Layout& layout);
void open_doors_in_order(Layout& layout);
void act_on_object_or_door(Layout& layout);

// unlock
void unlock(Layout& layout);
void unlock_local(Layout& layout);
void key_in_box(Layout& layout);
void unlock_and_pick_up(Layout& layout);
void unblock_unlock_and_pick_up(Layout& layout);
void unlock_to_unlock(Layout& layout);

// pick up
void pick_up(Layout& layout);
void unblock_and_pick_up(Layout& layout);
void pick_up_among_distractors(Layout& layout);
void pick_up_above(Layout& layout);
void pick_up_only_ball(Layout& layout);
void find_object(Layout& layout);
void key_corridor(Layout& layout);

// put next
void put_next_local(Layout& layout);
void put_next(Layout& layout);
void put_next_carrying(Layout& layout);
void move_two_across(Layout& layout);

// LevelGen
void any_mission(Layout& layout);

// a level of data
void planned(Layout& layout);

// MiniGrid: to the goal
void empty_room(Layout& layout);
void empty_room_random_start(Layout& layout);
void dist_shift_near(Layout& layout);
void dist_shift_far(Layout& layout);
void door_key(Layout& layout);
void lava_gap(Layout& layout);
void lava_crossing(Layout& layout);
void simple_crossing(Layout& layout);
void four_rooms(Layout& layout);
void dynamic_obstacles(Layout& layout);
void dynamic_obstacles_random_start(Layout& layout);
void locked_room(Layout& layout);
void multi_room(Layout& layout);

// MiniGrid: objects in one grid
void fetch(Layout& layout);
void door_of_color(Layout& layout);
void object_of_color(Layout& layout);
void put_near(Layout& layout);
void playground(Layout& layout);
void red_then_blue_door(Layout& layout);
void memory(Layout& layout);
void memory_random_length(Layout& layout);

// MiniGrid: rooms
void open_locked_door(Layout& layout);
void box_behind_door(Layout& layout);
void blocked_box_behind_door(Layout& layout);
void ball_off_corridor(Layout& layout);
void obstructed_door(Layout& layout);
void obstructed_maze(Layout& layout);

}  // namespace wordgaze::babyai::generators
