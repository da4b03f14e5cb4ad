// A file that holds a volume in bricks, with coarser levels of it: what stands in for formats whose voxels
// cannot be read in parts. Private to src/volume. docs/bricks.md describes the file.
#pragma once

#include "core/progress.h"
#include "volume/scan.h"
#include "volume/streamed.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// Voxels along the edge of a brick, without what it holds of its neighbours.
inline constexpr std::size_t file_brick = 64;

/// Voxels that a brick holds of its neighbours on each side, where there are any.
inline constexpr std::size_t file_brick_overlap = 4;

/// How one level is cut, and where its bricks are in the file.
struct BrickGrid {
  std::array<std::size_t, 3> dims{1, 1, 1};   ///< voxels
  std::array<std::size_t, 3> bricks{1, 1, 1}; ///< ⌈dims / file_brick⌉
  ScalarType type = ScalarType::u8;
  std::vector<std::uint64_t> offsets;  ///< of each brick, x fastest, and of what follows the last one
  std::vector<std::uint32_t> checksum; ///< CRC-32 of each

  std::size_t count() const { return bricks[0] * bricks[1] * bricks[2]; }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * bricks[1] + j) * bricks[0] + i;
  }
  /// The voxels that a brick holds, with its overlap.
  VoxelBox box(std::size_t brick) const;
};

/// The grid of a level whose first brick is at byte `start`. Throws LimitError on overflow.
BrickGrid brick_grid(const std::array<std::size_t, 3>& dims, ScalarType type, std::uint64_t start);

/// What identifies the voxels that were put into a file.
struct BrickSource {
  std::string name;   ///< of the source, for people
  std::string sha256; ///< of the source's files (volume/read.h)
  std::string choice; ///< which of its voxels
  friend bool operator==(const BrickSource& a, const BrickSource& b) {
    return a.sha256 == b.sha256 && a.choice == b.choice;
  }
};

struct BrickHeader {
  Volume volume; ///< without voxels
  BrickSource source;
  VoxelScan scan;
  std::vector<BrickGrid> levels; ///< 0 first
};

/// Reads and checks a file's header. Throws FileError when the file is none of these, is truncated or
/// damaged. `files` gives the size.
BrickHeader read_brick_header(const std::filesystem::path& path);

/// The volume of such a file, its coarser levels with it. Its streams hold at most 64 MiB of bricks together;
/// each brick's checksum is compared when it is read.
Volume open_bricks(const std::filesystem::path& path, BrickHeader header);

/// Writes `volume`, of one component, streamed or in memory, with its statistics, and coarser levels of it up
/// to `levels` in all (volume/pyramid.h). The file appears under its name only when it is complete and on the
/// disk. Throws FileError when it cannot be written in full.
void write_bricks(const std::filesystem::path& path, const Volume& volume, const BrickSource& source,
                  std::size_t levels, const Progress& progress);

} // namespace slicelens
