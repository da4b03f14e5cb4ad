// The pictures of a DICOM stack, one by one. Private to src/volume.
#pragma once

#include "core/progress.h"
#include "volume/dicom_series.h"
#include "volume/read.h"
#include "volume/streamed.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <vector>

namespace slicelens {

/// The smallest scalar type that holds all values of both.
ScalarType type_for_both(ScalarType a, ScalarType b);

std::vector<std::byte> converted(const std::vector<std::byte>& scalars, ScalarType from, ScalarType to);

/// Warnings that every slice repeats are passed on once, and those that say nothing to a user not at all.
Progress saying_once(const Progress& progress);

/// Reads one file's picture (or pictures), rescaled, after the check that it is what its header said.
Volume read_one(const DicomFile& slice, const Progress& progress);

/// Throws FileError unless the slice has as many components as `components`, those of the slices before it.
void require_components(const Volume& slice, int components, const std::filesystem::path& file);

/// The stack that `source` names among the files. Throws as read_volume.
DicomStack dicom_stack(const std::vector<std::filesystem::path>& candidates,
                       const std::filesystem::path& named, const VolumeSource& source,
                       const Progress& progress);

/// Dims on the third axis, frames and place of the volume whose first slice `volume` is.
void place_stack(Volume& volume, const DicomStack& stack);

/// Whether each slice is a file of its own, so that slices can be read when they are needed.
bool is_sliced(const DicomStack& stack);

/// The stack's volume without voxels. Its type is that of its first slice, of which it has as many
/// components.
Volume dicom_outline(const DicomStack& stack, const Progress& progress);

/// The type that holds the values of every slice: reads those whose values decide it.
ScalarType dicom_type(const DicomStack& stack, int components, const Progress& progress);

/// The voxels as `type`, a slice at a time, of which it keeps at most 128 MiB. One thread reads at a time.
std::unique_ptr<const VoxelStream> dicom_stream(const DicomStack& stack, ScalarType type);

} // namespace slicelens
