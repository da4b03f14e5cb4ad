// The warp that a displacement field defines: its parameters, their limits, its map.
#pragma once

#include "warp/box_space.h"
#include "warp/map_grid.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace slicelens {

/// Displacements of world points, in world units along the world's axes (LPS), on voxels of any pose.
struct DisplacementField {
  std::array<std::size_t, 3> dims{1, 1, 1};
  glm::dmat4 world_from_index{1}; ///< of voxel (i, j, k)'s centre
  std::vector<glm::vec3> vectors; ///< finite; x fastest
};

/// Trilinear; clamped within half a voxel of the outer centres, 0 beyond, as ITK's
/// DisplacementFieldTransform has it.
glm::dvec3 displacement_at(const DisplacementField& field, const glm::dmat4& index_from_world,
                           const glm::dvec3& world);

enum class FieldDirection { inverse, forward };
/// Which axes a file's vectors are along; `automatic` is ITK's rule (docs/papers/brunet_maps.md).
enum class FieldVectors { automatic, lps, ras };

/// A deformation read from a file: u(p) = p + D(p) (`inverse`), or the point x of the data is shown at
/// d(x) = x + D(x) (`forward`; Brunet, Nowak and Gleicher 2006 §4.3).
struct Field {
  std::string file;
  FieldDirection direction = FieldDirection::inverse;
  FieldVectors vectors = FieldVectors::automatic;
  std::size_t resolution = 64; ///< nodes on each axis of the grid that all pipelines look the map up in

  std::shared_ptr<const DisplacementField> loaded = nullptr; ///< what the file holds; no key
  std::string sha256 = {};                                   ///< of the files as they were read; no key

  bool operator==(const Field&) const = default;
};

/// Throws UsageError naming the key.
void validate(const Field& field);

/// The inverse map on a grid of `resolution`³ nodes over the box in which the volume is shown. A forward
/// field is inverted by a multilevel B-spline through the pairs (d(x), x), and each node then by Newton's
/// method. Throws UsageError where the field lies wholly beside the volume.
GridMap field_map(const Field& field, const BoxSpace& space);

/// World units.
struct FieldReport {
  double largest_displacement = 0; ///< in the file
  double grid_largest = 0;         ///< of |u_grid − u|: inverse fields, at the points of map_grid_error
  double grid_rms = 0;
  double scattered_largest =
      0;                    ///< forward fields: |d(u(p)) − p| at the nodes that look into the data, by the
  double scattered_rms = 0; ///< B-spline alone
  double refined_largest = 0; ///< and of the grid
  double refined_rms = 0;
  double smallest_determinant = 1; ///< of the grid's derivative: at 0 or below the map folds
};

FieldReport field_report(const Field& field, const BoxSpace& space);

} // namespace slicelens
