#include "wordgaze/grid/observation.hpp"

#include <gtest/gtest.h>

#include "grid/drawn_world.hpp"
#include "wordgaze/core/rng.hpp"

namespace wordgaze::grid {
namespace {

using Image = std::array<std::uint8_t, kImageBytes>;

Image observed(const World& world) {
  Image image;
  observe(world, image);
  return image;
}

// The view as the specification tells it, cell by cell. (docs/simulator.md, Views)
struct PlainView {
  explicit PlainView(const World& world) {
    const Position d = forward(world.direction), r{static_cast<std::int16_t>(-d.y), d.x};
    for (int i = 0; i < kViewSize; ++i) {
      for (int j = 0; j < kViewSize; ++j) {
        const int ahead = 6 - j, aside = i - 3;
        const Position p = world.agent + at(d.x * ahead + r.x * aside, d.y * ahead + r.y * aside);
        cells[i][j] = world.grid.contains(p) ? world.object_at(p) : world.object(kWall);
        visible[i][j] = world.see_through_walls;
      }
    }
    if (!world.see_through_walls) find_visible();
    cells[3][6] = world.object(world.carried);
  }

  void find_visible() {
    visible[3][6] = true;
    const auto lets_through = [&](int i, int j) {
      return visible[i][j] && !blocks_sight(cells[i][j]);
    };
    for (int j = 6; j >= 0; --j) {
      for (int i = 0; i <= 5; ++i) {
        if (!lets_through(i, j)) continue;
        visible[i + 1][j] = true;
        if (j > 0) visible[i + 1][j - 1] = visible[i][j - 1] = true;
      }
      for (int i = 6; i >= 1; --i) {
        if (!lets_through(i, j)) continue;
        visible[i - 1][j] = true;
        if (j > 0) visible[i - 1][j - 1] = visible[i][j - 1] = true;
      }
    }
  }

  Image image() const {
    Image out{};
    for (int i = 0; i < kViewSize; ++i) {
      for (int j = 0; j < kViewSize; ++j) {
        if (!visible[i][j]) continue;
        std::uint8_t* cell = &out[3 * (i * kViewSize + j)];
        cell[0] = static_cast<std::uint8_t>(cells[i][j].type);
        cell[1] = static_cast<std::uint8_t>(cells[i][j].color);
        cell[2] = static_cast<std::uint8_t>(cells[i][j].state);
      }
    }
    return out;
  }

  Object cells[kViewSize][kViewSize];
  bool visible[kViewSize][kViewSize];
};

// A world full of anything, agent anywhere, carrying or not.
World random_world(core::Rng& rng) {
  constexpr std::array kTypes{Type::wall, Type::door, Type::key,  Type::ball,
                              Type::box,  Type::goal, Type::lava, Type::floor};
  World world;
  const int width = 3 + rng.below(20), height = 3 + rng.below(20);
  world.clear(width, height);
  std::vector<ObjectId> ids{kNothing, kWall};
  for (int k = 0; k < 30; ++k) {
    const Type type = kTypes[1 + rng.below(7)];
    const auto state = type == Type::door ? static_cast<DoorState>(rng.below(3)) : DoorState::open;
    ids.push_back(world.add(type, static_cast<Color>(rng.below(6)), state));
  }
  const int fullness = rng.below(100), walls = rng.below(100);
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) {
      if (rng.below(100) >= fullness) continue;
      world.put(rng.below(100) < walls ? kWall : ids[2 + rng.below(30)], at(x, y));
    }
  }
  world.agent = at(rng.below(width), rng.below(height));
  world.direction = static_cast<Direction>(rng.below(4));
  if (rng.below(2) == 0) world.carried = ids[rng.below(32)];
  world.see_through_walls = rng.below(8) == 0;
  return world;
}

TEST(Observation, EqualsItsPlainTwinOnRandomWorlds) {
  core::Rng rng(1);
  for (int n = 0; n < 20'000; ++n) {
    const World world = random_world(rng);
    const PlainView plain(world);
    ASSERT_EQ(observed(world), plain.image()) << "world " << n;
    const VisibleRows visible = visible_cells(world);
    for (int i = 0; i < kViewSize; ++i) {
      for (int j = 0; j < kViewSize; ++j) {
        ASSERT_EQ(visible[j] >> i & 1, plain.visible[i][j]) << "world " << n;
      }
    }
  }
}

TEST(Observation, HidesWhatIsBehindAClosedDoor) {
  World world = drawn({"#######",  //
                       "#..>c.B",  //
                       "#######"});
  const auto cell = [](const Image& image, int x, int y) { return Type{image[3 * (7 * x + y)]}; };
  EXPECT_EQ(cell(observed(world), 3, 5), Type::door);
  EXPECT_EQ(cell(observed(world), 3, 3), Type::unseen);
  world.set_door(world.grid[world.front()], DoorState::open);
  EXPECT_EQ(cell(observed(world), 3, 3), Type::ball);
}

TEST(Observation, ShowsTheCarriedObjectInTheAgentsCell) {
  World world = drawn({"####", "#>B#", "####"});
  world.carried = world.grid[world.front()];
  world.grid[world.front()] = kNothing;
  const Image image = observed(world);
  EXPECT_EQ(Type{image[3 * (7 * 3 + 6)]}, Type::ball);
}

TEST(Observation, WritesNothingBehindTheImage) {
  const World world = drawn({"####", "#>B#", "####"});
  std::array<std::uint8_t, kImageBytes + 8> buffer;
  buffer.fill(99);
  observe(world, std::span(buffer).first<kImageBytes>());
  for (std::size_t k = kImageBytes; k < buffer.size(); ++k) EXPECT_EQ(buffer[k], 99);
}

}  // namespace
}  // namespace wordgaze::grid
