// Ranges on the three axes of the volume: the focus regions of Cohen's effects.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <string>

namespace slicelens {

/// [min, max] on each axis, texture coordinates.
using AxisRanges = std::array<glm::dvec2, 3>;

inline glm::dvec3 low_of(const AxisRanges& ranges) { return {ranges[0].x, ranges[1].x, ranges[2].x}; }
inline glm::dvec3 high_of(const AxisRanges& ranges) { return {ranges[0].y, ranges[1].y, ranges[2].y}; }
inline AxisRanges ranges_of(const glm::dvec3& low, const glm::dvec3& high) {
  return {glm::dvec2(low.x, high.x), glm::dvec2(low.y, high.y), glm::dvec2(low.z, high.z)};
}

/// Throws UsageError, beginning with `what`, for ranges that are not finite, empty, reversed, or not strictly
/// within (0, 1): Cohen, Brodlie and Phillips 2008 §3.3 assume a focus region that touches no face.
void validate_inside(const AxisRanges& ranges, const std::string& what);

} // namespace slicelens
