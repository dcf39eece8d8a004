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
    const ObjectSet blockers = world.sight_blockers;
    for (int x = 0; x < kViewSize; ++x, column += aside) {
      Bits blocked_column = 0;
      for (int y = kLast; y >= 0; --y) {
        const ObjectId id = column[-y * ahead];
        ids[x * kViewSize + y] = id;
        blocked_column = 2 * blocked_column + (blockers >> id & 1);
      }
      blocked |= blocked_column << 8 * x;
    }
  }

  // The reference sweeps each row to the right and back, lighting neighbors in this row and the
  // next as it goes; kSpread is what comes of it.
  Bits visible() const {
    const Bits clear_rows = transposed(~blocked);
    Bits visible_rows = 0;
    unsigned lit = 1u << kCenter;
    for (int y = kLast; y >= 0; --y) {
      const unsigned spread = kSpread[clear_rows >> 8 * y & kRow][lit];
      visible_rows = visible_rows << 8 | lit | spread;
      lit = spread;
    }
    return transposed(visible_rows);
  }
};

}  // namespace

VisibleRows visible_cells(const World& world) {
  VisibleRows rows;
  const Bits visible = transposed(world.see_through_walls ? ~Bits{0} : View(world).visible());
  for (int y = 0; y < kViewSize; ++y) rows[y] = static_cast<std::uint8_t>(visible >> 8 * y & kRow);
  return rows;
}

void observe(const World& world, ImageView image) {
  View view(world);
  const Bits visible = world.see_through_walls ? ~Bits{0} : view.visible();
  // The agent sees what it carries in its own cell, whatever it stands on.
  view.ids[kCenter * kViewSize + kLast] = world.carried;
  const Object* objects = world.objects.data();
  // Four bytes at a time, the fourth to be overwritten by the next cell.
  const auto write_column = [&](int x, std::uint8_t* out) {
    const auto seen = static_cast<std::uint32_t>(visible >> 8 * x);
    for (int y = 0; y < kViewSize; ++y) {
      std::uint32_t code;
      std::memcpy(&code, &objects[view.ids[x * kViewSize + y]], sizeof code);
      code = (seen & 1u << y) != 0 ? code : 0;
      std::memcpy(out + 3 * y, &code, sizeof code);
    }
  };
  constexpr int kColumnBytes = 3 * kViewSize;
  for (int x = 0; x < kLast; ++x) write_column(x, image.data() + kColumnBytes * x);
  // Nothing may be written behind the last cell.
  std::array<std::uint8_t, kColumnBytes + 1> last;
  write_column(kLast, last.data());
  std::memcpy(image.data() + kColumnBytes * kLast, last.data(), kColumnBytes);
}

}  // namespace wordgaze::grid
