#include "wordgaze/draw/tile.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "wordgaze/core/crc32.hpp"
#include "wordgaze/env/environment.hpp"

namespace wordgaze::draw {
namespace {

std::uint32_t crc(const Image& image) { return crc32(std::span<const std::uint8_t>(image.rgb)); }

/// The lines of a golden file of scripts/golden/render.py, without its head.
std::vector<std::string> golden_lines(const std::string& name) {
  std::ifstream file(WORDGAZE_TEST_DATA "/draw/" + name);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with('#')) lines.push_back(line);
  }
  return lines;
}

TEST(Tile, EqualsTheReferences) {
  const auto lines = golden_lines("tiles.txt");
  ASSERT_EQ(lines.size(), 636u);
  for (const std::string& line : lines) {
    std::istringstream fields(line);
    int type, color, state, agent, highlight, size;
    std::uint32_t expected;
    ASSERT_TRUE(fields >> type >> color >> state >> agent >> highlight >> size >> expected);
    Tile tile{static_cast<grid::Type>(type), static_cast<grid::Color>(color),
              static_cast<grid::DoorState>(state)};
    if (agent >= 0) tile.agent = static_cast<grid::Direction>(agent);
    tile.highlight = highlight == 1;
    EXPECT_EQ(crc(render(tile, size)), expected) << line;
  }
}

TEST(Tile, RefusesASizeThatIsNotPositive) {
  EXPECT_THROW(render(Tile{}, 0), std::invalid_argument);
  EXPECT_THROW(TileRenderer(-1), std::invalid_argument);
}

TEST(TileRenderer, DrawsWorldsAndViewsAsTheReference) {
  TileRenderer small(8), large(32);
  const auto lines = golden_lines("frames.txt");
  EXPECT_GE(lines.size(), 172u);
  for (const std::string& line : lines) {
    std::istringstream fields(line);
    std::string id, actions;
    std::uint64_t seed;
    std::uint32_t world8, world32, plain, view8, view32;
    ASSERT_TRUE(fields >> id >> seed >> actions >> world8 >> world32 >> plain >> view8 >> view32);
    env::Environment env(id);
    env.reset(seed);
    for (const char action : actions) {
      if (action != '-') env.step(static_cast<grid::Action>(action - '0'));
    }
    std::array<std::uint8_t, grid::kImageBytes> image;
    env.observe(image);
    EXPECT_EQ(crc(small.world(env.world())), world8) << line;
    EXPECT_EQ(crc(large.world(env.world())), world32) << line;
    EXPECT_EQ(crc(small.world(env.world(), false)), plain) << line;
    EXPECT_EQ(crc(small.view(image)), view8) << line;
    EXPECT_EQ(crc(large.view(image)), view32) << line;
  }
}

TEST(TileRenderer, RendersATileOnlyOnce) {
  TileRenderer renderer(8);
  const Tile ball{.type = grid::Type::ball};
  const Image* first = &renderer.tile(ball);
  EXPECT_NE(&renderer.tile(Tile{.type = grid::Type::box}), first);
  EXPECT_EQ(&renderer.tile(ball), first);
}

}  // namespace
}  // namespace wordgaze::draw
