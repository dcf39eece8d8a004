#pragma once
#include "wordgaze/draw/image.hpp"

namespace wordgaze::draw {

/// "magma" of matplotlib (CC0), from black to a light yellow: equal steps in value look equal, also
/// without color. Values outside [0, 1] are taken to the nearest end, NaN to 0.
Rgb magma(double value);

/// Where a share between 0 and 1 lies on the color bar, from 0 to 1 as well. The square root: an
/// even share of 49 cells, .02, is then still dark and yet not black. The same in every picture, so
/// that colors of two pictures can be compared.
double place_on_bar(double share);

/// The color of a share.
Rgb heat(double share);

}  // namespace wordgaze::draw
