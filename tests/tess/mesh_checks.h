// What the tests of tessellated slices share: a slice with its lens, the tessellated map written a second
// time, and the laws of a partition.
#pragma once

#include "lens_cases.h"
#include "tess/lens_mesh.h"

#include <array>
#include <map>
#include <optional>
#include <tuple>

namespace mesh_checks {

using namespace slicelens;
using namespace lens_cases;

/// The plane across the view at signed depth z from the lens centre, cut with the box.
inline Polygon slice_at(const LensCase& c, double z) {
  const double offset = glm::dot(c.lens.center * c.space.size, c.warp.forward) + z;
  return cut_unit_cube({c.warp.forward * c.space.size, offset}); // n·(size ∘ t) = offset
}

inline LensTessellation prepare(const LensCase& c, double pixels_per_unit = 100) {
  return prepare_lens(c.lens, c.space, c.warp, pixels_per_unit);
}

inline LensMesh mesh_at(const LensCase& c, double z, const LensClip& clip = {}) {
  return tessellate_slice(slice_at(c, z), {prepare(c)}, c.space, clip);
}

inline std::array<LensVertex, 3> corners_of(const LensMesh& mesh, std::size_t triangle) {
  return {mesh.vertices[mesh.triangles[3 * triangle]], mesh.vertices[mesh.triangles[3 * triangle + 1]],
          mesh.vertices[mesh.triangles[3 * triangle + 2]]};
}

inline double area_of(const LensMesh& mesh, const std::array<LensVertex, 3>& t) {
  (void)mesh;
  return 0.5 * glm::length(glm::cross(t[1].position - t[0].position, t[2].position - t[0].position));
}

inline double total_area(const LensMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.regions.size(); ++i)
    sum += area_of(mesh, corners_of(mesh, i));
  return sum;
}

/// Barycentric coordinates of a point in the triangle's plane; nothing for a triangle without area.
inline std::optional<glm::dvec3> barycentric(const std::array<LensVertex, 3>& t, const glm::dvec3& p) {
  const glm::dvec3 e1 = t[1].position - t[0].position;
  const glm::dvec3 e2 = t[2].position - t[0].position;
  const glm::dvec3 n = glm::cross(e1, e2);
  const double n2 = glm::dot(n, n);
  if (n2 == 0)
    return std::nullopt;
  const glm::dvec3 d = p - t[0].position;
  const double b = glm::dot(glm::cross(d, e2), n) / n2;
  const double c = glm::dot(glm::cross(e1, d), n) / n2;
  return glm::dvec3(1 - b - c, b, c);
}

/// The data's point that a fragment at p of this triangle looks at.
inline glm::dvec3 looked_at(const std::array<LensVertex, 3>& t, const glm::dvec3& weights) {
  const glm::dvec4 h = weights.x * t[0].texture + weights.y * t[1].texture + weights.z * t[2].texture;
  return glm::dvec3(h) / h.w;
}

/// Radius of a point in units in which the ring's polygon has circumradius 1: constant along its chords.
inline double ring_radius(const LensCase& c, const Across& a) {
  if (c.lens.shape == LensShape::square)
    return std::max(std::abs(a.x), std::abs(a.y));
  const double half = 3.14159265358979323846 / static_cast<double>(c.lens.angular_segments);
  const double angle = std::atan2(a.y, a.x);
  const double middle = (2 * std::floor(angle / (2 * half)) + 1) * half; // of the chord that p is behind
  return std::hypot(a.x, a.y) * std::cos(angle - middle) / std::cos(half);
}

/// The texture radius by docs/papers/lamar.md: numerator and weight are linear between rings.
inline double segmented_profile(const LensCase& c, double zoom, double r) {
  const LamarLens& lens = c.lens;
  if (r <= lens.inner)
    return r / zoom;
  if (r >= lens.outer)
    return r;
  const std::size_t n = lens.border == LensBorder::simple ? 1 : *lens.radial_segments;
  const double width = (lens.outer - lens.inner) / static_cast<double>(n);
  const double k = std::min(std::floor((r - lens.inner) / width), static_cast<double>(n) - 1);
  const double r0 = lens.inner + k * width;
  const double r1 = r0 + width;
  const double x = (r - r0) / width;
  const double f0 = profile(lens, zoom, r0);
  const double f1 = profile(lens, zoom, r1);
  return ((1 - x) * r0 + x * r1) / ((1 - x) * r0 / f0 + x * r1 / f1);
}

/// The tessellated map at p, box space.
inline glm::dvec3 tessellated_texture(const LensCase& c, const glm::dvec3& p) {
  const Across a = across_of(c, p);
  const double r = ring_radius(c, a);
  if (r == 0 || r >= c.lens.outer || std::abs(a.depth) >= depth_outer(c.lens))
    return p;
  return a.axis_point + segmented_profile(c, zoom_at(c.lens, std::abs(a.depth)), r) / r * (p - a.axis_point);
}

/// Holds the mesh to `expected` (texture coordinates looked at from p, in texture coordinates of the
/// display): p is in exactly one triangle when the data looked at lies in the box, in none otherwise, and the
/// triangle looks at `expected`. Points within 1e-7 of an edge or of a face are left out: there rounding
/// decides. Empty when all is well, else what is wrong.
inline std::string wrong_at(const LensMesh& mesh, const glm::dvec3& p, const glm::dvec3& expected) {
  double from_faces = 1;
  for (int axis = 0; axis < 3; ++axis)
    from_faces = std::min({from_faces, expected[axis], 1 - expected[axis]});
  if (std::abs(from_faces) < 1e-7)
    return {};
  int found = 0;
  for (std::size_t i = 0; i < mesh.regions.size(); ++i) {
    const auto triangle = corners_of(mesh, i);
    const auto weights = barycentric(triangle, p);
    if (!weights)
      continue;
    const double least = std::min({weights->x, weights->y, weights->z});
    if (std::abs(least) < 1e-7)
      return {};
    if (least < 0)
      continue;
    ++found;
    if (glm::length(looked_at(triangle, *weights) - expected) > 1e-10)
      return "looks " + std::to_string(glm::length(looked_at(triangle, *weights) - expected)) + " beside";
  }
  const int wanted = from_faces > 0 ? 1 : 0;
  return found == wanted ? "" : std::to_string(found) + " triangles instead of " + std::to_string(wanted);
}

/// No triangle without area, no corner on another triangle's edge, and corners that coincide are equal to the
/// last bit. Empty when all is well.
inline std::string wrong_corners(const LensMesh& mesh) {
  std::map<std::tuple<double, double, double>, glm::dvec3> distinct;
  for (const std::uint32_t i : mesh.triangles) {
    const glm::dvec3& p = mesh.vertices[i].position;
    distinct.emplace(std::tuple(p.x, p.y, p.z), p);
  }
  std::map<std::pair<const glm::dvec3*, const glm::dvec3*>, bool> seen;
  for (std::size_t i = 0; i < mesh.regions.size(); ++i) {
    const auto t = corners_of(mesh, i);
    std::array<const glm::dvec3*, 3> at{};
    for (std::size_t k = 0; k < 3; ++k)
      at[k] = &distinct.at(std::tuple(t[k].position.x, t[k].position.y, t[k].position.z));
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3* a = std::min(at[k], at[(k + 1) % 3]);
      const glm::dvec3* b = std::max(at[k], at[(k + 1) % 3]);
      if (a == b)
        return "triangle with two equal corners";
      if (!seen.emplace(std::pair(a, b), true).second)
        continue;
      const glm::dvec3 edge = *b - *a;
      const double length = glm::length(edge);
      for (const auto& [key, p] : distinct) {
        if (&p == a || &p == b)
          continue;
        const glm::dvec3 d = p - *a;
        if (glm::length(d) < 1e-11 || glm::length(p - *b) < 1e-11)
          return "corners apart by rounding";
        const double x = glm::dot(d, edge) / (length * length);
        // 1e-11 is a thousand times the rounding of positions; corners of random cases lie farther apart.
        if (x > 0 && x < 1 && glm::length(d - x * edge) < 1e-11)
          return "corner on an edge, at " + std::to_string(x) + " of " + std::to_string(length);
      }
    }
  }
  return {};
}

} // namespace mesh_checks
