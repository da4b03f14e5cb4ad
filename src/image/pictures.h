// Pictures made from pictures: over a background, resized, compared, side by side.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace slicelens {

/// `image` over an opaque display-space colour: C + (1 − A)·background, alpha 1. Keeps the metadata.
Image over_background(const Image& image, const glm::vec3& background);

/// |a − b|·factor for each of R, G, B (associated values, so both as if over black), opaque, not clamped.
/// Throws UsageError for different sizes.
Image difference_image(const Image& a, const Image& b, double factor);

/// The largest of |a − b| over R, G, B at each pixel, as heat_color(error / scale). Errors of `scale` and
/// more have the map's last colour, NaN is white. Under the a.height rows of the map lies a colour bar with
/// its ends' values, heat_map_bar_height rows high. Throws UsageError for different sizes or a scale that is
/// not positive.
Image heat_map(const Image& a, const Image& b, double scale);

/// Rows that heat_map adds under the map.
inline constexpr int heat_map_bar_height = 22;

/// `image` at another size: every new pixel is the mean of the area that it covers in the old one (exact,
/// with partly covered pixels by their share). Keeps the metadata. Throws UsageError for a size below 1×1.
Image resize(const Image& image, int width, int height);

/// Pictures in rows of `columns`, each centred in a cell as large as the largest one, with `padding` pixels
/// around every cell, over `background`. Captions (none, or one for each picture) are lettered below their
/// pictures and cut to the cell's width. Throws UsageError without pictures, for columns < 1, padding < 0, or
/// another number of captions than of pictures.
Image contact_sheet(const std::vector<Image>& images, const std::vector<std::string>& captions, int columns,
                    int padding, const glm::vec3& background);

} // namespace slicelens
