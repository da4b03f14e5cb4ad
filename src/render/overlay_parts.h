// What overlays in 2D and 3D share: colours, and the false colours of a magnification with their bar.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace slicelens {

// They stand out on black, on white and on one another.
inline const glm::vec3 wireframe_color(0.15F, 0.4F, 1.0F);
inline const glm::vec3 lattice_color(1.0F, 0.65F, 0.0F);
inline const glm::vec3 inner_color(1.0F, 0.1F, 0.1F);
inline const glm::vec3 outer_color(0.0F, 0.75F, 0.2F);

/// The lettering of a colour bar, and where on it a magnification of 1 lies.
struct MagnificationBar {
  std::string low;
  std::string high;
  double one = 0;
};

/// Mixes false colours of `magnifications` (one for each pixel, rows from the top, > 0; NaN leaves its
/// pixel), spread over their range on a logarithmic scale.
MagnificationBar draw_magnification(Image& image, const std::vector<double>& magnifications, double opacity);

/// The picture with the bar below it.
Image with_magnification_bar(const Image& image, const MagnificationBar& bar);

} // namespace slicelens
