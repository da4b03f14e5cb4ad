#include "tess/lens_mesh.h"

#include "core/errors.h"
#include "tess/homogeneous.h"
#include "tess/shared_corners.h"
#include "tess/square_frame.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

/// A polygon of the slice with the region it belongs to.
struct Piece {
  LensPolygon polygon;
  LensRegion region = LensRegion::normal;
};

/// A lens on the slice's plane.
struct Footprint {
  const LensTessellation& lens;
  const BoxSpace& space;
  LensPlane plane;
  bool crosses_zoom = true; ///< the plane lies within depth_inner of the centre

  glm::dvec3 box_point(const glm::dvec2& across) const {
    return plane.axis_point + (across.x * plane.scale) * lens.map.right +
           (across.y * plane.scale) * lens.map.up;
  }

  /// A corner shown at `across` (radii at the centre's depth) that looks at `texture_across`.
  LensVertex vertex(const glm::dvec2& across, const glm::dvec2& texture_across, double weight) const {
    const double q = lens.homogeneous ? weight : 1;
    const glm::dvec3 texture = texture_from_box(space, box_point(texture_across));
    return {texture_from_box(space, box_point(across)), glm::dvec4(texture * q, q)};
  }

  /// A corner of the undisturbed region: looks at itself.
  LensVertex still(const glm::dvec2& across) const { return vertex(across, across, 1); }

  /// Half-plane of the slice's plane: across·normal ≥ offset, as a plane of texture coordinates.
  Plane half_plane(const glm::dvec2& normal, double offset) const {
    const glm::dvec3 n = normal.x * lens.map.right + normal.y * lens.map.up;
    return {n * space.size, glm::dot(n, plane.axis_point) + offset * plane.scale};
  }

  /// Corner j of the ring of geometry radius r.
  glm::dvec2 ring(std::size_t j, double r) const { return r * lens.ring[j % lens.ring.size()]; }
};

/// Radius, texture radius and weight of each ring of the border (docs/papers/lamar.md).
struct Ring {
  double radius = 0;
  double texture_radius = 0;
  double weight = 1;
};

std::vector<Ring> rings_of(const Footprint& at) {
  const LamarMap& map = at.lens.map;
  const std::size_t n = at.lens.radial_segments;
  std::vector<Ring> rings;
  for (std::size_t k = 0; k <= n; ++k) {
    const double r =
        k == n ? map.outer
               : map.inner + (map.outer - map.inner) * static_cast<double>(k) / static_cast<double>(n);
    const double f =
        k == n ? r : radial_profile(at.lens.border, at.plane.minification, map.inner, map.outer, r).value;
    rings.push_back({r, f, r / f});
  }
  return rings;
}

/// Inside the inner radius: one polygon with one weight, so its map is affine. It belongs to the zoom region
/// only where the plane crosses that; in the warp depths the whole lens is border (LaMar §4.3, the blue
/// planes of Fig. 7).
Piece zoom_piece(const Footprint& at, const Ring& inner) {
  Piece piece;
  piece.region = at.crosses_zoom ? LensRegion::zoom : LensRegion::border;
  for (std::size_t j = 0; j < at.lens.ring.size(); ++j) {
    piece.polygon.push_back(
        at.vertex(at.ring(j, inner.radius), at.ring(j, inner.texture_radius), inner.weight));
  }
  return piece;
}

void append_border(std::vector<Piece>& pieces, const Footprint& at, const std::vector<Ring>& rings) {
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    for (std::size_t j = 0; j < at.lens.ring.size(); ++j) {
      Piece piece;
      piece.region = LensRegion::border;
      const auto corner = [&](std::size_t spoke, const Ring& ring) {
        piece.polygon.push_back(
            at.vertex(at.ring(spoke, ring.radius), at.ring(spoke, ring.texture_radius), ring.weight));
      };
      corner(j, rings[k]);
      corner(j, rings[k + 1]);
      corner(j + 1, rings[k + 1]);
      corner(j + 1, rings[k]);
      pieces.push_back(std::move(piece));
    }
  }
}

/// The undisturbed region between a circle's outer ring and its bounding square (LaMar Fig. 6) in the fewest
/// triangles: each edge of the ring with the square's corner in whose quadrant it lies, and where that corner
/// changes, each side of the square passed with the ring's corner there (nothing where that touches the
/// side).
void append_square_rest(std::vector<Piece>& pieces, const Footprint& at) {
  const double outer = at.lens.map.outer;
  const std::size_t n = at.lens.ring.size();
  constexpr glm::dvec2 square[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  const auto quadrant = [&](std::size_t j) {
    const glm::dvec2 middle = at.lens.ring[j % n] + at.lens.ring[(j + 1) % n];
    return middle.y >= 0 ? (middle.x >= 0 ? 0U : 1U) : (middle.x < 0 ? 2U : 3U);
  };
  const auto append = [&](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    const glm::dvec2 ab = b - a;
    const glm::dvec2 ac = c - a;
    if (std::abs(ab.x * ac.y - ab.y * ac.x) > 1e-12)
      pieces.push_back({{at.still(outer * a), at.still(outer * b), at.still(outer * c)}, LensRegion::normal});
  };
  for (std::size_t j = 0; j < n; ++j) {
    const glm::dvec2 to = at.lens.ring[(j + 1) % n];
    append(square[quadrant(j)], to, at.lens.ring[j]);
    for (unsigned q = quadrant(j); q != quadrant(j + 1); q = (q + 1) % 4)
      append(square[q], square[(q + 1) % 4], to);
  }
}

LensPolygon undisturbed(const Polygon& polygon) {
  LensPolygon result;
  for (const glm::dvec3& corner : polygon)
    result.push_back({corner, glm::dvec4(corner, 1)});
  return result;
}

/// The outlines of the footprint as half-planes that look away from it.
std::vector<Plane> outward_sides(const Footprint& at) {
  std::vector<Plane> sides;
  const double outer = at.lens.map.outer;
  if (at.lens.bounded) {
    for (const glm::dvec2& normal :
         {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)})
      sides.push_back(at.half_plane(normal, outer));
    return sides;
  }
  for (std::size_t j = 0; j < at.lens.ring.size(); ++j) {
    const glm::dvec2 a = at.lens.ring[j];
    const glm::dvec2 normal = glm::normalize(a + at.lens.ring[(j + 1) % at.lens.ring.size()]);
    sides.push_back(at.half_plane(normal, outer * glm::dot(normal, a)));
  }
  return sides;
}

/// The polygon's corners across the view, in units of the lens' radii at this depth.
std::vector<glm::dvec2> seen_across(const LensPolygon& polygon, const Footprint& at) {
  std::vector<glm::dvec2> corners;
  for (const LensVertex& vertex : polygon) {
    const glm::dvec3 offset = box_from_texture(at.space, vertex.position) - at.plane.axis_point;
    corners.emplace_back(glm::dvec2(glm::dot(offset, at.lens.map.right), glm::dot(offset, at.lens.map.up)) /
                         at.plane.scale);
  }
  return corners;
}

/// One side of the footprint, or one edge of the convex polygon, has the other wholly beyond it.
bool apart(const LensPolygon& polygon, const Footprint& at, const std::vector<Plane>& sides) {
  for (const Plane& side : sides) {
    if (std::all_of(polygon.begin(), polygon.end(),
                    [&](const LensVertex& v) { return signed_value(side, v.position) >= 0; }))
      return true;
  }
  const std::vector<glm::dvec2> corners = seen_across(polygon, at);
  const double reach = at.lens.map.outer;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 edge = corners[(i + 1) % corners.size()] - corners[i];
    glm::dvec2 normal(edge.y, -edge.x);
    if (glm::dot(normal, corners[(i + 2) % corners.size()] - corners[i]) > 0)
      normal = -normal; // away from the polygon
    // How far the footprint (a square or a circle about 0) reaches against the normal.
    const double extent =
        reach * (at.lens.bounded ? std::abs(normal.x) + std::abs(normal.y) : glm::length(normal));
    if (-extent >= glm::dot(normal, corners[i]))
      return true;
  }
  return false;
}

/// What a convex polygon keeps outside the footprint, in convex parts: at most four beside a square, one for
/// each angular segment beside an unbounded circle.
std::vector<LensPolygon> outside(const LensPolygon& polygon, const Footprint& at) {
  std::vector<LensPolygon> parts;
  const double outer = at.lens.map.outer;
  const auto keep = [&](LensPolygon part) {
    if (part.size() >= 3)
      parts.push_back(std::move(part));
  };
  if (at.lens.bounded) {
    for (const std::vector<std::size_t>& corners : frame_around_square(seen_across(polygon, at), outer)) {
      LensPolygon part;
      for (const std::size_t i : corners)
        part.push_back(i < 4 ? at.still(outer * square_corners[i]) : polygon[i - 4]);
      parts.push_back(std::move(part));
    }
    if (!parts.empty())
      return parts;
    LensPolygon rest = polygon;
    for (const glm::dvec2& normal :
         {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
      keep(clip_position(rest, at.half_plane(normal, outer)));
      rest = clip_position(rest, at.half_plane(-normal, -outer));
    }
    return parts;
  }
  const std::size_t n = at.lens.ring.size();
  for (std::size_t j = 0; j < n; ++j) {
    const glm::dvec2 a = at.lens.ring[j];
    const glm::dvec2 b = at.lens.ring[(j + 1) % n];
    const glm::dvec2 edge_normal = glm::normalize(a + b);
    LensPolygon part = clip_position(polygon, at.half_plane(edge_normal, outer * glm::dot(edge_normal, a)));
    part = clip_position(part, at.half_plane({-a.y, a.x}, 0));
    keep(clip_position(part, at.half_plane({b.y, -b.x}, 0)));
  }
  return parts;
}

void append_piece(LensMesh& mesh, const Piece& piece) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), piece.polygon.begin(), piece.polygon.end());
  for (const auto& [a, b, c] : triangulate(piece.polygon)) {
    mesh.triangles.insert(mesh.triangles.end(), {first + a, first + b, first + c});
    mesh.regions.push_back(piece.region);
  }
}

/// Pieces of one lens on the slice, before they are clipped to the volume.
std::vector<Piece> lens_pieces(const Footprint& at) {
  std::vector<Piece> pieces;
  const std::vector<Ring> rings = rings_of(at);
  pieces.push_back(zoom_piece(at, rings.front()));
  append_border(pieces, at, rings);
  if (at.lens.bounded && !at.lens.map.square)
    append_square_rest(pieces, at);
  return pieces;
}

/// The slice with the footprints of the lenses that reach it taken out, and what fills those.
struct Parts {
  std::vector<LensPolygon> normal;
  std::vector<Piece> pieces;
};

template <class Fill>
Parts part_slice(const Polygon& polygon, const std::vector<LensTessellation>& lenses, const BoxSpace& space,
                 Fill fill) {
  const LensPolygon whole = undisturbed(polygon);
  Parts parts{{whole}, {}};
  for (const LensTessellation& lens : lenses) {
    const double z = glm::dot(box_from_texture(space, polygon[0]) - lens.map.center, lens.map.forward);
    const Footprint at{lens, space, lens_plane(lens.map, z), std::abs(z) <= lens.map.depth_inner};
    const std::vector<Plane> sides = outward_sides(at);
    // Profiles map the footprint onto itself, so one beside the slice shows nothing of it.
    if (!at.plane.touched || apart(whole, at, sides))
      continue;
    std::vector<LensPolygon> rest;
    for (const LensPolygon& part : parts.normal) {
      if (apart(part, at, sides)) {
        rest.push_back(part);
        continue;
      }
      for (LensPolygon& outer : outside(part, at))
        rest.push_back(std::move(outer));
    }
    parts.normal = std::move(rest);
    for (Piece& piece : fill(at))
      parts.pieces.push_back(std::move(piece));
  }
  return parts;
}

/// Triangles of all parts, with shared corners and cut by the planes.
LensMesh joined(Parts parts, const LensClip& clip_planes) {
  const bool shared = !parts.pieces.empty();
  for (LensPolygon& part : parts.normal)
    parts.pieces.push_back({std::move(part), LensRegion::normal});
  if (shared) {
    std::vector<LensPolygon*> polygons;
    for (Piece& piece : parts.pieces)
      polygons.push_back(&piece.polygon);
    share_corners(polygons);
  }
  LensMesh mesh;
  for (Piece& piece : parts.pieces) {
    for (const Plane& plane : clip_planes.texture)
      piece.polygon = clip(piece.polygon, homogeneous(plane));
    for (const Plane& plane : clip_planes.object)
      piece.polygon = clip_position(piece.polygon, plane);
    if (piece.polygon.size() >= 3)
      append_piece(mesh, piece);
  }
  return mesh;
}

} // namespace

LensMesh tessellate_slice(const Polygon& polygon, const std::vector<LensTessellation>& lenses,
                          const BoxSpace& space, const LensClip& clip_planes) {
  if (polygon.size() < 3)
    return {};
  Parts parts = part_slice(polygon, lenses, space, lens_pieces);
  const std::vector<TextureHalfSpace> faces = faces_of(glm::dvec3(0), glm::dvec3(1));
  for (Piece& piece : parts.pieces) {
    for (const TextureHalfSpace& face : faces)
      piece.polygon = clip(piece.polygon, face);
  }
  return joined(std::move(parts), clip_planes);
}

LensMesh cover_slice(const Polygon& polygon, const std::vector<LensTessellation>& lenses,
                     const BoxSpace& space, const std::vector<Plane>& object_clip) {
  if (polygon.size() < 3)
    return {};
  std::vector<LensTessellation> squares = lenses;
  for (LensTessellation& lens : squares)
    lens.bounded = true;
  const auto whole_square = [](const Footprint& at) {
    Piece whole;
    whole.region = LensRegion::zoom;
    for (const glm::dvec2& corner :
         {glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(-1, -1)}) {
      whole.polygon.push_back(at.still(at.lens.map.outer * corner));
    }
    return std::vector<Piece>{whole};
  };
  return joined(part_slice(polygon, squares, space, whole_square), {{}, object_clip});
}

void refuse_overlap(const std::vector<LensTessellation>& lenses) {
  for (std::size_t i = 0; i < lenses.size(); ++i) {
    for (std::size_t j = i + 1; j < lenses.size(); ++j) {
      const LamarMap& a = lenses[i].map;
      const LamarMap& b = lenses[j].map;
      const double depth = glm::dot(b.center - a.center, a.forward);
      if (std::abs(depth) >= a.depth_outer + b.depth_outer)
        continue;
      // At the depth of b's centre; under perspective both footprints scale alike.
      const LensPlane plane = lens_plane(a, depth);
      const glm::dvec3 offset = b.center - plane.axis_point;
      const glm::dvec2 across(std::abs(glm::dot(offset, a.right)), std::abs(glm::dot(offset, a.up)));
      const bool squares = lenses[i].bounded || lenses[j].bounded;
      const double distance = squares ? std::max(across.x, across.y) : glm::length(across);
      if (distance < a.outer * plane.scale + b.outer) {
        throw UsageError("warp 'lamar': lenses " + std::to_string(i) + " and " + std::to_string(j) +
                         " overlap; move them apart, shrink outer or depth_outer" +
                         (squares ? ", or set bounded to false so that circles may stand closer" : ""));
      }
    }
  }
}

} // namespace slicelens
