// JPEG slices through libjpeg: ITK's JPEG reader crashes on damaged files and takes truncated ones for whole.
// Private to src/volume.
#pragma once

#include "volume/volume.h"

#include <filesystem>

namespace slicelens {

/// Dims (depth 1), type (uint8) and components (1 grey, 3 RGB) of a JPEG, without voxels. Throws FileError
/// when it is damaged or of another colour model (CMYK).
Volume jpeg_header(const std::filesystem::path& path);

/// The samples, row by row from the top, voxel_bytes(jpeg_header(path)) bytes. Throws FileError when it is
/// damaged or truncated.
void read_jpeg(const std::filesystem::path& path, std::byte* out);

} // namespace slicelens
