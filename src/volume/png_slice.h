// PNG slices through libpng: ITK's PNG reader ends the program on a damaged file (libpng's default error
// handler aborts). Private to src/volume.
#pragma once

#include "volume/volume.h"

#include <filesystem>

namespace slicelens {

/// Dims (depth 1), type (uint8 or uint16) and components (1 grey to 4 RGBA; palettes become RGB or RGBA, 1 to
/// 4 bit greys 8 bit) of a PNG, without voxels. Throws FileError when it is damaged.
Volume png_header(const std::filesystem::path& path);

/// The samples, row by row from the top, voxel_bytes(png_header(path)) bytes. Throws FileError when it is
/// damaged or truncated.
void read_png(const std::filesystem::path& path, std::byte* out);

} // namespace slicelens
