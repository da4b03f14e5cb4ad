// Inside src/volume only: signed distances (negative inside) from which the solid phantoms are built, in the
// phantom's own unit of length. Near the surface they are distances to first order, which is what partial
// volume needs.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace slicelens::sdf {

/// First-order distance to an ellipsoid with semi-axes r about the origin: f/|∇f| of f = |p/r| − 1, times
/// |p/r|.
inline double ellipsoid(const glm::dvec3& p, const glm::dvec3& r) {
  const glm::dvec3 q = p / r;
  const double k0 = glm::length(q);
  const double k1 = glm::length(q / r);
  return k1 > 1e-12 ? k0 * (k0 - 1) / k1 : -std::min({r.x, r.y, r.z});
}

/// Tube with hemispherical ends whose radius goes linearly from ra at a to rb at b.
inline double capsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double ra, double rb) {
  const glm::dvec3 ab = b - a;
  const double h = std::clamp(glm::dot(p - a, ab) / glm::dot(ab, ab), 0.0, 1.0);
  return glm::length(p - a - ab * h) - (ra + (rb - ra) * h);
}

inline double capsule(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, double r) {
  return capsule(p, a, b, r, r);
}

/// Box of half-widths h about the origin with edges rounded to radius r.
inline double box(const glm::dvec3& p, const glm::dvec3& h, double r = 0) {
  const glm::dvec3 q = glm::abs(p) - h + r;
  return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0) - r;
}

/// Cylinder of radius r along z about the origin, |z| ≤ half.
inline double cylinder(const glm::dvec3& p, double r, double half) {
  return std::max(std::sqrt(p.x * p.x + p.y * p.y) - r, std::abs(p.z) - half);
}

/// Union whose seam is filled over a width k (the polynomial smooth minimum).
inline double blend(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

/// Intersection with a rounded edge.
inline double meet(double a, double b, double k) { return -blend(-a, -b, k); }

/// a without b, with a rounded edge.
inline double cut(double a, double b, double k) { return meet(a, -b, k); }

/// Part of a voxel inside a surface at signed distance d, for voxels of size w: a smooth step of unit slope
/// times 3/4 per voxel, 1 beyond one voxel inside and 0 beyond one voxel outside.
inline double inside(double d, double w) {
  const double x = std::clamp(0.5 - d / (2 * w), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

/// `value` where inside, over what was there.
inline void put(double& v, double value, double coverage) { v += (value - v) * coverage; }

} // namespace slicelens::sdf
