// Slices as spherical shells about the eye (docs/pipeline.md): each is a flat polygon that covers every pixel
// which the shell can colour; where on its ray a fragment samples, the fragment works out itself.
#pragma once

#include "slicing/slice_stack.h"

namespace slicelens {

/// Polygons in the plane at `plane_depth` from the eye (> 0, world units along view.forward), one for each
/// shell of radius |eye − box centre| + (k+½)Δ that may meet the box [low, high] within the picture. `clip`
/// is not used.
///
/// Conservative: shell k lies between the depths R·cos θ and R, θ the angle between the axis and the ray to a
/// corner of the picture, so its polygon is the convex hull of the projection of that slab of the box, wider
/// by a pixel, cut at the picture's edge. Slice::distance is (k+½)Δ along every ray. Needs a perspective
/// view. Throws as make_slice_stack does.
SliceStack make_shell_stack(const SliceRequest& request, double plane_depth);

/// The convex hull of points in a plane, z ignored, counterclockwise; fewer than 3 corners where all points
/// lie on a line.
Polygon convex_hull(std::vector<glm::dvec3> points);

} // namespace slicelens
