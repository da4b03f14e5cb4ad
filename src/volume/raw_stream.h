// Voxels that are read from the files that hold them as they are. Private to src/volume.
#pragma once

#include "volume/raw_layout.h"
#include "volume/streamed.h"

#include <memory>

namespace slicelens {

/// Most scalars from voxel to voxel of a row that are read only to be left out (other components, frames).
inline constexpr std::uintmax_t most_row_step = 8;

/// A stream over component `component` of `opened`, whose layout is set, or null where its rows are scattered
/// over more than most_row_step. Reads by pread, so that nothing but the boxes asked for is held in memory.
/// Throws FileError where a file cannot be opened or is shorter than the layout says.
std::unique_ptr<const VoxelStream> raw_stream(const OpenedVolume& opened, int component);

} // namespace slicelens
