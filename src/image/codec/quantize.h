// From associated floats to the unassociated integers of a PNG.
#pragma once

#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace slicelens {

/// `value` clamped to [0,1] and scaled to the full range of T, rounded to the nearest; NaN gives 0.
template <class T>
T quantize(double value) {
  const double largest = std::numeric_limits<T>::max();
  if (!(value > 0))
    return 0;
  return static_cast<T>(std::lround(std::min(value, 1.0) * largest));
}

/// RGBA with unassociated colour. What rounds to a transparent pixel is black, so that reading the file and
/// writing it again gives the same values.
template <class T>
std::vector<T> unassociated(const Image& image) {
  std::vector<T> values(image.pixels.size());
  for (std::size_t i = 0; i < values.size(); i += 4) {
    const double alpha = std::min(static_cast<double>(image.pixels[i + 3]), 1.0);
    values[i + 3] = quantize<T>(alpha);
    for (std::size_t c = 0; c < 3; ++c)
      values[i + c] =
          values[i + 3] > 0 ? quantize<T>(static_cast<double>(image.pixels[i + c]) / alpha) : T{0};
  }
  return values;
}

} // namespace slicelens
