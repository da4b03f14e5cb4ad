// Slices cut into triangles that carry a lens in homogeneous texture coordinates (LaMar, Hamann and Joy 2001,
// §3 and §4; docs/papers/lamar.md). No OpenGL.
#pragma once

#include "slicing/polygon.h"
#include "warp/lamar.h"

#include <cstdint>
#include <vector>

namespace slicelens {

/// A corner of a triangle. A fragment between corners looks at texture coordinate texture.xyz / texture.w,
/// both interpolated linearly on the plane.
struct LensVertex {
  glm::dvec3 position{0};         ///< where it is shown: texture coordinates of the displayed volume
  glm::dvec4 texture{0, 0, 0, 1}; ///< (s·q, t·q, r·q, q)
};

/// Which region a triangle belongs to (LaMar Fig. 7: green, blue, red).
enum class LensRegion : std::uint8_t { normal, border, zoom };

/// Triangles of one slice. Those of a convex piece follow each other as a fan about its first corner.
struct LensMesh {
  std::vector<LensVertex> vertices;
  std::vector<std::uint32_t> triangles; ///< three indices each
  std::vector<LensRegion> regions;      ///< one for each triangle
};

/// A lens prepared for a view: what all its slices share.
struct LensTessellation {
  LamarMap map;
  LensBorder border = LensBorder::cubic;
  bool homogeneous = true;
  bool bounded = true;
  std::size_t radial_segments = 8;
  std::vector<glm::dvec2> ring; ///< corners of the ring of radius 1, (right, up), counter-clockwise
};

/// `pixels_per_unit`: pixels in one unit of box space at the lens centre, for adaptive segments. Throws
/// UsageError for an invalid lens, and for an adaptive one that would need more than max_radial_segments.
LensTessellation prepare_lens(const LamarLens& lens, const BoxSpace& space, const WarpView& view,
                              double pixels_per_unit);

/// Throws UsageError naming both when two lenses share a place: their footprints (the tessellated square
/// where bounded) overlap in the picture and in depth.
void refuse_overlap(const std::vector<LensTessellation>& lenses);

/// Half-spaces that a slice is cut with besides the volume's faces.
struct LensClip {
  std::vector<Plane> texture; ///< of the data looked at, in texture space
  std::vector<Plane> object;  ///< of the displayed volume, in texture coordinates of the displayed volume
};

/// The triangles of the slice `polygon` (plane ∩ box, in texture coordinates) under the lenses. Outside their
/// footprints the slice stays in convex pieces; inside, every polygon is clipped where its texture
/// coordinates leave [0,1]³ (LaMar §4.2), so magnified data beyond the box's outline is kept. Where two
/// polygons meet, a corner of one is a corner of the other, with equal coordinates. `lenses` must not
/// overlap. An empty polygon gives no triangles.
LensMesh tessellate_slice(const Polygon& polygon, const std::vector<LensTessellation>& lenses,
                          const BoxSpace& space, const LensClip& clip);

/// Polygons to draw the slice with when the lens is evaluated at each fragment: the slice outside the
/// footprints' squares, and each touched footprint's square whole, whether or not it lies in the box (the
/// fragments test where they look). Cut by planes in object space. Every vertex looks at itself.
LensMesh cover_slice(const Polygon& polygon, const std::vector<LensTessellation>& lenses,
                     const BoxSpace& space, const std::vector<Plane>& object_clip);

/// The texture radius that n homogeneous segments give at radius r of the border, inner ≤ r ≤ outer.
double tessellated_radius(LensBorder border, double minification, double inner, double outer,
                          std::size_t segments, double r);

/// Largest |tessellated − exact| texture radius over the border, by dense sampling of every segment.
double radial_error(LensBorder border, double minification, double inner, double outer, std::size_t segments);

} // namespace slicelens
