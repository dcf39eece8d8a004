#pragma once
#include "wordgaze/babyai/layout.hpp"

/// The generators of the level table, by family. Each draws what its level in the reference draws,
/// in the same order. (spec 7, 8, 9 and 11)
namespace wordgaze::babyai::generators {

void one_room_task(Layout& layout);

void go_to_local(Layout& layout);

}  // namespace wordgaze::babyai::generators
