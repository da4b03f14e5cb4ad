// FLIP: how visible the differences of two pictures are when they alternate in place.
#pragma once

#include "image/image.h"
#include "study/planes.h"

#include <glm/glm.hpp>

namespace slicelens {

/// Pixels in one degree of the visual field, of a display `width` metres and `pixels` wide seen from
/// `distance` metres (Andersson et al. 2020, §3): distance·(pixels/width)·π/180.
double pixels_per_degree(double distance, double pixels, double width);

/// The paper's display, 0.7 m and 3840 pixels wide at 0.7 m: 67.02.
inline constexpr double default_pixels_per_degree = 3840 * 3.14159265358979323846 / 180;

/// FLIP's error at each pixel, in [0,1], of two pictures over their backgrounds: Andersson, Nilsson,
/// Akenine-Möller, Oskarsson, Åström and Fairchild, "FLIP: A Difference Evaluator for Alternating Images",
/// Proc. ACM Comput. Graph. Interact. Tech. 3(2) 2020. Values are read as sRGB (display space) and clamped to
/// [0,1] first, as the authors' program does. Symmetric in the two. The kernels and the border's rule
/// (outermost pixels go on) are those of that program too.
///
/// Throws UsageError for different sizes, no pixels, or pixels per degree that are not from 1 to 1000.
PixelPlane flip_errors(const Image& a, const Image& b, const glm::dvec3& background_a = glm::dvec3(0),
                       const glm::dvec3& background_b = glm::dvec3(0),
                       double pixels_per_degree = default_pixels_per_degree);

/// Mean of the errors: the number that the paper calls FLIP of two pictures.
double mean_of(const PixelPlane& plane);

/// The errors as an opaque picture, black (0) to pale yellow (1) by heat_color.
Image flip_picture(const PixelPlane& errors);

/// HyAB distance in Hunt-adjusted L*a*b* of two linear sRGB colours (§4.1), without the exponent. Largest in
/// the sRGB cube between green and blue.
double hunt_hyab(const glm::dvec3& a, const glm::dvec3& b);

} // namespace slicelens
