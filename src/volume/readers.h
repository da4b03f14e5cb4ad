// The readers behind read_volume, one per family of formats. Private to src/volume. Each gives a Volume with
// all components and without statistics; errors as read_volume's.
#pragma once

#include "core/progress.h"
#include "volume/raw_layout.h"
#include "volume/read.h"

#include <filesystem>
#include <span>
#include <vector>

namespace slicelens {

Volume read_nrrd(const std::filesystem::path& path, std::size_t frame, const Progress& progress);
Volume read_meta(const std::filesystem::path& path, std::size_t frame, const Progress& progress);
Volume read_vtk(const std::filesystem::path& path, std::size_t frame, const Progress& progress);
Volume read_nifti(const std::filesystem::path& path, std::size_t frame, const Progress& progress);
/// NIfTI without ITK: sheared axes are kept as they are in `direction`.
Volume read_nifti_directly(const std::filesystem::path& path, std::size_t frame, const Progress& progress);
Volume read_vti(const std::filesystem::path& path, const Progress& progress);
Volume read_raw(const VolumeSource& source, const Progress& progress);

/// "PNG", "TIFF", "JPEG" or "" by the file's first bytes.
std::string image_kind(const std::filesystem::path& path);
/// A stack of images of one size and type in the given order; one multi-page TIFF is a stack too.
Volume read_images(const std::vector<std::filesystem::path>& files, const Progress& progress);

/// True when `path` has DICOM's mark, or is read as DICOM without it by its extension (.dcm, .ima, none).
bool is_dicom(const std::filesystem::path& path);
/// The chosen series' files of one frame, sorted along the slice normal. `named` is the file the user gave
/// (its series is then taken), empty for a folder or pattern.
std::vector<std::filesystem::path> dicom_files(const std::vector<std::filesystem::path>& candidates,
                                               const std::filesystem::path& named, const VolumeSource& source,
                                               const Progress& progress);
Volume read_dicom(const std::vector<std::filesystem::path>& candidates, const std::filesystem::path& named,
                  const VolumeSource& source, const Progress& progress);

/// The headers alone: the volume without voxels, and where these are. Errors and warnings as the readers'.
OpenedVolume open_nrrd(const std::filesystem::path& path, std::size_t frame, const Progress& progress);
OpenedVolume open_meta(const std::filesystem::path& path, std::size_t frame, const Progress& progress);
OpenedVolume open_raw(const VolumeSource& source);

/// Reverses the bytes of every scalar of `size` bytes.
void swap_bytes(std::span<std::byte> scalars, std::size_t size);

} // namespace slicelens
