// Inside src/volume only: the anatomy of `organs`, a frog that sits belly down. Positions in millimetres from
// the box centre, LPS with the animal's left at +x, its nose towards −y and its back at +z; the box is 160 ×
// 160 × 80 mm. The shapes are this project's own. Signed distances, negative inside.
#pragma once

#include <glm/glm.hpp>

namespace slicelens::frog {

/// Numbers of the label volume; 0 is air.
enum Organ {
  skin = 1,
  muscle,
  skeleton,
  eye,
  lens,
  brain,
  nerves,
  lung,
  heart,
  vessels,
  liver,
  gall_bladder,
  stomach,
  small_intestine,
  large_intestine,
  spleen,
  kidney,
  fat_body,
  bladder,
  organ_count ///< one more than the last label
};

/// The outer surface.
double surface(const glm::dvec3& p);

/// Organ `organ` (skeleton and later) where nothing else lies; where two overlap the one that is painted
/// later counts (phantom_organs.cpp).
double distance(Organ organ, const glm::dvec3& p);

constexpr double kSkinThickness = 1.3;

// What closed forms need: centres and semi-axes of the ellipsoids on the left side.
constexpr glm::dvec3 kEyeCenter{12.5, -36, 9.5};
constexpr double kEyeRadius = 5.4;
constexpr glm::dvec3 kLensCenter{14, -37.8, 10.6};
constexpr double kLensRadius = 2.1;
constexpr glm::dvec3 kKidneyCenter{5.5, 20, 0.5};
constexpr glm::dvec3 kKidneyRadii{2.8, 9, 2.4};
constexpr glm::dvec3 kSpleenCenter{2, 11.5, -3};
constexpr double kSpleenRadius = 2.6;
constexpr glm::dvec3 kGallCenter{-2, 5.5, -14};
constexpr double kGallRadius = 2.3;
constexpr glm::dvec3 kBladderCenter{0, 33, -11};
constexpr glm::dvec3 kBladderRadii{5, 4, 2};

} // namespace slicelens::frog
