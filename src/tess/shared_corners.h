// Corners that neighbouring polygons of a slice share: the same place is the same numbers, and no corner lies
// inside a neighbour's edge, where the rasteriser's snapping would open a crack.
#pragma once

#include "tess/homogeneous.h"

#include <array>

namespace slicelens {

/// Gives corners of undisturbed places (texture coordinate = position, weight 1) that lie within 1e-10 of
/// each other one value, the one of the first polygon that has it; then gives every edge between two
/// undisturbed corners the other corners that lie on it. Polygons that shrink to a line become empty.
void share_corners(const std::vector<LensPolygon*>& polygons);

/// A convex polygon as triangles of corner numbers. Corners may lie inside edges: no triangle is without area
/// unless the whole polygon is. Fewer than three corners give none. Where no corner lies inside an edge, the
/// edges between the triangles are log n times as long as the outline at most, where a fan's grow with n:
/// rasterisers shade groups of pixels along an edge once for each of its sides.
std::vector<std::array<std::uint32_t, 3>> triangulate(const LensPolygon& polygon);

} // namespace slicelens
