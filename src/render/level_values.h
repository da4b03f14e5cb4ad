// render.levels and render.footprint in the reference: values of a pyramid, in double.
#pragma once

#include "render/bricks.h"
#include "render/prepare.h"
#include "render/voxel_filter.h"

#include <cmath>

namespace slicelens {

/// The level at which the point p of the displayed volume (texture coordinates) is read.
inline double level_at(const PreparedScene& prepared, const glm::dvec3& p) {
  if (prepared.scene.render.footprint == Footprint::mip)
    return footprint_level(prepared, p);
  const glm::dvec3 b = box_from_texture(prepared.space, p);
  double q = 1; // lenses do not overlap, so at most one factor differs from 1
  for (const LensTessellation& lens : prepared.lenses)
    q *= magnification(lens.map, b);
  return level_of(q, static_cast<double>(prepared.pyramid.size()), prepared.log_zoom);
}

/// Length of a gradient's steps around p, in voxels of level 0: one of the sample's level, or on display one
/// of the volume's, but no shorter than a step of the picture.
inline double gradient_step(const PreparedScene& prepared, double level, const glm::dvec3& p) {
  const bool on_display = prepared.gradient_space == GradientSpace::object && !prepared.pyramid.empty();
  return std::exp2(on_display ? displayed_level(prepared, p) : level);
}

/// The value of level k ≥ 1 at texture coordinate p, by the scene's filter: the level's voxel centres are at
/// (i+½)·2ᵏ/N.
inline double level_value(const PreparedScene& prepared, std::size_t k, const glm::dvec3& p) {
  const Volume& level = prepared.pyramid[k - 1];
  const auto& n = prepared.volume.dims;
  const glm::dvec3 x = p * glm::dvec3(n[0], n[1], n[2]) / std::ldexp(1, static_cast<int>(k));
  return filtered(prepared.scene.render.filter, glm::ivec3(level.dims[0], level.dims[1], level.dims[2]), x,
                  [&](int i, int j, int l) {
                    return value_at(level, static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                                    static_cast<std::size_t>(l));
                  });
}

/// Linear between the two levels beside `level`; `full_value(p)` gives level 0.
template <class FullValue>
double blended_levels(const PreparedScene& prepared, double level, const glm::dvec3& p,
                      const FullValue& full_value) {
  const auto value = [&](std::size_t k) { return k == 0 ? full_value(p) : level_value(prepared, k, p); };
  const double lower = std::floor(level);
  const auto k = static_cast<std::size_t>(lower);
  return level == lower ? value(k) : glm::mix(value(k), value(k + 1), level - lower);
}

} // namespace slicelens
