// Limits that several warps share. For the sources of this folder only.
#pragma once

#include "core/errors.h"
#include "core/text.h"

#include <glm/glm.hpp>

#include <cmath>
#include <string>

namespace slicelens::limits {

/// Throws UsageError unless low ≤ value ≤ high; NaN is not.
inline void require_within(const std::string& kind, const std::string& key, double value, double low,
                           double high) {
  if (!(value >= low && value <= high)) {
    throw UsageError("warp '" + kind + "': " + key + " must be from " + number_text(low) + " to " +
                     number_text(high) + ", not " + number_text(value));
  }
}

inline void require_within(const std::string& kind, const std::string& key, const glm::dvec3& value,
                           double low, double high) {
  for (int axis = 0; axis < 3; ++axis)
    require_within(kind, key, value[axis], low, high);
}

/// Throws UsageError where two keys name the same axis.
inline void require_two_axes(const std::string& kind, const std::string& first, int a,
                             const std::string& second, int b) {
  if (a == b) {
    throw UsageError("warp '" + kind + "': " + first + " and " + second + " must be two axes, not both " +
                     "xyz"[a]);
  }
}

/// How far a centre may lie from the volume, texture coordinates.
inline constexpr double nearest_center = -4;
inline constexpr double farthest_center = 5;

} // namespace slicelens::limits
