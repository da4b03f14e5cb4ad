// Lines and false colours over pictures.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// A line through points in pixels: (0,0) is the picture's top left corner, pixel centres are at +½.
using PixelLine = std::vector<glm::dvec2>;

/// Draws the lines, `width` pixels wide with round ends, as one layer of opaque `color` (display space): a
/// pixel takes the largest share that any of them covers of it, width/2 + ½ − distance clamped to [0,1], so
/// crossings and joints are not drawn twice. Parts outside the picture, and points that are not finite, are
/// left out.
void draw_lines(Image& image, const std::vector<PixelLine>& lines, double width, const glm::vec3& color);

/// Mixes `opacity` of heat_color(values[i]) into pixel i, rows from the top; a value of NaN leaves its pixel.
/// Throws UsageError unless there is one value for each pixel.
void draw_false_color(Image& image, const std::vector<double>& values, double opacity);

/// The picture with a bar of heat_color below it, color_bar_height rows high: `low` and `high` lettered at
/// its ends, and `mark` at the value `mark_at` in [0,1] when given.
Image with_color_bar(const Image& image, const std::string& low, const std::string& high,
                     const std::string& mark = "", std::optional<double> mark_at = std::nullopt);

/// Rows that with_color_bar adds.
inline constexpr int color_bar_height = 22;

} // namespace slicelens
