// Does a deformation tear what it shows? The displayed object as a boolean volume, the largest jump of a map
// and its smallest Jacobian determinant.
#pragma once

#include "study/components.h"
#include "volume/volume.h"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace slicelens {

/// An inverse map: where in the data a displayed point is looked up. Texture coordinates on both sides.
/// Called from several threads at a time.
using TextureMap = std::function<glm::dvec3(const glm::dvec3&)>;

/// The identity.
TextureMap undeformed();

/// Component 0 of the volume at texture coordinate t, trilinear between voxel centres (i+½)/N in double
/// precision, clamped to the outer centres. NaN where a NaN voxel takes part.
double trilinear(const Volume& volume, const glm::dvec3& t);

/// Most voxels of a displayed mask, a byte each.
inline constexpr std::size_t max_mask_voxels = std::size_t{1} << 33;

/// The object as displayed: voxel p = (i+½)/dims is 1 where the volume's value at u(p) is `threshold` or
/// more, and 0 where u(p) leaves [0,1]³ or is not finite. Samples are rounded, so a value equal to the
/// threshold may fall on either side (not on the volume's own grid when its dims are powers of two). Throws
/// UsageError for a zero size or a threshold that is not finite, LimitError when the product of dims
/// overflows or exceeds max_mask_voxels.
VoxelMask displayed_mask(const Volume& volume, const TextureMap& u, double threshold,
                         const std::array<std::size_t, 3>& dims);

/// A part of texture space.
struct Region {
  glm::dvec3 low{0};
  glm::dvec3 high{1};
};

/// |u(p + step·e_axis) − u(p)| of the pair of points where it is largest.
struct Jump {
  double size = 0; ///< in the unit of u
  glm::dvec3 at{0};
  int axis = 0;
  double step = 0; ///< distance of the two points, at most what was asked for
};

/// The largest jump of u in a region. Neighbours on a grid of n³ points are taken in pairs along each axis,
/// and every pair is halved until it is at most `step` apart, each time keeping the half across which u
/// changes more. Where u is continuous the result falls in proportion to the step; at a tear that an axis
/// crosses it stays, so the tear is found without knowing where it lies (if it is larger than what u changes
/// over half a grid cell besides). Throws UsageError unless n ≥ 2, step > 0 and low < high, all finite.
Jump largest_jump(const TextureMap& u, const Region& region, std::size_t n, double step);

/// The determinant at the point where it is smallest.
struct Determinant {
  double value = 0;
  glm::dvec3 at{0};
};

using JacobianMap = std::function<glm::dmat3(const glm::dvec3&)>;

/// The smallest determinant of `jacobian` over the n³ points of a grid with the region's faces on it and over
/// `random` points more (a fixed sequence). A NaN counts as smallest. Throws as largest_jump does.
Determinant smallest_determinant(const JacobianMap& jacobian, const Region& region, std::size_t n,
                                 std::size_t random);

/// How much of an object's cross-sections continues across the faces of a box: on each face a grid of n²
/// points is looked at from `step` inside and `step` outside. 1 where nothing is torn.
struct Crossing {
  std::size_t inside = 0;  ///< points that show the object from inside
  std::size_t outside = 0; ///< from outside
  std::size_t both = 0;    ///< from either side
  /// both / (inside + outside − both); 1 when the object meets no face.
  double continued() const;
};

/// Faces that lie outside [0,1]³ show nothing. Throws as displayed_mask and largest_jump do.
Crossing face_crossing(const Volume& volume, const TextureMap& u, double threshold, const Region& box,
                       std::size_t n, double step);

} // namespace slicelens
