// render.levels in the reference: values of a pyramid, in double.
#pragma once

#include "render/bricks.h"
#include "render/prepare.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

/// The level at which the point p of the displayed volume (texture coordinates) is read.
inline double level_at(const PreparedScene& prepared, const glm::dvec3& p) {
  const glm::dvec3 b = box_from_texture(prepared.space, p);
  double q = 1; // lenses do not overlap, so at most one factor differs from 1
  for (const LensTessellation& lens : prepared.lenses)
    q *= magnification(lens.map, b);
  return level_of(q, static_cast<double>(prepared.pyramid.size()), prepared.log_zoom);
}

/// The value of level k ≥ 1 at texture coordinate p: trilinear (or nearest) between the level's voxel centres
/// (i+½)·2ᵏ/N, clamped to the edge.
inline double level_value(const PreparedScene& prepared, std::size_t k, const glm::dvec3& p) {
  const Volume& level = prepared.pyramid[k - 1];
  const auto& n = prepared.volume.dims;
  const glm::dvec3 last = glm::dvec3(level.dims[0], level.dims[1], level.dims[2]) - 1.0;
  const glm::dvec3 x = p * glm::dvec3(n[0], n[1], n[2]) / std::ldexp(1, static_cast<int>(k));
  const auto at = [&](const glm::dvec3& i) {
    return value_at(level, static_cast<std::size_t>(i.x), static_cast<std::size_t>(i.y),
                    static_cast<std::size_t>(i.z));
  };
  if (prepared.scene.render.filter == Filter::nearest)
    return at(glm::clamp(glm::floor(x), glm::dvec3(0), last));
  const glm::dvec3 position = glm::clamp(x - 0.5, glm::dvec3(0), last);
  const glm::dvec3 a = glm::floor(position);
  const glm::dvec3 b = glm::min(a + 1.0, last);
  const glm::dvec3 f = position - a;
  const auto along_x = [&](double j, double l) { return glm::mix(at({a.x, j, l}), at({b.x, j, l}), f.x); };
  return glm::mix(glm::mix(along_x(a.y, a.z), along_x(b.y, a.z), f.y),
                  glm::mix(along_x(a.y, b.z), along_x(b.y, b.z), f.y), f.z);
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
