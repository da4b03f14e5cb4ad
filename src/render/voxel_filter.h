// render.filter in the reference: what a volume of voxels shows between their centres, in double.
#pragma once

#include "scene/scene.h"

#include <glm/glm.hpp>

namespace slicelens {

namespace cubic_names {
using namespace glm;
using real = double;
using vec4 = glm::dvec4;
struct CubicFunction {
#include "lib/cubic.glsl"
};
} // namespace cubic_names

/// The cubic B-spline at x (shaders/lib/cubic.glsl), as the sum of all its 64 voxels, each clamped to the
/// edge.
template <class VoxelAt>
auto cubic_filtered(const glm::ivec3& dims, const glm::dvec3& x, const VoxelAt& voxel_at) {
  const glm::dvec3 lower = glm::floor(x - 0.5);
  const glm::ivec3 first = glm::ivec3(lower) - 1;
  const glm::dvec3 f = x - 0.5 - lower;
  cubic_names::CubicFunction b_spline;
  const glm::dvec4 weight[3] = {b_spline.cubic_weights(f.x), b_spline.cubic_weights(f.y),
                                b_spline.cubic_weights(f.z)};
  decltype(voxel_at(0, 0, 0)) sum(0);
  for (int k = 0; k < 4; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const glm::ivec3 voxel = glm::clamp(first + glm::ivec3(i, j, k), glm::ivec3(0), dims - 1);
        sum += weight[0][i] * weight[1][j] * weight[2][k] * voxel_at(voxel.x, voxel.y, voxel.z);
      }
    }
  }
  return sum;
}

/// What `voxel_at(i, j, k)` gives at x, in voxels: the centre of voxel i is at i + ½. The nearest voxel,
/// trilinear between the centres, or the cubic B-spline; voxels beyond the edge are those at the edge.
template <class VoxelAt>
auto filtered(Filter filter, const glm::ivec3& dims, const glm::dvec3& x, const VoxelAt& voxel_at) {
  const glm::ivec3 last = dims - 1;
  if (filter == Filter::nearest) {
    const glm::ivec3 n(glm::clamp(glm::floor(x), glm::dvec3(0), glm::dvec3(last)));
    return voxel_at(n.x, n.y, n.z);
  }
  if (filter == Filter::cubic)
    return cubic_filtered(dims, x, voxel_at);
  const glm::dvec3 position = glm::clamp(x - 0.5, glm::dvec3(0), glm::dvec3(last));
  const glm::ivec3 a(glm::floor(position));
  const glm::ivec3 b = glm::min(a + 1, last);
  const glm::dvec3 f = position - glm::dvec3(a);
  const auto along_x = [&](int j, int k) { return glm::mix(voxel_at(a.x, j, k), voxel_at(b.x, j, k), f.x); };
  return glm::mix(glm::mix(along_x(a.y, a.z), along_x(b.y, a.z), f.y),
                  glm::mix(along_x(a.y, b.z), along_x(b.y, b.z), f.y), f.z);
}

} // namespace slicelens
