// Cohen's volume lens and the connected lens as values: their parameters, their limits, their maps.
#pragma once

#include "warp/axis_ranges.h"
#include "warp/box_space.h"
#include "warp/shared_axis_maps.h"

namespace slicelens {

/// A box fixed in the volume: magnified within `inner` about `center`, undisturbed beyond `outer`.
struct LensBox {
  glm::dvec3 center{0.5};   ///< texture coordinates
  glm::dvec3 inner{0.15};   ///< half-widths, texture coordinates
  glm::dvec3 outer{0.3};    ///< likewise
  double magnification = 2; ///< below 1: minification
};

/// The lens of Cohen, Brodlie and Phillips 2008 §3.1 (docs/papers/cohen.md): it cuts what crosses its box's
/// faces away from the middle.
struct VolumeLens {
  LensBox box;
};

/// The same offsets with weights that fade out together: continuous everywhere (docs/papers/cohen.md).
struct ConnectedLens {
  LensBox box;
};

/// Throws UsageError naming the key: not finite or positive half-widths and magnification, inner ≥ outer, a
/// focus region that touches a face or a box that leaves the volume, a minification that folds.
void validate(const VolumeLens& lens);
void validate(const ConnectedLens& lens);

/// The box of the uniform magnification, center ± inner.
AxisRanges focus_of(const LensBox& box);

namespace shared {
template <class Real>
struct VolumeLensFunctions : AxisMapFunctions<Real> {
  SLICELENS_SHARED_NAMES(Real)
  using AxisMapFunctions<Real>::lens_axis;
#include "warp/volume_lens.glsl"
};
template <class Real>
struct ConnectedLensFunctions : AxisMapFunctions<Real> {
  SLICELENS_SHARED_NAMES(Real)
  using AxisMapFunctions<Real>::lens_axis;
  using AxisMapFunctions<Real>::lens_weight;
#include "warp/connected_lens.glsl"
};
} // namespace shared

using VolumeLensMap = shared::VolumeLensFunctions<double>::VolumeLensMap;
using ConnectedLensMap = shared::ConnectedLensFunctions<double>::ConnectedLensMap;

VolumeLensMap volume_lens_map(const LensBox& box, const BoxSpace& space);
ConnectedLensMap connected_lens_map(const LensBox& box, const BoxSpace& space);

/// The inverse maps and their derivatives at p, box space, in double precision.
glm::dvec3 texture_from_object(const VolumeLensMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const VolumeLensMap& map, const glm::dvec3& p);
glm::dvec3 texture_from_object(const ConnectedLensMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const ConnectedLensMap& map, const glm::dvec3& p);

/// The forward maps: where the point u of the data is shown, box space. The connected lens has no closed
/// form: Newton's method, to 1e-12.
glm::dvec3 object_from_texture(const VolumeLensMap& map, const glm::dvec3& u);
glm::dvec3 object_from_texture(const ConnectedLensMap& map, const glm::dvec3& u);

/// Where the axes of the lens show u one by one, whether or not the others lie in its box.
glm::dvec3 magnified_from_texture(const VolumeLensMap& map, const glm::dvec3& u);

/// Whether p lies in the lens' box (1), on whose faces the map jumps, or outside (0).
int piece_of(const VolumeLensMap& map, const glm::dvec3& p);

/// Calls set(name, value) for every field as GLSL takes it.
template <class Set>
void visit_fields(const VolumeLensMap& map, const Set& set) {
  set("size", map.size);
  set("center", map.center);
  set("inner", map.inner);
  set("outer", map.outer);
  set("magnification", map.magnification);
}
template <class Set>
void visit_fields(const ConnectedLensMap& map, const Set& set) {
  set("size", map.size);
  set("center", map.center);
  set("inner", map.inner);
  set("outer", map.outer);
  set("magnification", map.magnification);
}

} // namespace slicelens
