// One number for each pixel: what metrics are computed on.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <vector>

namespace slicelens {

/// width × height values, rows from the top.
struct PixelPlane {
  int width = 0;
  int height = 0;
  std::vector<double> values;

  double& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  double at(int x, int y) const { return const_cast<PixelPlane*>(this)->at(x, y); }
};

PixelPlane make_plane(int width, int height);

/// The pixel's colour over an opaque background, in double precision: C + (1 − A)·background.
glm::dvec3 color_over(const Image& image, int x, int y, const glm::dvec3& background);

/// Rec. 709 luma .2126 R + .7152 G + .0722 B of the picture over a background.
PixelPlane luma_plane(const Image& image, const glm::dvec3& background);

/// Σ_i Σ_j across[i]·down[j]·plane(x + i − n, y + j − m) with the middles n, m of the kernels (odd lengths):
/// a correlation, so kernels are not turned round. Beyond the border the outermost pixels go on.
PixelPlane filtered(const PixelPlane& plane, const std::vector<double>& across,
                    const std::vector<double>& down);

} // namespace slicelens
