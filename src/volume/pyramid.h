// Coarser copies and parts of a volume.
#pragma once

#include "volume/volume.h"

#include <array>
#include <cstddef>

namespace slicelens {

/// Voxels of level k of a pyramid over `dims`: ⌈N/2ᵏ⌉ on each axis.
std::array<std::size_t, 3> level_dims(const std::array<std::size_t, 3>& dims, std::size_t level);

/// The next coarser level: voxel i is the mean of voxels 2i and 2i+1 on each axis. Where N is odd the last
/// voxel is paired with itself, so the level reaches one fine voxel beyond the box and holds there what
/// clamping to the edge would read. Voxel centres keep their place: (i+½)·2/N in the finer volume's texture
/// coordinates, so linear data stay linear away from the edges, and exact for any N.
///
/// 32-bit floats, or 64-bit ones where those would lose what the source holds; non-finite voxels count as the
/// smallest finite value. min and max stay the source's, as the range that texels are spread over. Throws
/// UsageError for several components.
Volume half_size(const Volume& volume);

/// half_size's result without voxels: its grid, place, type and statistics.
Volume coarser_outline(const Volume& volume);

/// The type of the levels above one of this type.
ScalarType coarser_type(ScalarType type);

/// The voxels [first, first + size), in their place in the world; min and max stay the whole volume's. Of a
/// streamed volume they are read from its file. Throws UsageError for a box that is empty or reaches beyond
/// the volume, and what VoxelStream::read throws.
Volume crop(const Volume& volume, const std::array<std::size_t, 3>& first,
            const std::array<std::size_t, 3>& size);

} // namespace slicelens
