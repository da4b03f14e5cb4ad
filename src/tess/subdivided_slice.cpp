#include "tess/subdivided_slice.h"

#include "tess/homogeneous.h"
#include "tess/shared_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slicelens {

namespace {

/// The slice's plane with its grid. Coordinates across the view, box space.
struct Grid {
  const BoxSpace& space;
  const WarpView& view;
  double depth = 0; ///< of the plane along view.forward
  glm::dvec2 low{0};
  double cell = 1; ///< edge
  std::size_t columns = 0;
  std::size_t rows = 0;

  /// Texture coordinates of a node.
  glm::dvec3 node(std::size_t column, std::size_t row) const {
    const glm::dvec2 across = low + cell * glm::dvec2(column, row);
    return texture_from_box(space, across.x * view.right + across.y * view.up + depth * view.forward);
  }
};

Grid grid_over(const Polygon& polygon, const BoxSpace& space, const WarpView& view, std::size_t cells) {
  Grid grid{space, view};
  glm::dvec2 low(std::numeric_limits<double>::infinity());
  glm::dvec2 high = -low;
  double longest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 corner = box_from_texture(space, polygon[i]);
    const glm::dvec3 next = box_from_texture(space, polygon[(i + 1) % polygon.size()]);
    longest = std::max(longest, glm::distance(corner, next));
    const glm::dvec2 across(glm::dot(corner, view.right), glm::dot(corner, view.up));
    low = glm::min(low, across);
    high = glm::max(high, across);
  }
  grid.depth = glm::dot(box_from_texture(space, polygon[0]), view.forward);
  grid.low = low;
  grid.cell = longest / static_cast<double>(cells);
  const auto count = [&](double extent) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(extent / grid.cell - 1e-9)));
  };
  grid.columns = count(high.x - low.x);
  grid.rows = count(high.y - low.y);
  return grid;
}

/// The polygon's edges as planes across the slice, of that normal, that look inwards. A hair outwards, so
/// that nodes on an edge are inside and leave no slivers.
std::vector<Plane> edge_planes(const Polygon& polygon, const glm::dvec3& normal, double hair) {
  glm::dvec3 middle(0);
  for (const glm::dvec3& corner : polygon)
    middle += corner / static_cast<double>(polygon.size());
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    Plane plane{glm::cross(normal, edge), 0};
    const double size = glm::length(plane.normal);
    if (!(glm::length(edge) > 1e-9 && size > 0))
      continue; // of two corners in one place: its direction is rounding
    plane.normal /= size;
    plane.offset = glm::dot(plane.normal, polygon[i]);
    if (signed_value(plane, middle) < 0)
      plane = {-plane.normal, -plane.offset};
    plane.offset -= hair;
    planes.push_back(plane);
  }
  return planes;
}

LensVertex looking(const glm::dvec3& position, const std::vector<WarpMap>& maps, const BoxSpace& space) {
  const glm::dvec3 u = texture_from_object(maps, box_from_texture(space, position));
  return {position, glm::dvec4(texture_from_box(space, u), 1)};
}

/// As a share of a cell's.
double area_of(const LensPolygon& polygon, const Grid& grid) {
  Polygon positions;
  for (const LensVertex& corner : polygon)
    positions.push_back(box_from_texture(grid.space, corner.position));
  return positions.size() < 3 ? 0 : area(positions) / (grid.cell * grid.cell);
}

void append_polygon(LensMesh& mesh, const LensPolygon& polygon, const std::vector<WarpMap>& maps,
                    const BoxSpace& space) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const LensVertex& corner : polygon)
    mesh.vertices.push_back(looking(corner.position, maps, space));
  for (const auto& [a, b, c] : triangulate(polygon)) {
    mesh.triangles.insert(mesh.triangles.end(), {first + a, first + b, first + c});
    mesh.regions.push_back(LensRegion::border);
  }
}

} // namespace

LensMesh subdivide_slice(const Polygon& polygon, const std::vector<WarpMap>& maps, const BoxSpace& space,
                         const WarpView& view, std::size_t cells) {
  LensMesh mesh;
  if (polygon.size() < 3)
    return mesh;
  const Grid grid = grid_over(polygon, space, view, cells);
  const std::vector<Plane> edges = edge_planes(polygon, view.forward * space.size, 1e-11 * grid.cell);
  if (edges.size() < 3)
    return mesh;
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  const std::size_t stride = grid.columns + 1;
  std::vector<glm::dvec3> nodes;
  std::vector<char> inside;
  std::vector<std::uint32_t> index(stride * (grid.rows + 1), none); ///< of a node's vertex, once it is needed
  for (std::size_t row = 0; row <= grid.rows; ++row) {
    for (std::size_t column = 0; column <= grid.columns; ++column) {
      nodes.push_back(grid.node(column, row));
      inside.push_back(std::all_of(edges.begin(), edges.end(),
                                   [&](const Plane& edge) { return signed_value(edge, nodes.back()) >= 0; }));
    }
  }
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const std::size_t a = row * stride + column;
      const std::array<std::size_t, 4> corners = {a, a + 1, a + stride + 1, a + stride};
      if (std::all_of(corners.begin(), corners.end(), [&](std::size_t i) { return inside[i] != 0; })) {
        for (const std::size_t i : corners) {
          if (index[i] == none) {
            index[i] = static_cast<std::uint32_t>(mesh.vertices.size());
            mesh.vertices.push_back(looking(nodes[i], maps, space));
          }
        }
        for (const std::size_t corner : {0, 1, 2, 0, 2, 3})
          mesh.triangles.push_back(index[corners[corner]]);
        mesh.regions.insert(mesh.regions.end(), 2, LensRegion::border);
        continue;
      }
      LensPolygon cell;
      for (const std::size_t i : corners)
        cell.push_back({nodes[i], glm::dvec4(nodes[i], 1)});
      for (const Plane& edge : edges)
        cell = clip_position(cell, edge);
      if (area_of(cell, grid) > 1e-10) // no slivers of that hair
        append_polygon(mesh, cell, maps, space);
    }
  }
  return mesh;
}

} // namespace slicelens
