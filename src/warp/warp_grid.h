// Any list of warps in one grid: pipeline `grid` (docs/papers/brunet_maps.md).
#pragma once

#include "warp/map_grid.h"
#include "warp/warp.h"

namespace slicelens {

/// The list's inverse map on nodes from `low` to `high`, box space. Throws as the other make_map_grid does.
MapGrid make_map_grid(const std::vector<WarpMap>& maps, const std::array<std::size_t, 3>& size,
                      const glm::dvec3& low, const glm::dvec3& high);

/// How far points of the data are from where they should be, in voxels.
struct MapGridError {
  double largest = 0;
  double rms = 0;
};

/// |u_grid − u_exact| at 96³ points spread evenly over the grid's box, of those where either looks into the
/// data box [0, space.size]. `voxels`: of the volume, on each axis.
MapGridError map_grid_error(const MapGrid& grid, const std::vector<WarpMap>& maps, const BoxSpace& space,
                            const glm::dvec3& voxels);

} // namespace slicelens
