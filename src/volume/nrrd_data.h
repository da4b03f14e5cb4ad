// The voxels of a NRRD: its data files in turn, behind the lines and bytes that are skipped, decoded. Private
// to src/volume.
#pragma once

#include "core/progress.h"
#include "volume/nrrd_header.h"
#include "volume/volume.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace slicelens {

/// A part of the decoded voxels, in bytes: all frames for those that are stored apart, one frame for the
/// rest.
struct NrrdPart {
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t total = 0; ///< bytes of all voxels that the header claims
};

/// The bytes of `part` in the machine's byte order. `type` is that of one scalar. Of gzip data whose end is
/// reached the checksum is compared. Says in `progress.warn` when the data are longer than the header claims.
/// Throws FileError when they are shorter, damaged, or text that holds no numbers.
std::vector<std::byte> read_nrrd_data(const std::filesystem::path& path, const NrrdHeader& header,
                                      ScalarType type, const NrrdPart& part, const Progress& progress);

} // namespace slicelens
