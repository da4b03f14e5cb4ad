// Convex polygons in texture space: where planes cut the volume's box, and what half-spaces leave of them.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace slicelens {

/// An oriented plane in whatever space the caller works in: dot(normal, x) = offset. As a half-space it keeps
/// the side its normal points to: dot(normal, x) ≥ offset. `normal` need not be a unit vector.
struct Plane {
  glm::dvec3 normal{0, 0, 1};
  double offset = 0;
};

/// dot(normal, x) − offset.
double signed_value(const Plane& plane, const glm::dvec3& x);

/// `plane` (in the codomain of the affine map `to_from`) seen from the domain: the points x with to_from·x on
/// it. texture plane = pull_back(world plane, world_from_texture).
Plane pull_back(const Plane& plane, const glm::dmat4& to_from);

/// A convex, planar polygon; corners in order around it, either sense. Empty: no corners.
using Polygon = std::vector<glm::dvec3>;

/// The polygon in which `plane` cuts the unit cube [0,1]³: empty or 3 to 6 corners, each on a cube edge, in
/// order; no two of them closer than 1e-12. The cut is half-open so that a stack counts every face once: of
/// the planes through a face, the one with the cube on its negative side gives the face, the other nothing.
Polygon cut_unit_cube(const Plane& plane);

/// The part of `polygon` inside the half-space of `plane` (Sutherland and Hodgman 1974). Corners on the plane
/// are kept.
Polygon clip(const Polygon& polygon, const Plane& plane);

/// Area of a planar polygon, in the square of its coordinates' unit.
double area(const Polygon& polygon);

} // namespace slicelens
