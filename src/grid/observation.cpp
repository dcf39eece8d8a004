#include "wordgaze/grid/observation.hpp"

#include "view.hpp"

namespace wordgaze::grid {
namespace {

// What is lit from a row of cells, in that row and the next: the lit cells that are clear, the
// clear cells connected to them, and all neighbors of these. By clear and lit cells.
constexpr auto kSpread = [] {
  std::array<std::array<std::uint8_t, kRow + 1>, kRow + 1> spread{};
  for (unsigned clear = 0; clear <= kRow; ++clear) {
    for (unsigned lit = 0; lit <= kRow; ++lit) {
      unsigned reached = lit & clear;
      for (int k = 1; k < kViewSize; ++k) reached |= (reached << 1 | reached >> 1) & clear;
      spread[clear][lit] =
          static_cast<std::uint8_t>((reached | reached << 1 | reached >> 1) & kRow);
    }
  }
  return spread;
}();

// The places that are seen. The reference sweeps each row to the right and back, lighting neighbors
// in this row and the next as it goes; kSpread is what comes of it.
Places visible(const World& world, const View& view) {
  if (world.see_through_walls) return kAllPlaces;
  const Places clear = ~view.blocked();
  Places visible = 0;
  unsigned lit = 1u << kCenter;
  for (int y = kLast; y >= 0; --y) {
    const unsigned spread = kSpread[clear >> 8 * y & kRow][lit];
    visible = visible << 8 | lit | spread;
    lit = spread;
  }
  return visible;
}

}  // namespace

VisibleRows visible_cells(const World& world) {
  VisibleRows rows;
  const Places seen = visible(world, View(world));
  for (int y = 0; y < kViewSize; ++y) rows[y] = static_cast<std::uint8_t>(seen >> 8 * y & kRow);
  return rows;
}

void observe(const World& world, ImageView image) {
  View view(world);
  view.hide_all_but(visible(world, view));
  // The agent sees what it carries in its own cell, whatever it stands on.
  view.show(world.looks[world.carried]);
  view.write(image);
}

void write_cells(const World& world, std::vector<std::uint8_t>& cells) {
  cells.clear();
  for (int x = 0; x < world.grid.width(); ++x) {
    for (int y = 0; y < world.grid.height(); ++y) {
      const auto code = code_of(world.object_at(at(x, y)));
      cells.insert(cells.end(), code.begin(), code.end());
    }
  }
}

}  // namespace wordgaze::grid
