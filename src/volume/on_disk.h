// Volumes whose voxels are left in their files.
#pragma once

#include "core/progress.h"
#include "volume/read.h"
#include "volume/streamed.h"

#include <filesystem>
#include <optional>

namespace slicelens {

/// What the headers say of a volume: all but voxels and statistics, and all its components.
struct VolumeOutline {
  Volume volume;
  bool streams = false; ///< whether stream_volume leaves its voxels in the files
};

/// Nothing for formats whose headers are not read apart from their voxels (VTI, images). The type of DICOM is
/// that of the first slice. Throws as read_volume.
std::optional<VolumeOutline> outline_of(const VolumeSource& source, const Progress& progress = {});

/// Whether what was found out about all voxels is kept for the next call.
enum class ScanKeeping { keep, drop };

/// read_volume without holding the voxels: raw files, NRRD and MetaImage with raw voxels in one file or
/// several, of one component or with the one that source.component names, and DICOM of one component whose
/// slices are files of their own. Nothing for other volumes. Reads all of them once, a few MiB at a time, for
/// what is to be known of them as a whole; keeps that in the user's cache folder ($XDG_CACHE_HOME/slicelens
/// or ~/.cache/slicelens), where the next call finds it as long as the files have the same size and time,
/// unless `keeping` says otherwise.
///
/// Throws as read_volume, but for volumes larger than the memory; what the stream's reads throw.
std::optional<Volume> stream_volume(const VolumeSource& source, const Progress& progress = {},
                                    ScanKeeping keeping = ScanKeeping::keep);

/// Where a copy of a volume in bricks is, and what it must hold.
struct CacheRequest {
  std::optional<std::filesystem::path> file; ///< none: in the user's cache folder, named after the contents
  std::size_t levels = 1; ///< of the pyramid (volume/pyramid.h), the volume's own with them
};

/// read_volume by way of a copy of the voxels in bricks, which is made where there is none; one with fewer
/// levels is made again. Raw voxels are copied without being held in memory, those of other formats are read
/// once. `known`, where it is given, is the volume as read before. Volumes of several components are read and
/// not copied. docs/bricks.md describes the copy.
///
/// Throws as read_volume and FileError where the copy cannot be written, or `request.file` is none of this
/// volume as it is now: it is not overwritten then. A copy in the user's folder that is damaged is made
/// again, with a warning.
Volume cached_volume(const VolumeSource& source, const CacheRequest& request, const Progress& progress = {},
                     std::optional<Volume> known = std::nullopt);

/// The copy that cached_volume would take, where it is there already and holds enough levels.
std::optional<Volume> cached_already(const VolumeSource& source, const CacheRequest& request,
                                     const Progress& progress = {});

} // namespace slicelens
