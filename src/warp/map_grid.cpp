#include "warp/map_grid.h"

#include "core/errors.h"
#include "core/text.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace slicelens::shared {

/// GLSL's name for a grid, and how the shared functions read it.
struct GridFunctions {
  SLICELENS_SHARED_NAMES(double)
  using ivec3 = glm::ivec3;
  using GridRef = const MapGrid*;

  static vec3 grid_node(GridRef grid, ivec3 i) {
    const auto index =
        (static_cast<std::size_t>(i.z) * grid->size[1] + static_cast<std::size_t>(i.y)) * grid->size[0] +
        static_cast<std::size_t>(i.x);
    return vec3(grid->offsets[index]);
  }

  /// Trilinear at x, counted in nodes and within the grid.
  static vec3 sample_grid(GridRef grid, vec3 x, vec3) {
    const ivec3 last(grid->size[0] - 1, grid->size[1] - 1, grid->size[2] - 1);
    const ivec3 i = min(ivec3(x), last - 1);
    const vec3 f = x - vec3(i);
    vec3 sum(0);
    for (int corner = 0; corner < 8; ++corner) {
      const ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
      const vec3 w(step.x == 1 ? f.x : 1 - f.x, step.y == 1 ? f.y : 1 - f.y, step.z == 1 ? f.z : 1 - f.z);
      sum += w.x * w.y * w.z * grid_node(grid, i + step);
    }
    return sum;
  }

#include "warp/grid.glsl"
};

} // namespace slicelens::shared

namespace slicelens {

namespace {

using shared::GridFunctions;

GridFunctions::GridMap shared_map(const MapGrid& grid) {
  const glm::dvec3 nodes(grid.size[0], grid.size[1], grid.size[2]);
  return {grid.low, grid.high, nodes - 1.0, (nodes - 1.0) / (grid.high - grid.low), 1.0 / nodes, &grid};
}

void check_grid(const std::array<std::size_t, 3>& size, const glm::dvec3& low, const glm::dvec3& high) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size[axis] < min_grid_nodes || size[axis] > max_grid_nodes) {
      throw UsageError("a grid of maps takes from " + std::to_string(min_grid_nodes) + " to " +
                       std::to_string(max_grid_nodes) + " nodes on every axis, not " +
                       std::to_string(size[axis]));
    }
    const int a = static_cast<int>(axis);
    if (!(high[a] > low[a]) || !std::isfinite(high[a] - low[a]))
      throw UsageError("a grid of maps needs a box that is longer than 0 on every axis");
  }
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

} // namespace

glm::dvec3 node_position(const MapGrid& grid, std::size_t i, std::size_t j, std::size_t k) {
  const glm::dvec3 at(static_cast<double>(i) / static_cast<double>(grid.size[0] - 1),
                      static_cast<double>(j) / static_cast<double>(grid.size[1] - 1),
                      static_cast<double>(k) / static_cast<double>(grid.size[2] - 1));
  return grid.low + at * (grid.high - grid.low);
}

MapGrid make_map_grid(const PointMap& map, const std::array<std::size_t, 3>& size, const glm::dvec3& low,
                      const glm::dvec3& high) {
  check_grid(size, low, high);
  MapGrid grid{size, low, high, std::vector<glm::vec4>(size[0] * size[1] * size[2])};
  std::atomic<bool> finite = true;
  tbb::parallel_for(std::size_t{0}, size[1] * size[2], [&](std::size_t row) {
    const std::size_t j = row % size[1];
    const std::size_t k = row / size[1];
    for (std::size_t i = 0; i < size[0]; ++i) {
      const glm::dvec3 p = node_position(grid, i, j, k);
      const glm::dvec3 offset = map(p) - p;
      if (!is_finite(offset))
        finite = false;
      grid.offsets[row * size[0] + i] = glm::vec4(offset, 0);
    }
  });
  if (!finite)
    throw UsageError("the map of a warp is not finite everywhere and cannot be held in a grid");
  return grid;
}

MapGrid make_map_grid(const GridFill& offsets, const std::array<std::size_t, 3>& size, const glm::dvec3& low,
                      const glm::dvec3& high) {
  check_grid(size, low, high);
  MapGrid grid{size, low, high, {}};
  grid.offsets.reserve(size[0] * size[1] * size[2]);
  for (const glm::dvec3& offset : offsets(size, low, high)) {
    if (!is_finite(offset))
      throw UsageError("the map of a warp is not finite everywhere and cannot be held in a grid");
    grid.offsets.emplace_back(offset, 0);
  }
  return grid;
}

glm::dvec3 texture_from_object(const GridMap& map, const glm::dvec3& p) {
  return GridFunctions().grid_texture_from_object(shared_map(*map.grid), p);
}

glm::dmat3 jacobian(const GridMap& map, const glm::dvec3& p) {
  return GridFunctions().grid_jacobian(shared_map(*map.grid), p);
}

glm::dvec3 object_from_texture(const GridMap& map, const glm::dvec3& u) {
  glm::dvec3 p = u - (texture_from_object(map, u) - u);
  glm::dvec3 miss = texture_from_object(map, p) - u;
  for (int step = 0; step < 100 && glm::length(miss) > 1e-13; ++step) {
    const glm::dmat3 j = jacobian(map, p);
    const glm::dvec3 full = std::abs(glm::determinant(j)) > 1e-9 ? glm::inverse(j) * miss : miss;
    double length = 1;
    glm::dvec3 next = p - full;
    glm::dvec3 next_miss = texture_from_object(map, next) - u;
    // The derivative jumps between cells: shorter steps where a whole one leads away.
    while (glm::length(next_miss) >= glm::length(miss) && length > 1e-6) {
      length *= 0.5;
      next = p - length * full;
      next_miss = texture_from_object(map, next) - u;
    }
    if (glm::length(next_miss) >= glm::length(miss))
      break;
    p = next;
    miss = next_miss;
  }
  return p;
}

namespace {

/// Bounds of the cells that show something of the box [box_low, box_high]; unchanged without such cells.
void shown_cells(const MapGrid& grid, const glm::dvec3& box_low, const glm::dvec3& box_high, glm::dvec3& low,
                 glm::dvec3& high) {
  const auto& n = grid.size;
  const auto point = [&](std::size_t i, std::size_t j, std::size_t k) {
    return node_position(grid, i, j, k) + glm::dvec3(grid.offsets[(k * n[1] + j) * n[0] + i]);
  };
  glm::dvec3 first(HUGE_VAL);
  glm::dvec3 last(-HUGE_VAL);
  for (std::size_t cell = 0; cell < (n[0] - 1) * (n[1] - 1) * (n[2] - 1); ++cell) {
    const std::size_t i = cell % (n[0] - 1);
    const std::size_t j = cell / (n[0] - 1) % (n[1] - 1);
    const std::size_t k = cell / (n[0] - 1) / (n[1] - 1);
    glm::dvec3 lowest(HUGE_VAL);
    glm::dvec3 highest(-HUGE_VAL);
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const glm::dvec3 u = point(i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2));
      lowest = glm::min(lowest, u);
      highest = glm::max(highest, u);
    }
    if (glm::any(glm::greaterThan(lowest, box_high)) || glm::any(glm::lessThan(highest, box_low)))
      continue;
    first = glm::min(first, node_position(grid, i, j, k));
    last = glm::max(last, node_position(grid, i + 1, j + 1, k + 1));
  }
  if (glm::all(glm::lessThan(first, last))) {
    low = first;
    high = last;
  }
}

} // namespace

namespace {

/// Each pass has smaller cells.
template <class Map>
void tighten(const Map& map, const glm::dvec3& size, glm::dvec3& low, glm::dvec3& high) {
  for (int pass = 0; pass < 3; ++pass)
    shown_cells(make_map_grid(map, {17, 17, 17}, low, high), glm::dvec3(0), size, low, high);
}

} // namespace

void tighten_bounds(const PointMap& map, const glm::dvec3& size, glm::dvec3& low, glm::dvec3& high) {
  tighten(map, size, low, high);
}

void tighten_bounds(const GridFill& offsets, const glm::dvec3& size, glm::dvec3& low, glm::dvec3& high) {
  tighten(offsets, size, low, high);
}

void grid_bounds(const MapGrid& grid, const glm::dvec3& box_low, const glm::dvec3& box_high, glm::dvec3& low,
                 glm::dvec3& high) {
  low = grid.low;
  high = grid.high;
  shown_cells(grid, box_low, box_high, low, high);
  const auto& n = grid.size;
  const glm::dvec3 cell = node_position(grid, 1, 1, 1) - grid.low;
  for (std::size_t index = 0; index < grid.offsets.size(); ++index) {
    const std::array<std::size_t, 3> at = {index % n[0], index / n[0] % n[1], index / n[0] / n[1]};
    const glm::dvec3 offset(grid.offsets[index]);
    const glm::dvec3 node = node_position(grid, at[0], at[1], at[2]);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (at[a] != 0 && at[a] + 1 != n[a])
        continue;
      // Outside the face all points move as its nodes do: p = u − offset, where the other axes show the box.
      glm::dvec3 u = node + offset;
      u[axis] = box_low[axis];
      if (glm::any(glm::lessThan(u, box_low - cell)) || glm::any(glm::greaterThan(u, box_high + cell)))
        continue;
      const double p = (at[a] == 0 ? box_low : box_high)[axis] - offset[axis];
      const bool beyond = at[a] == 0 ? p < grid.low[axis] : p > grid.high[axis];
      if (!beyond)
        continue;
      low = glm::min(low, grid.low);
      high = glm::max(high, grid.high);
      low[axis] = std::min(low[axis], p);
      high[axis] = std::max(high[axis], p);
    }
  }
}

double smallest_determinant(const MapGrid& grid) {
  const GridMap map{std::shared_ptr<const MapGrid>(std::shared_ptr<const MapGrid>(), &grid)};
  double smallest = HUGE_VAL;
  const glm::dvec3 cell = node_position(grid, 1, 1, 1) - grid.low;
  for (std::size_t k = 0; k + 1 < grid.size[2]; ++k) {
    for (std::size_t j = 0; j + 1 < grid.size[1]; ++j) {
      for (std::size_t i = 0; i + 1 < grid.size[0]; ++i) {
        const glm::dvec3 corner = node_position(grid, i, j, k);
        for (int c = 0; c < 8; ++c) {
          // Just inside the cell: on its face the derivative may be the neighbour's.
          const glm::dvec3 inside(c & 1 ? 0.999 : 0.001, c & 2 ? 0.999 : 0.001, c & 4 ? 0.999 : 0.001);
          smallest = std::min(smallest, glm::determinant(jacobian(map, corner + inside * cell)));
        }
      }
    }
  }
  return smallest;
}

} // namespace slicelens
