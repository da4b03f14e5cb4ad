// Cohen's fisheye display as a value: its parameters, their limits, its maps.
#pragma once

#include "warp/box_space.h"
#include "warp/shared_axis_maps.h"

namespace slicelens {

/// Magnifies about a focal point, less and less towards the faces (Cohen, Brodlie and Phillips 2008 §3.1, in
/// the form of Sarkar and Brown 1992; docs/papers/cohen.md).
struct Fisheye {
  glm::dvec3 center{0.5};   ///< focal point, texture coordinates
  glm::dvec3 distortion{3}; ///< d of each axis: magnification d + 1 at the focal point; 0: none
};

/// Throws UsageError naming the key: a centre not strictly within (0, 1), a distortion below 0 or above 1e4.
void validate(const Fisheye& fisheye);

namespace shared {
template <class Real>
struct FisheyeFunctions : AxisMapFunctions<Real> {
  SLICELENS_SHARED_NAMES(Real)
  using AxisMapFunctions<Real>::fisheye_axis;
#include "warp/fisheye.glsl"
};
} // namespace shared

using FisheyeMap = shared::FisheyeFunctions<double>::FisheyeMap;

FisheyeMap fisheye_map(const Fisheye& fisheye, const BoxSpace& space);

/// The inverse map and its derivative at p, box space, in double precision.
glm::dvec3 texture_from_object(const FisheyeMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const FisheyeMap& map, const glm::dvec3& p);

/// The forward map: where the point u of the data is shown, box space.
glm::dvec3 object_from_texture(const FisheyeMap& map, const glm::dvec3& u);

/// Calls set(name, value) for every field as GLSL takes it.
template <class Set>
void visit_fields(const FisheyeMap& map, const Set& set) {
  set("size", map.size);
  set("center", map.center);
  set("distortion", map.distortion);
}

} // namespace slicelens
