// Writing volumes.
#pragma once

#include "volume/volume.h"

#include <filesystem>

namespace slicelens {

struct WriteOptions {
  bool compress = false; ///< gzip (NRRD) or zlib (MetaImage)
};

/// Writes `volume` with its spacing, origin, direction, scalar type and components: .nrrd, .nhdr (voxels
/// beside it in a .raw or .raw.gz), .mha, .mhd (voxels beside it in a .raw or .zraw). The files appear under
/// their names only when they are complete; of a pair the voxels come first, and an old pair is put back when
/// the header cannot be. Throws UsageError for another extension, FileError when a file cannot be written in
/// full (the old ones are then unharmed).
void write_volume(const Volume& volume, const std::filesystem::path& path, const WriteOptions& options = {});

} // namespace slicelens
