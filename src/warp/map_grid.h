// Inverse maps sampled on a grid of nodes: what a 3D texture holds (docs/papers/brunet_maps.md).
#pragma once

#include "warp/shared_axis_maps.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace slicelens {

/// Limits of the nodes on each axis.
inline constexpr std::size_t min_grid_nodes = 2;
inline constexpr std::size_t max_grid_nodes = 128;

/// Displacements u − p at nodes, trilinear between them (Brunet, Nowak and Gleicher 2006 §4). The first and
/// last nodes of an axis lie on the box's faces. Displacements rather than points: where nothing moves they
/// are exactly 0, and small ones keep their float precision far from the origin.
struct MapGrid {
  std::array<std::size_t, 3> size{2, 2, 2}; ///< nodes on each axis
  glm::dvec3 low{0};                        ///< box space: of node (0, 0, 0)
  glm::dvec3 high{1};                       ///< of the last node
  std::vector<glm::vec4> offsets;           ///< u − p and 0; x fastest, then y, then z
};

/// From a displayed point to the point of the data, both in box space.
using PointMap = std::function<glm::dvec3(const glm::dvec3&)>;

/// Where node (i, j, k) is, box space.
glm::dvec3 node_position(const MapGrid& grid, std::size_t i, std::size_t j, std::size_t k);

/// Samples `map`, which several threads call at once. Throws UsageError for sizes beyond the limits, and
/// where low < high does not hold on every axis or a value is not finite.
MapGrid make_map_grid(const PointMap& map, const std::array<std::size_t, 3>& size, const glm::dvec3& low,
                      const glm::dvec3& high);

/// How else a grid may be filled: all its nodes at once.
using GridFill = std::function<std::vector<glm::dvec3>(const std::array<std::size_t, 3>& size,
                                                       const glm::dvec3& low, const glm::dvec3& high)>;

/// The same from displacements u − p of all nodes, x fastest.
MapGrid make_map_grid(const GridFill& offsets, const std::array<std::size_t, 3>& size, const glm::dvec3& low,
                      const glm::dvec3& high);

/// A grid as a map: what shaders/warp/grid.glsl computes.
struct GridMap {
  std::shared_ptr<const MapGrid> grid; ///< never null
};

/// The inverse map and its derivative at p, box space, in double precision; on the faces of a cell the
/// derivative is that of the cell above. Beyond the grid's box: the displacement of the nearest point of it.
glm::dvec3 texture_from_object(const GridMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const GridMap& map, const glm::dvec3& p);

/// The forward map by Newton's method, to 1e-12 where the grid does not fold; the nearest point found
/// elsewhere.
glm::dvec3 object_from_texture(const GridMap& map, const glm::dvec3& u);

/// The texture with the displacements is the renderer's to set.
template <class Set>
void visit_fields(const GridMap& map, const Set& set) {
  const glm::dvec3 nodes(map.grid->size[0], map.grid->size[1], map.grid->size[2]);
  set("low", map.grid->low);
  set("high", map.grid->high);
  set("cells", nodes - 1.0);
  set("scale", (nodes - 1.0) / (map.grid->high - map.grid->low));
  set("texel", 1.0 / nodes);
}

/// A box that holds every point where `map` shows something of the data box [0, size], found from the map on
/// a grid of cells over [low, high]: never too small by more than the map bends within a cell. [low, high]
/// itself where nothing is shown.
void tighten_bounds(const PointMap& map, const glm::dvec3& size, glm::dvec3& low, glm::dvec3& high);
void tighten_bounds(const GridFill& offsets, const glm::dvec3& size, glm::dvec3& low, glm::dvec3& high);

/// Bounds of where the grid's map shows the points of a box, box space; conservative.
void grid_bounds(const MapGrid& grid, const glm::dvec3& box_low, const glm::dvec3& box_high, glm::dvec3& low,
                 glm::dvec3& high);

/// Smallest determinant of the trilinear cells' derivative at their corners: at 0 or below the map folds.
double smallest_determinant(const MapGrid& grid);

} // namespace slicelens
