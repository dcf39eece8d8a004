#pragma once
#include "wordgaze/draw/image.hpp"

/// The colors of figures that mean something, or the same everywhere.
namespace wordgaze::draw {

inline constexpr Rgb kWhite{255, 255, 255};
inline constexpr Rgb kInk{28, 30, 36};
inline constexpr Rgb kSoftInk{105, 110, 122};
inline constexpr Rgb kPale{176, 180, 190};
inline constexpr Rgb kFaint{222, 225, 231};
inline constexpr Rgb kAccent{200, 60, 90};
inline constexpr Rgb kCalm{76, 110, 160};
inline constexpr Rgb kTarget{0, 225, 255};  // neither a color of MiniGrid nor of a heat map
inline constexpr Rgb kAlarm{176, 0, 32};

}  // namespace wordgaze::draw
