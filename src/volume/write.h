// Writing volumes.
#pragma once

#include "core/progress.h"
#include "volume/volume.h"

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

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

/// Fills `out` with whole rows of voxels, from row `first` on: row j + ny·k holds the voxels (0…nx−1, j, k).
/// Of the volume's type, in the machine's byte order.
using RowSource = std::function<void(std::size_t first, std::span<std::byte> out)>;

/// write_volume, uncompressed, for a volume that need not fit in memory: `volume` says everything but the
/// voxels, and `rows` is asked for them in order, at most 32 MiB (or one row) at a time. The same bytes as
/// from write_volume. Before it starts the disk is asked for room: FileError where there is not enough.
void write_rows(const Volume& volume, const RowSource& rows, const std::filesystem::path& path,
                const Progress& progress = {});

} // namespace slicelens
