// Pictures made by formula, for showing what a lens does. The same size gives the same values on every
// machine up to rounding.
#pragma once

#include "image/image.h"

namespace slicelens {

/// `squares` squares of black and white along the longer edge, white at the top left corner; each pixel takes
/// the square that its centre lies in. Sizes and squares must be positive; LimitError as make_image.
Image checkerboard(int width, int height, int squares);

/// A colour picture with detail of all sizes: a hue wheel with 36 spokes (Siemens star) in the middle, a zone
/// plate in the top left quarter, gratings of 16 to 2 pixels at the top right, rows of discs that shrink to
/// one pixel at the bottom left, lettering at the bottom right, and a fine grid over a smooth colour gradient
/// behind them. Opaque, values in [0,1].
Image test_card(int width, int height);

} // namespace slicelens
