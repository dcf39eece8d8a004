#include "wordgaze/grid/observation.hpp"

#include <cstring>

#include "wordgaze/grid/world.hpp"

namespace wordgaze::grid {
namespace {

constexpr int kCenter = kViewSize / 2;
constexpr int kLast = kViewSize - 1;
constexpr unsigned kRow = (1u << kViewSize) - 1;

// The objects in the view, in the order of the image: [x][y], the agent at x = 3, y = 6.
using View = std::array<ObjectId, kViewCells>;

View view_of(const World& world) {
  // Steps in memory that go one cell ahead, and one to the right.
  const std::ptrdiff_t stride = world.grid.stride();
  const Position d = forward(world.direction);
  const std::ptrdiff_t ahead = d.x + d.y * stride;
  const std::ptrdiff_t aside = -d.y + d.x * stride;
  const ObjectId* column = world.grid.pointer(world.agent) - kCenter * aside + kLast * ahead;
  View view;
  ObjectId* out = view.data();
  for (int x = 0; x < kViewSize; ++x, column += aside) {
    for (int y = 0; y < kViewSize; ++y) *out++ = column[-y * ahead];
  }
  return view;
}

// Everything that touches `lit` through neighbors in `clear`: within a row, sight spreads both
// ways.
unsigned spread(unsigned lit, unsigned clear) {
  // Upward a carry runs through the ones of `clear` from each lit bit.
  unsigned reached = lit | (clear & ~(clear + lit));
  unsigned path = clear;
  for (int step = 1; step < kViewSize; step *= 2) {
    reached |= path & (reached >> step);
    path &= path >> step;
  }
  return reached;
}

// The reference sweeps each row to the right and back, lighting the neighbor and the row beyond as
// it goes. What comes of it: the clear cells connected to a lit one, and all that borders on them
// in this row and the next.
VisibleRows light(const View& view, ObjectSet blockers) {
  std::array<unsigned, kViewSize> clear{};
  for (int x = 0; x < kViewSize; ++x) {
    for (int y = 0; y < kViewSize; ++y) {
      clear[y] |= static_cast<unsigned>(~blockers >> view[x * kViewSize + y] & 1) << x;
    }
  }
  VisibleRows visible{};
  unsigned lit = 1u << kCenter;
  for (int y = kLast; y >= 0; --y) {
    const unsigned seen_through = spread(lit & clear[y], clear[y]);
    const unsigned bordering = (seen_through | seen_through << 1 | seen_through >> 1) & kRow;
    visible[y] = static_cast<std::uint8_t>(lit | bordering);
    lit = bordering;
  }
  return visible;
}

VisibleRows visible_in(const World& world, const View& view) {
  if (!world.see_through_walls) return light(view, world.sight_blockers);
  VisibleRows all;
  all.fill(kRow);
  return all;
}

}  // namespace

VisibleRows visible_cells(const World& world) { return visible_in(world, view_of(world)); }

void observe(const World& world, ImageView image) {
  View view = view_of(world);
  const VisibleRows visible = visible_in(world, view);
  // The agent sees what it carries in its own cell, whatever it stands on.
  view[kCenter * kViewSize + kLast] = world.carried;
  const Object* objects = world.objects.data();
  std::uint8_t* out = image.data();
  for (int x = 0; x < kViewSize; ++x) {
    for (int y = 0; y < kViewSize; ++y, out += 3) {
      const std::uint32_t mask = -(visible[y] >> x & 1u) & 0xffffff;
      std::uint32_t code;
      std::memcpy(&code, &objects[view[x * kViewSize + y]], sizeof code);
      code &= mask;
      // Four bytes at a time: the next cell overwrites the fourth.
      std::memcpy(out, &code, out + 3 == image.data() + kImageBytes ? 3 : 4);
    }
  }
}

}  // namespace wordgaze::grid
