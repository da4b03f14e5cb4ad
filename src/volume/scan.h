// One pass over voxels that stay in their file: what is to be known of all of them at once.
#pragma once

#include "core/progress.h"
#include "volume/cell_ranges.h"
#include "volume/streamed.h"
#include "volume/volume.h"

#include <cstddef>
#include <vector>

namespace slicelens {

struct VoxelScan {
  double min = 0; ///< these four as update_statistics gives them; the mean up to rounding
  double max = 0;
  double mean = 0;
  std::size_t non_finite = 0;
  CellRanges cells;            ///< cell_ranges(volume, 2)
  std::vector<double> samples; ///< transfer_samples(volume)
};

/// The reach of the ranges above.
inline constexpr std::size_t scan_reach = 2;

/// Reads every voxel once, in the file's order, a few MiB at a time on each of at most `threads` threads (0:
/// all cores). Holds two scalars for each cell of the grid besides. `volume` gives dims and type. Throws what
/// the stream's read throws.
VoxelScan scan_voxels(const VoxelStream& stream, const Volume& volume, int threads, const Progress& progress);

/// What is known of a volume already, streamed or in memory with its statistics.
VoxelScan scan_of(const Volume& volume);

/// Puts the statistics into the volume.
void set_statistics(Volume& volume, const VoxelScan& scan);

} // namespace slicelens
