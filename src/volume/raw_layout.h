// Where the voxels of a volume lie in files that hold them as they are. Private to src/volume.
#pragma once

#include "volume/volume.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace slicelens {

/// Scalar c of voxel (i,j,k) is number first + i·step[0] + j·step[1] + k·step[2] + c·component_step of the
/// pieces' bytes, taken one after the other.
struct RawLayout {
  struct Piece {
    std::filesystem::path file;
    std::uintmax_t offset = 0; ///< in the file
    std::uintmax_t bytes = 0;
  };
  std::vector<Piece> pieces; ///< all of one size but the last; whole scalars
  std::uintmax_t first = 0;
  std::array<std::uintmax_t, 3> step{1, 1, 1};
  std::uintmax_t component_step = 1;
  bool swapped = false; ///< the other byte order than the machine's
};

/// A volume of which only the header has been read: no voxels, no statistics.
struct OpenedVolume {
  Volume volume;
  std::optional<RawLayout>
      layout; ///< nothing where the voxels are compressed, text or not where they should be
};

} // namespace slicelens
