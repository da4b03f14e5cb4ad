#include "core/box.h"

#include <algorithm>
#include <limits>

namespace slicelens {

Box make_box(const glm::dvec3& dims, const glm::dvec3& spacing, const glm::dvec3& origin,
             const glm::dmat3& direction) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.world_from_texture[axis] = glm::dvec4(direction[axis] * (spacing[axis] * dims[axis]), 0.0);
  }
  // t = 0 is half a voxel before the centre of voxel 0 on every axis.
  box.world_from_texture[3] = glm::dvec4(origin - direction * (0.5 * spacing), 1.0);
  return box;
}

glm::dvec3 world_from_texture(const Box& box, const glm::dvec3& t) {
  return glm::dvec3(box.world_from_texture * glm::dvec4(t, 1.0));
}

glm::dmat4 texture_from_world(const Box& box) { return glm::inverse(box.world_from_texture); }

std::array<glm::dvec3, 8> corners(const Box& box) {
  std::array<glm::dvec3, 8> result;
  for (unsigned k = 0; k < 8; ++k)
    result[k] = world_from_texture(box, glm::dvec3(k & 1u, (k >> 1) & 1u, (k >> 2) & 1u));
  return result;
}

glm::dvec3 center(const Box& box) { return world_from_texture(box, glm::dvec3(0.5)); }

double bounding_radius(const Box& box) {
  double radius = 0;
  for (const glm::dvec3& corner : corners(box))
    radius = std::max(radius, glm::length(corner - center(box)));
  return radius;
}

glm::dvec3 extent(const Box& box) {
  return {glm::length(glm::dvec3(box.world_from_texture[0])),
          glm::length(glm::dvec3(box.world_from_texture[1])),
          glm::length(glm::dvec3(box.world_from_texture[2]))};
}

std::optional<Interval> intersect_unit_cube(const Ray& ray) {
  Interval hit{-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.origin[axis];
    const double d = ray.direction[axis];
    if (d == 0) {
      if (o < 0 || o > 1)
        return std::nullopt;
      continue;
    }
    const double s0 = (0 - o) / d;
    const double s1 = (1 - o) / d;
    hit.near = std::max(hit.near, std::min(s0, s1));
    hit.far = std::min(hit.far, std::max(s0, s1));
  }
  if (!(hit.near <= hit.far))
    return std::nullopt;
  return hit;
}

} // namespace slicelens
