#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "wordgaze/core/require.hpp"
#include "wordgaze/core/types.hpp"
#include "wordgaze/grid/cell.hpp"
#include "wordgaze/grid/observation.hpp"

namespace wordgaze::model {

inline constexpr int kTypes = 11, kColors = 6, kStates = 3;
inline constexpr int kCellFeatures = kTypes + kColors + kStates;  ///< one-hot rows of a cell
inline constexpr int kMaxCodes = 64;

/// The cells that can occur in a view. A view shows few kinds of cells, so what the network
/// computes per cell it computes once per kind: encodings, keys, scores and input products are
/// tables whose columns are the codes of an alphabet.
class CellAlphabet {
 public:
  struct Code {
    std::uint8_t type, color, state;
    bool operator==(const Code&) const = default;
  };

  /// Rooms without doors: unseen, empty, wall, and key, ball, box in six colors.
  static CellAlphabet one_room() {
    CellAlphabet alphabet;
    alphabet.add_basic();
    return alphabet;
  }
  /// Every cell that MiniGrid's levels can show.
  static CellAlphabet everything() {
    CellAlphabet alphabet;
    alphabet.add_basic();
    constexpr std::uint8_t kFloor = 3, kDoor = 4, kGoal = 8, kLava = 9;
    for (std::uint8_t color = 0; color < kColors; ++color) {
      alphabet.add({kFloor, color, 0});
      for (std::uint8_t state = 0; state < kStates; ++state) alphabet.add({kDoor, color, state});
    }
    alphabet.add({kGoal, 1, 0});
    alphabet.add({kLava, 0, 0});
    return alphabet;
  }

  int size() const { return static_cast<int>(codes_.size()); }
  const Code& operator[](int index) const { return codes_[static_cast<std::size_t>(index)]; }
  bool operator==(const CellAlphabet& other) const { return codes_ == other.codes_; }

  /// -1 when the code is not in the alphabet.
  int find(Code code) const { return index_[slot(code)]; }

  /// Writes the 49 code indices of a view; throws std::invalid_argument on a foreign cell.
  void encode(std::span<const std::uint8_t, grid::kImageBytes> image,
              std::span<std::uint8_t, grid::kViewCells> cells) const {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const Code code{image[3 * i], image[3 * i + 1], image[3 * i + 2]};
      const bool valid = code.type < kTypes && code.color < kColors && code.state < kStates;
      const int index = valid ? index_[slot(code)] : -1;
      require(index >= 0,
              "CellAlphabet: cell {} of the view is ({},{},{}), which is not among the {} codes of "
              "this alphabet; use CellAlphabet::everything() for levels with doors",
              i, code.type, code.color, code.state, size());
      cells[i] = static_cast<std::uint8_t>(index);
    }
  }

 private:
  static std::size_t slot(Code c) {
    return static_cast<std::size_t>((c.type * kColors + c.color) * kStates + c.state);
  }
  void add(Code code) {
    index_[slot(code)] = static_cast<std::int8_t>(codes_.size());
    codes_.push_back(code);
  }
  void add_basic() {
    index_.fill(-1);
    constexpr std::uint8_t kWall = 2, kKey = 5, kBox = 7, kGrey = 5;
    add({0, 0, 0});
    add({1, 0, 0});
    add({kWall, kGrey, 0});
    for (std::uint8_t type = kKey; type <= kBox; ++type) {
      for (std::uint8_t color = 0; color < kColors; ++color) add({type, color, 0});
    }
  }

  std::vector<Code> codes_;
  std::array<std::int8_t, kTypes * kColors * kStates> index_{};
};

/// Indices of the codes in view, one column of 49 cells a frame.
using CellMatrix = Eigen::Matrix<std::uint8_t, grid::kViewCells, Eigen::Dynamic>;

}  // namespace wordgaze::model
