// The slice stack: planes perpendicular to the viewing direction, cut with the volume's box
// (docs/pipeline.md).
#pragma once

#include "core/box.h"
#include "core/view.h"
#include "slicing/polygon.h"

#include <cstdint>
#include <vector>

namespace slicelens {

enum class SliceOrder { back_to_front, front_to_back };

/// What a stack is made from. Pure input: the same request always gives the same stack.
struct SliceRequest {
  Box box;
  View view;
  double spacing = 1; ///< Δ, distance between neighbouring planes along view.forward, world units, > 0
  SliceOrder order = SliceOrder::back_to_front;
  std::vector<Plane> clip; ///< half-spaces in texture space; only what lies in all of them is kept
  /// What is cut: a box of texture coordinates, larger than [0,1]³ where a warp shows data beyond the
  /// volume's box. Planes count from the centre of [0,1]³ all the same.
  glm::dvec3 low{0};
  glm::dvec3 high{1};
};

/// One slice: corners [first, first + count) of the stack.
struct Slice {
  std::int64_t index =
      0; ///< k: the plane lies at (k+½)Δ from the plane through the box centre, along view.forward
  double distance = 0;     ///< (k+½)Δ, world units
  std::uint32_t first = 0; ///< first corner in SliceStack::corners
  std::uint32_t count = 0; ///< 3 to 6 corners, more where clipping planes cut
};

/// The polygons in drawing order.
struct SliceStack {
  std::vector<Slice> slices;
  std::vector<glm::dvec3> corners; ///< texture coordinates
};

/// Most planes a stack may have; finer spacings are refused rather than left to run for hours.
inline constexpr std::int64_t max_planes = 1'000'000;

/// Index range [first, last] of the planes (k+½)Δ that can cut the box; empty when first > last.
/// `distance_range` is the box's extent along the axis that distances are measured on, relative to the anchor
/// at which k+½ = 0. Throws UsageError when there are more than max_planes.
struct PlaneRange {
  std::int64_t first = 0;
  std::int64_t last = -1;
};
PlaneRange plane_range(const Interval& distance_range, double spacing);

/// Cuts the box. Under perspective, planes behind the eye or within 1e-3 Δ of it are left out; all points of
/// a plane have the same depth, so no polygon needs clipping at the near plane. Throws UsageError for a
/// spacing that is not positive and finite or that gives more than max_planes.
SliceStack make_slice_stack(const SliceRequest& request);

/// Distance between neighbouring samples on the ray through image position (x, y) divided by Δ: 1 for
/// orthographic views, 1/cos θ under perspective, θ the angle between ray and view axis (Brunet §3.1).
double sample_distance_ratio(const View& view, double x, double y);

} // namespace slicelens
