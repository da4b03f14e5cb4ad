// The voxels of a NRRD: its data files in turn, behind the lines and bytes that are skipped, decoded. Private
// to src/volume.
#pragma once

#include "core/progress.h"
#include "volume/nrrd_header.h"
#include "volume/raw_layout.h"
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

/// Where the `total` bytes of raw data lie. Warns as read_nrrd_data does of data that are longer, if what
/// is read reaches to their end (`to_end`); nothing where `total` is no multiple of the number of files.
/// Throws FileError when the data are shorter.
std::vector<RawLayout::Piece> nrrd_pieces(const std::filesystem::path& path, const NrrdHeader& header,
                                          std::size_t total, bool to_end, const Progress& progress);

/// Whether the scalars have the other byte order than the machine's.
bool is_swapped(const NrrdHeader& header);

} // namespace slicelens
