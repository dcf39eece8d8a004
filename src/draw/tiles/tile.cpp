#include "wordgaze/draw/tile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "wordgaze/core/require.hpp"

// As the reference's utils/rendering.py and core/world_object.py, down to the rounding of each
// intermediate result: this file is compiled without fused multiply-add.
namespace wordgaze::draw {
namespace {

constexpr int kSamples = 3;  // per pixel, in each direction
constexpr Rgb kBlack{0, 0, 0};
constexpr Rgb kGridLine{100, 100, 100};
constexpr Rgb kAgent{255, 0, 0};
constexpr Rgb kLava{255, 128, 0};

/// The point sets of which tiles are made. Coordinates go from 0 to 1, y downward.
auto rectangle(double x0, double x1, double y0, double y1) {
  return [=](double x, double y) { return x >= x0 && x <= x1 && y >= y0 && y <= y1; };
}

auto circle(double cx, double cy, double radius) {
  return [=](double x, double y) {
    return (x - cx) * (x - cx) + (y - cy) * (y - cy) <= radius * radius;
  };
}

/// A thick line with round ends. The reference keeps its end points in single precision.
auto segment(double x0, double y0, double x1, double y1, double radius) {
  const auto start_x = static_cast<float>(x0), start_y = static_cast<float>(y0);
  float direction_x = static_cast<float>(x1) - start_x;
  float direction_y = static_cast<float>(y1) - start_y;
  const float length = std::sqrt(direction_x * direction_x + direction_y * direction_y);
  direction_x /= length;
  direction_y /= length;
  const auto box = rectangle(std::min(x0, x1) - radius, std::max(x0, x1) + radius,
                             std::min(y0, y1) - radius, std::max(y0, y1) + radius);
  return [=](double x, double y) {
    if (!box(x, y)) return false;
    const double along = std::clamp((x - start_x) * direction_x + (y - start_y) * direction_y, 0.0,
                                    static_cast<double>(length));
    const double dx = x - (start_x + along * direction_x);
    const double dy = y - (start_y + along * direction_y);
    return std::sqrt(dx * dx + dy * dy) <= radius;
  };
}

/// The triangle that is the agent, looking right; by barycentric coordinates, partly in single
/// precision.
bool in_agent(double x, double y) {
  constexpr float ax = 0.12f, ay = 0.19f, bx = 0.87f, by = 0.50f, cx = 0.12f, cy = 0.81f;
  const float v0x = cx - ax, v0y = cy - ay;
  const float v1x = bx - ax, v1y = by - ay;
  const double v2x = x - ax, v2y = y - ay;
  const float dot00 = v0x * v0x + v0y * v0y;
  const float dot01 = v0x * v1x + v0y * v1y;
  const double dot02 = v0x * v2x + v0y * v2y;
  const float dot11 = v1x * v1x + v1y * v1y;
  const double dot12 = v1x * v2x + v1y * v2y;
  const float scale = 1 / (dot00 * dot11 - dot01 * dot01);
  const double u = (dot11 * dot02 - dot01 * dot12) * scale;
  const double v = (dot00 * dot12 - dot01 * dot02) * scale;
  return u >= 0 && v >= 0 && u + v < 1;
}

auto agent(grid::Direction direction) {
  const double angle = -(0.5 * std::numbers::pi * static_cast<int>(direction));
  const double cosine = std::cos(angle), sine = std::sin(angle);
  return [=](double x, double y) {
    const double dx = x - 0.5, dy = y - 0.5;
    return in_agent(0.5 + dx * cosine - dy * sine, 0.5 + dy * cosine + dx * sine);
  };
}

/// A tile before averaging.
class Samples {
 public:
  explicit Samples(int size) : image_(size * kSamples, size * kSamples) {}

  template <class PointSet>
  void fill(PointSet contains, Rgb color) {
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        if (contains((x + 0.5) / image_.width, (y + 0.5) / image_.height)) {
          std::ranges::copy(color, image_.pixel(x, y));
        }
      }
    }
  }

  void highlight() {
    for (std::uint8_t& v : image_.rgb) v = static_cast<std::uint8_t>(v + 0.30 * (255 - v));
  }

  Image averaged() const {
    Image tile(image_.width / kSamples, image_.height / kSamples);
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; ++x) {
        for (int channel = 0; channel < 3; ++channel) {
          double sum = 0;
          for (int row = 0; row < kSamples; ++row) {
            const std::uint8_t* p = image_.pixel(x * kSamples, y * kSamples + row) + channel;
            sum += (p[0] + p[3] + p[6]) / 3.0;
          }
          tile.pixel(x, y)[channel] = static_cast<std::uint8_t>(sum / 3.0);
        }
      }
    }
    return tile;
  }

 private:
  Image image_;
};

/// Channels are cut to whole numbers, as when the reference stores them.
Rgb scaled(Rgb color, double factor) {
  for (std::uint8_t& channel : color) channel = static_cast<std::uint8_t>(factor * channel);
  return color;
}

void draw_lava(Samples& samples) {
  samples.fill(rectangle(0, 1, 0, 1), kLava);
  for (int wave = 0; wave < 3; ++wave) {
    const double low = 0.3 + 0.2 * wave, high = 0.4 + 0.2 * wave;
    samples.fill(segment(0.1, low, 0.3, high, 0.03), kBlack);
    samples.fill(segment(0.3, high, 0.5, low, 0.03), kBlack);
    samples.fill(segment(0.5, low, 0.7, high, 0.03), kBlack);
    samples.fill(segment(0.7, high, 0.9, low, 0.03), kBlack);
  }
}

void draw_door(Samples& samples, Rgb color, grid::DoorState state) {
  switch (state) {
    case grid::DoorState::open:
      samples.fill(rectangle(0.88, 1, 0, 1), color);
      samples.fill(rectangle(0.92, 0.96, 0.04, 0.96), kBlack);
      break;
    case grid::DoorState::locked:
      samples.fill(rectangle(0, 1, 0, 1), color);
      samples.fill(rectangle(0.06, 0.94, 0.06, 0.94), scaled(color, 0.45));
      samples.fill(rectangle(0.52, 0.75, 0.50, 0.56), color);
      break;
    case grid::DoorState::closed:
      samples.fill(rectangle(0, 1, 0, 1), color);
      samples.fill(rectangle(0.04, 0.96, 0.04, 0.96), kBlack);
      samples.fill(rectangle(0.08, 0.92, 0.08, 0.92), color);
      samples.fill(rectangle(0.12, 0.88, 0.12, 0.88), kBlack);
      samples.fill(circle(0.75, 0.50, 0.08), color);
      break;
  }
}

void draw_key(Samples& samples, Rgb color) {
  samples.fill(rectangle(0.50, 0.63, 0.31, 0.88), color);
  samples.fill(rectangle(0.38, 0.50, 0.59, 0.66), color);
  samples.fill(rectangle(0.38, 0.50, 0.81, 0.88), color);
  samples.fill(circle(0.56, 0.28, 0.190), color);
  samples.fill(circle(0.56, 0.28, 0.064), kBlack);
}

void draw_box(Samples& samples, Rgb color) {
  samples.fill(rectangle(0.12, 0.88, 0.12, 0.88), color);
  samples.fill(rectangle(0.18, 0.82, 0.18, 0.82), kBlack);
  samples.fill(rectangle(0.16, 0.84, 0.47, 0.53), color);
}

void draw_object(Samples& samples, const Tile& tile) {
  const Rgb color = rgb(tile.color);
  switch (tile.type) {
    case grid::Type::unseen:
    case grid::Type::empty:
    case grid::Type::agent:
      break;
    case grid::Type::wall:
    case grid::Type::goal:
      samples.fill(rectangle(0, 1, 0, 1), color);
      break;
    case grid::Type::floor:
      samples.fill(rectangle(0.031, 1, 0.031, 1), scaled(color, 0.5));
      break;
    case grid::Type::lava:
      draw_lava(samples);
      break;
    case grid::Type::door:
      draw_door(samples, color, tile.state);
      break;
    case grid::Type::key:
      draw_key(samples, color);
      break;
    case grid::Type::ball:
      samples.fill(circle(0.5, 0.5, 0.31), color);
      break;
    case grid::Type::box:
      draw_box(samples, color);
      break;
  }
}

Tile tile_of(const grid::Object& object) {
  return {.type = object.type, .color = object.color, .state = object.state};
}

}  // namespace

Rgb rgb(grid::Color color) {
  switch (color) {
    case grid::Color::red:
      return {255, 0, 0};
    case grid::Color::green:
      return {0, 255, 0};
    case grid::Color::blue:
      return {0, 0, 255};
    case grid::Color::purple:
      return {112, 39, 195};
    case grid::Color::yellow:
      return {255, 255, 0};
    case grid::Color::grey:
      return {100, 100, 100};
  }
  return kBlack;
}

Tile seen_tile(std::span<const std::uint8_t, grid::kImageBytes> image, int x, int y) {
  const auto cell = image.subspan(static_cast<std::size_t>(x * grid::kViewSize + y) * 3, 3);
  Tile tile{.type = static_cast<grid::Type>(cell[0]),
            .color = static_cast<grid::Color>(cell[1]),
            .state = static_cast<grid::DoorState>(cell[2])};
  if (x == grid::kViewSize / 2 && y == grid::kViewSize - 1) tile.agent = grid::Direction::up;
  return tile;
}

Image render(const Tile& tile, int size) {
  require(size > 0, "render: expected a tile of at least one pixel; came {}", size);
  Samples samples(size);
  samples.fill(rectangle(0, 0.031, 0, 1), kGridLine);
  samples.fill(rectangle(0, 1, 0, 0.031), kGridLine);
  draw_object(samples, tile);
  if (tile.agent) samples.fill(agent(*tile.agent), kAgent);
  if (tile.highlight) samples.highlight();
  return samples.averaged();
}

TileRenderer::TileRenderer(int tile_size) : tile_size_(tile_size) {
  require(tile_size > 0, "TileRenderer: expected tiles of at least one pixel; came {}", tile_size);
}

const Image& TileRenderer::tile(const Tile& tile) {
  const auto known = tiles_.find(tile);
  return known != tiles_.end() ? known->second
                               : tiles_.emplace(tile, render(tile, tile_size_)).first->second;
}

Image TileRenderer::world(const grid::World& world, bool highlight) {
  // The corner of the view and the steps that go one view cell to the right and one down.
  const grid::Position ahead = forward(world.direction);
  const grid::Position right = forward(turned(world.direction, 1));
  const grid::VisibleRows visible = visible_cells(world);
  const auto seen = [&](grid::Position p) {
    const grid::Position d = p - world.agent;
    const int x = d.x * right.x + d.y * right.y + grid::kViewSize / 2;
    const int y = grid::kViewSize - 1 - (d.x * ahead.x + d.y * ahead.y);
    const bool inside = x >= 0 && x < grid::kViewSize && y >= 0 && y < grid::kViewSize;
    return inside && (visible[static_cast<std::size_t>(y)] >> x & 1) != 0;
  };

  Image frame(world.grid.width() * tile_size_, world.grid.height() * tile_size_);
  for (int y = 0; y < world.grid.height(); ++y) {
    for (int x = 0; x < world.grid.width(); ++x) {
      const grid::Position p = grid::at(x, y);
      Tile here = tile_of(world.object_at(p));
      if (p == world.agent) here.agent = world.direction;
      here.highlight = highlight && seen(p);
      frame.paste(tile(here), x * tile_size_, y * tile_size_);
    }
  }
  return frame;
}

Image TileRenderer::view(std::span<const std::uint8_t, grid::kImageBytes> image, bool highlight) {
  Image frame(grid::kViewSize * tile_size_, grid::kViewSize * tile_size_);
  for (int x = 0; x < grid::kViewSize; ++x) {
    for (int y = 0; y < grid::kViewSize; ++y) {
      Tile here = seen_tile(image, x, y);
      here.highlight = highlight && here.type != grid::Type::unseen;
      frame.paste(tile(here), x * tile_size_, y * tile_size_);
    }
  }
  return frame;
}

}  // namespace wordgaze::draw
