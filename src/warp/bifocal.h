// Cohen's bifocal display as a value: its parameters, their limits, its maps.
#pragma once

#include "warp/axis_ranges.h"
#include "warp/box_space.h"
#include "warp/shared_axis_maps.h"

namespace slicelens {

/// Shows a box of the data in another one, and squeezes the rest: piecewise linear on each axis (Cohen,
/// Brodlie and Phillips 2008 §3.1; docs/papers/cohen.md). Texture coordinates.
struct Bifocal {
  AxisRanges focus = ranges_of(glm::dvec3(0.4), glm::dvec3(0.6));   ///< in the data: x_min, x_max
  AxisRanges shown = ranges_of(glm::dvec3(0.25), glm::dvec3(0.75)); ///< on display: x'_min, x'_max
};

/// Throws UsageError naming the key: see validate_inside.
void validate(const Bifocal& bifocal);

namespace shared {
template <class Real>
struct BifocalFunctions : AxisMapFunctions<Real> {
  SLICELENS_SHARED_NAMES(Real)
  using AxisMapFunctions<Real>::bifocal_axis;
#include "warp/bifocal.glsl"
};
} // namespace shared

using BifocalMap = shared::BifocalFunctions<double>::BifocalMap;

BifocalMap bifocal_map(const Bifocal& bifocal, const BoxSpace& space);

/// The inverse map and its derivative at p, box space, in double precision.
glm::dvec3 texture_from_object(const BifocalMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const BifocalMap& map, const glm::dvec3& p);

/// The forward map: where the point u of the data is shown, box space.
glm::dvec3 object_from_texture(const BifocalMap& map, const glm::dvec3& u);

/// Calls set(name, value) for every field as GLSL takes it.
template <class Set>
void visit_fields(const BifocalMap& map, const Set& set) {
  set("size", map.size);
  set("low", map.low);
  set("high", map.high);
  set("shown_low", map.shown_low);
  set("shown_high", map.shown_high);
}

} // namespace slicelens
