// Polygons whose corners carry a place and a homogeneous texture coordinate, clipped exactly.
#pragma once

#include "tess/lens_mesh.h"

namespace slicelens {

using LensPolygon = std::vector<LensVertex>;

/// Half-space of the homogeneous texture coordinates: dot(coefficients, texture) ≥ 0. A plane n·t ≥ o of
/// texture space is (n, −o), since q > 0: n·(S,T,R) − o·q ≥ 0 (LaMar §4.2).
struct TextureHalfSpace {
  glm::dvec4 coefficients{0};
};

TextureHalfSpace homogeneous(const Plane& plane);

/// The six faces of [0,1]³, or of a tile [low, high]: 0 ≤ S ≤ q and so on.
std::vector<TextureHalfSpace> faces_of(const glm::dvec3& low, const glm::dvec3& high);

/// The part inside the half-space. A cut edge gives the same new corner, to the last bit, from both polygons
/// that share it.
LensPolygon clip(const LensPolygon& polygon, const TextureHalfSpace& half_space);

/// The part on the kept side of a plane in object space (positions).
LensPolygon clip_position(const LensPolygon& polygon, const Plane& plane);

} // namespace slicelens
