#pragma once
#include "wordgaze/draw/image.hpp"

namespace wordgaze::draw {

/// "magma" of matplotlib (CC0), from black to a light yellow: equal steps in value look equal, also
/// without color. Values outside [0, 1] are taken to the nearest end, NaN to 0.
Rgb magma(double value);

}  // namespace wordgaze::draw
