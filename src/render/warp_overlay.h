// Overlays of warps that have no triangles of their own: lines and magnifications of the whole chain of
// warps.
#pragma once

#include "render/prepare.h"
#include "tess/overlay_lines.h"

#include <vector>

namespace slicelens {

// Lines are in texture coordinates of the displayed volume.

/// Edges of the focus regions on display: the mapping's, and those of highlight and attenuation where they
/// are others. A focal point is a cross of three short lines.
std::vector<Polyline> focus_outlines(const PreparedScene& prepared);

/// Edges of the boxes beyond which volume lenses and connected lenses leave the volume alone, carried by the
/// warps that follow in the list.
std::vector<Polyline> lens_box_outlines(const PreparedScene& prepared);

/// A lattice of the data on the plane across the view through what is shown at the focus' centre, where the
/// warps show it; lines end where the map jumps. `cells`: along the box's longest edge.
std::vector<Polyline> carried_lattice(const PreparedScene& prepared, std::size_t cells);

/// Local magnification of the plane across the view through the focus' centre at each pixel, rows from the
/// top: 1/√(area of the data under an area of that plane).
std::vector<double> plane_magnifications(const PreparedScene& prepared);

/// Where the ray through pixel coordinates (x, y) meets the plane through `point` with `normal`: all in box
/// space, but the pixel (0,0 is the picture's top left corner).
glm::dvec3 plane_point_at_pixel(const PreparedScene& prepared, double x, double y, const glm::dvec3& point,
                                const glm::dvec3& normal);

} // namespace slicelens
