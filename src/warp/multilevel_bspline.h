// Multilevel B-splines through scattered values (docs/papers/brunet_maps.md).
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <span>
#include <vector>

namespace slicelens {

/// A sum of uniform cubic B-splines over one box, level l (from 0) with 2^l spans on each axis (Lee, Wolberg
/// and Shin 1997; what ITK's BSplineScatteredDataPointSetToImageFilter fits).
struct MultilevelBSpline {
  glm::dvec3 low{0};
  glm::dvec3 high{1};
  std::vector<std::vector<glm::dvec3>> levels; ///< control values, (2^l + 3)³ each, x fastest
};

/// Limit of the levels: 131³ control values in the last.
inline constexpr std::size_t max_bspline_levels = 8;

/// Fits values_i at the points at_i, which must lie in [low, high]: each level fits what those before it
/// left. The spline is near zero far from every point; it comes as close to the values as the last level's
/// spans are smaller than the points' distances. Where points coincide it goes between their values.
MultilevelBSpline fit_multilevel_bspline(std::span<const glm::dvec3> at, std::span<const glm::dvec3> values,
                                         const glm::dvec3& low, const glm::dvec3& high, std::size_t levels);

/// At p; outside the box at the nearest point of it.
glm::dvec3 evaluate(const MultilevelBSpline& spline, const glm::dvec3& p);

/// The same at all nodes of a regular grid from `low` to `high`, x fastest, at least 2 nodes on each axis:
/// axis by axis, 12 multiplications a level and node instead of 64; equal to evaluate() but for rounding.
std::vector<glm::dvec3> evaluate_on_grid(const MultilevelBSpline& spline,
                                         const std::array<std::size_t, 3>& size, const glm::dvec3& low,
                                         const glm::dvec3& high);

} // namespace slicelens
