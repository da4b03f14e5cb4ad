// What a look at a volume's header says before a library reads it: which files hold the voxels, how, and that
// those files can hold what the header claims. The libraries allocate what a header says, so this look comes
// first. Private to src/volume.
#pragma once

#include "core/progress.h"
#include "volume/file_checks.h"
#include "volume/volume.h"

#include <cstdint>
#include <filesystem>
#include <vector>

namespace slicelens {

struct HeaderScan {
  std::vector<std::filesystem::path> data_files; ///< detached data in reading order; empty when attached
  Encoding encoding = Encoding::raw;
  std::uintmax_t offset = 0; ///< of the voxels in the (first) data file
  std::uintmax_t stored = 0; ///< bytes that they take there
  bool big_endian = false;
  std::uintmax_t claimed = 0; ///< bytes that they are once decoded, all frames
  /// MetaImage, raw: bytes that each file holds of them, 0 where the files do not share them evenly.
  std::uintmax_t in_each_file = 0;
  long long header_size = 0; ///< MetaImage's HeaderSize: -1 for data at the end of each file
};

/// Each throws FileError when the header is not one of its format, a needed field is missing or wrong, the
/// kind of data is not supported, a data file is missing, or the claim does not fit the files.
HeaderScan scan_meta(const std::filesystem::path& path);
/// Sets the volume's dims, spacing, origin, type and components as well.
HeaderScan scan_vtk(const std::filesystem::path& path, Volume& volume);

/// Fills volume.voxels (sized) from the one file that `scan` names (`path` itself when the data are
/// attached): raw, zlib or gzip, or text, in full and with checksums verified, which MetaIO and ITK's VTK
/// reader do not do. Throws FileError when the data are short or damaged.
void read_voxels(const std::filesystem::path& path, const HeaderScan& scan, Volume& volume);

} // namespace slicelens
