// What a look at a volume's header says before a library reads it: which files hold the voxels, and that
// those files can hold what the header claims. The libraries allocate what a header says, so this look comes
// first. Private to src/volume.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace slicelens {

struct HeaderScan {
  std::vector<std::filesystem::path> data_files; ///< detached data in reading order; empty when attached
};

/// Each throws FileError when the header is not one of its format, a needed field is missing or wrong, the
/// kind of data is not supported, a data file is missing, or the claim does not fit the files.
HeaderScan scan_nrrd(const std::filesystem::path& path);
HeaderScan scan_meta(const std::filesystem::path& path);
HeaderScan scan_vtk(const std::filesystem::path& path);

} // namespace slicelens
