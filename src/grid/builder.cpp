#include "wordgaze/grid/builder.hpp"

namespace wordgaze::grid {

void Builder::place_agent(Position corner, int width, int height, int max_tries) {
  world.agent = kNowhere;
  world.agent = place(kNothing, corner, width, height, max_tries);
  world.direction = static_cast<Direction>(rng.below(4));
}

}  // namespace wordgaze::grid
