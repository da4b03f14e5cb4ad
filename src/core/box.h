// The volume's box and its place in the world.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace slicelens {

/// A ray in any affine space: the points origin + s·direction. `direction` need not have unit length; `s` is
/// then counted in units of it.
struct Ray {
  glm::dvec3 origin{0};
  glm::dvec3 direction{0, 0, 1};
};

/// An interval of ray parameters, near ≤ far.
struct Interval {
  double near = 0;
  double far = 0;
};

/// The volume's box: the image of texture space [0,1]³ under an affine map (docs/pipeline.md). It reaches
/// from face to face of the outer voxels, N·spacing long on each axis.
struct Box {
  glm::dmat4 world_from_texture{1};
};

/// The box of a volume with `dims` voxels whose voxel (0,0,0) has its centre at `origin`:
/// world = origin + direction·(spacing ∘ index), and voxel i's centre lies at t = (i+½)/N.
Box make_box(const glm::dvec3& dims, const glm::dvec3& spacing, const glm::dvec3& origin,
             const glm::dmat3& direction);

/// World position of a texture coordinate.
glm::dvec3 world_from_texture(const Box& box, const glm::dvec3& t);

glm::dmat4 texture_from_world(const Box& box);

/// The eight corners in world space; corner k has texture coordinate (k&1, k>>1&1, k>>2&1).
std::array<glm::dvec3, 8> corners(const Box& box);

glm::dvec3 center(const Box& box);

/// Half the length of the longest space diagonal, in world units: the radius of the sphere about center(box)
/// that holds the box.
double bounding_radius(const Box& box);

/// Edge lengths along the three texture axes, in world units.
glm::dvec3 extent(const Box& box);

/// Where `ray` (in texture space) is inside [0,1]³; nothing when it misses. A ray parallel to a face and
/// exactly on it counts as inside.
std::optional<Interval> intersect_unit_cube(const Ray& ray);

} // namespace slicelens
