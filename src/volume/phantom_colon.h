// Inside src/volume only: the shape of `colon`. Positions in millimetres from the box centre, LPS (the
// patient's left at +x, back at +y, head at +z); the box is 320 × 160 × 320 mm. The path and the folds are
// this project's own, set to the usual sizes of an adult's distended colon.
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace slicelens::colon {

/// A point of the centre line with a frame that does not turn about it.
struct PathNode {
  glm::dvec3 position{0};
  glm::dvec3 normal{0};   ///< unit, across the path
  glm::dvec3 binormal{0}; ///< unit, across both
  double length = 0;      ///< along the path from the caecum
  double radius = 0;      ///< mean inner radius, without folds
};

/// From the caecum to the rectum, which leaves the box through its lower face. Made anew on every call,
/// always the same; neighbours are at most 4 mm apart.
std::vector<PathNode> path();

/// Inner radius at a length along the path and an angle about it (0 at the normal): `radius` less the folds
/// between the haustra and the three taeniae.
double inner_radius(double length, double angle, double radius);

/// Bumps on the wall.
struct Polyp {
  double fraction = 0; ///< of the path's length
  double angle = 0;    ///< about the path
  double radius = 0;   ///< of its head, mm
  double stalk = 0;    ///< length; 0: sits on the wall
};

const std::vector<Polyp>& polyps();

/// Centre of a polyp's head.
glm::dvec3 head_of(const Polyp& polyp, const std::vector<PathNode>& path);

constexpr double kWall = 3;           ///< thickness
constexpr double kIleumRadius = 6.5;  ///< inner, of the small bowel's end
constexpr double kAppendixRadius = 2; ///< inner

} // namespace slicelens::colon
