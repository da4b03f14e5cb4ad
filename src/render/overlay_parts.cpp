#include "render/overlay_parts.h"

#include "image/overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace slicelens {

namespace {

/// "0.42X": two digits are enough to read a bar.
std::string times_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2gX", value);
  return text;
}

} // namespace

MagnificationBar draw_magnification(Image& image, const std::vector<double>& magnifications, double opacity) {
  double low = 1;
  double high = 1;
  for (const double m : magnifications) {
    if (!std::isfinite(m))
      continue;
    low = std::min(low, m);
    high = std::max(high, m);
  }
  if (high / low < 1.01) { // no lens to speak of: 1 in the middle of an octave
    low /= std::sqrt(2.0);
    high *= std::sqrt(2.0);
  }
  const double octaves = std::log2(high / low);
  std::vector<double> values;
  for (const double m : magnifications)
    values.push_back((std::log2(m) - std::log2(low)) / octaves);
  draw_false_color(image, values, opacity);
  return {times_text(low), times_text(high), std::log2(1 / low) / octaves};
}

Image with_magnification_bar(const Image& image, const MagnificationBar& bar) {
  return with_color_bar(image, bar.low, bar.high, times_text(1), bar.one);
}

} // namespace slicelens
