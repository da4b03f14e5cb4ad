// Legends, scale bars and letters over pictures: white with a black outline, letters on bright places black
// with a white one, so that they can be read on any background. Sizes grow with the picture.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

#include <array>
#include <functional>
#include <string>
#include <vector>

namespace slicelens {

/// Pixels of a picture: columns from `left`, rows from `top`.
struct PixelBox {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// How many pixels wide and high one dot of the lettering is: 1 for every 256 pixels of the picture's shorter
/// side, rounded down, at least 1.
int annotation_scale(const Image& image);

/// The largest of 1, 2 and 5·10ⁿ (n whole) that does not exceed `limit` by more than rounding; `limit` > 0.
double round_length(double limit);

/// Multiples of a round step.
struct Ticks {
  double step = 1;
  std::vector<double> values; ///< ascending
};

/// At most `most` (≥ 2) ticks in [low, high], low < high, with the smallest round step that allows it.
Ticks round_ticks(double low, double high, int most);

/// `value` in as few digits as tell it from its neighbours `step` (> 0) away: "-1000", "0.05", "2e+07".
std::string tick_text(double value, double step);

/// What a legend shows: a transfer function over [low, high].
struct Legend {
  double low = 0;                         ///< data units
  double high = 1;                        ///< > low
  std::function<glm::dvec4(double)> rgba; ///< straight colour and opacity, [0,1], of a value in data units
  std::string title;                      ///< a line above it
};

/// Where a legend was drawn. Row i of n shows high − (i + ½)/n · (high − low).
struct LegendPlace {
  PixelBox colors;    ///< opaque colours
  PixelBox opacities; ///< each row light from its right end on, over the share `opacity` of its width
};

/// Draws legends at the picture's right edge, one below the other: opaque colours over the range, the largest
/// value at the top, with round values beside them; left of them their opacities, 0 at the colours and 1 at
/// the far end.
std::vector<LegendPlace> draw_legends(Image& image, const std::vector<Legend>& legends);

/// The columns that draw_legends takes at the right.
int legends_width(const Image& image, const std::vector<Legend>& legends);

/// A length of `pixels` (rounded to whole ones) as a bar at the lower left, its white part that long, with
/// lines of text above it. Returns the white part.
PixelBox draw_scale_bar(Image& image, double pixels, const std::vector<std::string>& text);

/// Letters at the middle of the picture's left, right, upper and lower edge; `taken_right` columns at the
/// right are left free.
void draw_edge_letters(Image& image, const std::array<std::string, 4>& letters, int taken_right);

} // namespace slicelens
