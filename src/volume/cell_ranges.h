// The smallest and the largest value around each cell of a volume: what tells where nothing shows.
#pragma once

#include "volume/volume.h"

#include <array>
#include <cstddef>
#include <vector>

namespace slicelens {

/// Voxels along the edge of a cell, if nothing else is asked for.
inline constexpr std::size_t cell_edge = 8;
/// Of the cells that samples are passed over by.
inline constexpr std::size_t small_cell_edge = 4;

/// Cell (i, j, k) holds the points with texture coordinates from edge·(i, j, k)/N to
/// edge·(i + 1, j + 1, k + 1)/N, the last ones less.
struct CellRanges {
  std::array<std::size_t, 3> size{0, 0, 0}; ///< cells on each axis: ⌈N/edge⌉
  std::size_t edge = cell_edge;             ///< voxels along the edge of a cell
  std::size_t reach = 0;                    ///< see cell_ranges
  std::vector<float> smallest; ///< of each cell, x fastest: at most the smallest value, rounded down
  std::vector<float> largest;  ///< rounded up
};

/// Ranges of all voxels that a filter may read for points of a cell: those whose centres lie in it and
/// `reach` more on each side. Linear filters read 1 (a point between the outermost centre and the face of its
/// cell reads the next voxel), the cubic B-spline 2. All cores. `volume` has one component; values that are
/// no number count as the volume's smallest. edge ≥ 1.
CellRanges cell_ranges(const Volume& volume, std::size_t reach, std::size_t edge = cell_edge);

/// The nearest floats that are at most and at least `value`.
float rounded_down(double value);
float rounded_up(double value);

} // namespace slicelens
