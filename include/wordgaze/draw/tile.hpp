#pragma once
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "wordgaze/draw/image.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/grid/observation.hpp"
#include "wordgaze/grid/position.hpp"
#include "wordgaze/grid/world.hpp"

/// MiniGrid's own look, byte for byte as the reference renders it.
namespace wordgaze::draw {

/// MiniGrid's color of that name.
Rgb rgb(grid::Color color);

/// All that the picture of one cell depends on, besides its size.
struct Tile {
  grid::Type type = grid::Type::empty;
  grid::Color color = grid::Color::red;
  grid::DoorState state = grid::DoorState::open;
  std::optional<grid::Direction> agent{};  ///< where the agent looks that stands in the cell
  bool highlight = false;                  ///< the agent sees the cell

  auto operator<=>(const Tile&) const = default;
};

/// What the agent sees at (x, y) of its view; it stands in its own cell itself.
Tile seen_tile(std::span<const std::uint8_t, grid::kImageBytes> image, int x, int y);

/// The tile in `size` x `size` pixels: shapes sampled 3 x 3 times a pixel, then averaged. Throws
/// std::invalid_argument for a size that is not positive.
Image render(const Tile& tile, int size);

/// Renders worlds and views of one tile size, each different tile only once.
class TileRenderer {
 public:
  explicit TileRenderer(int tile_size);

  int tile_size() const { return tile_size_; }
  const Image& tile(const Tile& tile);

  /// The whole grid with the agent, what it sees highlighted: the reference's frame.
  Image world(const grid::World& world, bool highlight = true);

  /// What the agent sees, from its observation: the reference's frame with agent_pov.
  Image view(std::span<const std::uint8_t, grid::kImageBytes> image, bool highlight = true);

 private:
  int tile_size_;
  std::map<Tile, Image> tiles_;
};

}  // namespace wordgaze::draw
