#include "wordgaze/grid/observation.hpp"

#include <bit>
#include <cstring>

#include "wordgaze/grid/world.hpp"

namespace wordgaze::grid {
namespace {

static_assert(std::endian::native == std::endian::little, "codes are copied as 32-bit words");

constexpr int kCenter = kViewSize / 2;
constexpr int kLast = kViewSize - 1;
constexpr unsigned kRow = (1u << kViewSize) - 1;

// One bit for each cell of the view: bit 8 x + y, so that a column of the image is a byte.
using Bits = std::uint64_t;
constexpr int bit_of(int x, int y) { return 8 * x + y; }

// Exchanges rows and columns of 8 x 8 bits, block by block.
constexpr Bits transposed(Bits bits) {
  Bits swap = (bits ^ bits >> 7) & 0x00AA00AA00AA00AA;
  bits ^= swap ^ swap << 7;
  swap = (bits ^ bits >> 14) & 0x0000CCCC0000CCCC;
  bits ^= swap ^ swap << 14;
  swap = (bits ^ bits >> 28) & 0x00000000F0F0F0F0;
  return bits ^ swap ^ swap << 28;
}

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

// What the agent looks at, and which of it blocks its sight.
struct View {
  std::array<ObjectId, kViewCells> ids;  // in the order of the image: [x][y]
  Bits blocked = 0;

  explicit View(const World& world) {
    // Steps in memory that go one cell ahead, and one to the right.
    const std::ptrdiff_t stride = world.grid.stride();
    const Position d = forward(world.direction);
    const std::ptrdiff_t ahead = d.x + d.y * stride;
    const std::ptrdiff_t aside = -d.y + d.x * stride;
    const ObjectId* column = world.grid.pointer(world.agent) - kCenter * aside + kLast * ahead;
    ObjectId* out = ids.data();
    for (int x = 0; x < kViewSize; ++x, column += aside) {
      for (int y = 0; y < kViewSize; ++y) {
        const ObjectId id = column[-y * ahead];
        *out++ = id;
        blocked |= (world.sight_blockers >> id & 1) << bit_of(x, y);
      }
    }
  }

  // The reference sweeps each row to the right and back, lighting neighbors in this row and the
  // next as it goes; kSpread is what comes of it.
  VisibleRows visible_rows() const {
    const Bits blocked_rows = transposed(blocked);
    VisibleRows visible{};
    unsigned lit = 1u << kCenter;
    for (int y = kLast; y >= 0; --y) {
      const unsigned clear = ~(blocked_rows >> 8 * y) & kRow;
      const unsigned spread = kSpread[clear][lit];
      visible[y] = static_cast<std::uint8_t>(lit | spread);
      lit = spread;
    }
    return visible;
  }

  Bits visible() const {
    Bits rows = 0;
    const VisibleRows visible = visible_rows();
    std::memcpy(&rows, visible.data(), sizeof visible);
    return transposed(rows);
  }
};

}  // namespace

VisibleRows visible_cells(const World& world) {
  if (!world.see_through_walls) return View(world).visible_rows();
  VisibleRows all;
  all.fill(kRow);
  return all;
}

void observe(const World& world, ImageView image) {
  View view(world);
  const Bits visible = world.see_through_walls ? ~Bits{0} : view.visible();
  // The agent sees what it carries in its own cell, whatever it stands on.
  view.ids[kCenter * kViewSize + kLast] = world.carried;
  const Object* objects = world.objects.data();
  const ObjectId* id = view.ids.data();
  std::array<std::uint8_t, kImageBytes + 1> codes;
  std::uint8_t* out = codes.data();
  for (int x = 0; x < kViewSize; ++x) {
    for (int y = 0; y < kViewSize; ++y, ++id, out += 3) {
      const auto seen = -static_cast<std::uint32_t>(visible >> bit_of(x, y) & 1);
      std::uint32_t code;
      std::memcpy(&code, &objects[*id], sizeof code);
      code &= seen;
      // Four bytes at a time: the next cell overwrites the fourth.
      std::memcpy(out, &code, sizeof code);
    }
  }
  std::memcpy(image.data(), codes.data(), kImageBytes);
}

}  // namespace wordgaze::grid
