// Volumes that stay on disk: their voxels are read box by box when they are needed.
#pragma once

#include "volume/cell_ranges.h"
#include "volume/volume.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace slicelens {

/// The voxels [first, first + size).
struct VoxelBox {
  std::array<std::size_t, 3> first{0, 0, 0};
  std::array<std::size_t, 3> size{0, 0, 0};
};

/// Number of voxels. Throws LimitError on overflow.
std::size_t voxel_count(const VoxelBox& box);

/// The voxels of one volume of one component, in a file. Several threads may read at a time.
class VoxelStream {
public:
  VoxelStream() = default;
  virtual ~VoxelStream() = default;
  VoxelStream(const VoxelStream&) = delete;
  VoxelStream& operator=(const VoxelStream&) = delete;

  /// Writes a box, which lies in the volume, into `out`, which has exactly its size: x fastest, then y, then
  /// z, tightly packed, of the volume's type, in the machine's byte order. Throws FileError naming the file
  /// where it has become shorter or was changed since it was opened, is damaged or cannot be read.
  virtual void read(const VoxelBox& box, std::span<std::byte> out) const = 0;
  /// Edges of the smallest box that one access gives without reading more than it: rows, planes or bricks.
  virtual std::array<std::size_t, 3> grain() const = 0;
  /// Bytes that reading has taken from the file so far.
  virtual std::uint64_t bytes_read() const = 0;
};

/// What a volume knows of voxels that it does not hold, beside the statistics that it has.
struct StreamedVoxels {
  std::unique_ptr<const VoxelStream> stream;
  CellRanges cells;            ///< with a reach of 2: every filter's
  std::vector<double> samples; ///< component values on the stride that automatic_transfer takes
  std::vector<Volume> coarser; ///< levels 1, 2 … of the pyramid (volume/pyramid.h), streamed as well
  std::string where;           ///< "stream" or "cache", and the file, for people
};

/// Whether the voxels are in a file only.
inline bool is_streamed(const Volume& volume) { return volume.streamed != nullptr; }

/// Throws UsageError for a streamed volume: `what` ("pipeline 'reference'") needs all voxels at once; set
/// volume.access to memory.
void require_voxels(const Volume& volume, const std::string& what);

} // namespace slicelens
