// render.footprint: how far apart the samples of a picture lie in the data, and the level that this asks for
// (Brunet, Nowak and Gleicher 2006 §3.2; shaders/lib/levels.glsl).
#pragma once

#include <glm/glm.hpp>

#include <cstddef>

namespace slicelens {

struct PreparedScene;

/// From one sample to the next where the volume is shown, texture coordinates. A pixel is as large as on the
/// plane across the view through the sample, a sample distance is Δ along the view axis: the same for slices
/// and rays.
struct SampleSteps {
  glm::dmat3 at_unit{
      1}; ///< columns: one pixel to the right, one up, both per unit of scale; one sample ahead
  glm::dvec4 scale{0, 0, 0, 1}; ///< of the pixels at p, dot(xyz, p) + w: 1, or the depth in perspective
};

SampleSteps sample_steps(const PreparedScene& prepared);

/// The level that a sample shown at p (texture coordinates) reads, in [0, prepared.levels − 1].
double footprint_level(const PreparedScene& prepared, const glm::dvec3& p);

/// The level that the steps ask for where the volume is shown, without the map; 0 or more.
double displayed_level(const PreparedScene& prepared, const glm::dvec3& p);

/// Levels that the picture reads, 1 or more: up to the coarsest that footprint_level asks for at 25³ points
/// of the displayed volume, spread evenly; at most those that the volume has, max_levels, and render.levels
/// where that is above 1. Without a map no sample asks for more.
std::size_t footprint_level_count(const PreparedScene& prepared);

} // namespace slicelens
