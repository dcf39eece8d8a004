#include "wordgaze/babyai/minigrid_stages.hpp"

#include "wordgaze/babyai/wording.hpp"

namespace wordgaze::babyai::generators {

using grid::at;
using grid::Color;
using grid::ObjectId;
using grid::Position;
using grid::Type;

void empty_grid(Layout& layout, int width, int height) {
  layout.world.clear(width, height);
  layout.world.grid.wall_rectangle({}, width, height);
}

void empty_grid(Layout& layout) {
  empty_grid(layout, layout.level.room_size, layout.level.room_size);
}

void agent_in_corner(Layout& layout) {
  layout.world.agent = {1, 1};
  layout.world.direction = grid::Direction::right;
}

void goal_in_corner(Layout& layout) {
  const grid::Grid& grid = layout.world.grid;
  put_new(layout, Type::goal, Color::green, at(grid.width() - 2, grid.height() - 2));
}

ObjectId put_new(Layout& layout, Type type, Color color, Position p) {
  const ObjectId id = layout.world.add(type, color);
  layout.world.put(id, p);
  return id;
}

ObjectId put_door(Layout& layout, Color color, Position p) {
  const ObjectId id = layout.world.add(Type::door, color, grid::DoorState::closed);
  layout.world.put(id, p);
  return id;
}

void ask(Layout& layout, std::string_view mission) { layout.task.sentence = sentence_of(mission); }

void say(Sentence& mission, std::string_view text) {
  for (WordId word : sentence_of(text)) mission.append(word, 0);
}

void append_name(Sentence& sentence, const grid::Object& object) {
  sentence.append(word_of(object.color), 0);
  sentence.append(word_of(object.type), 0);
}

}  // namespace wordgaze::babyai::generators
