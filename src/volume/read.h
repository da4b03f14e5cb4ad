// Reading volumes of every format that Slicelens knows.
#pragma once

#include "core/progress.h"
#include "volume/volume.h"

#include <glm/glm.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// Which volume to read: the keys `volume.file`, `size`, `type`, `spacing`, `endian`, `component`, `frame`
/// and `series` of a scene (docs/scenes.md).
struct VolumeSource {
  /// A volume file; any file of a DICOM series; a folder with one image stack or with DICOM files; or a
  /// pattern of files in one folder, as printf writes numbers (`slice%03d.png`) or as a shell does
  /// (`slice*.png`).
  std::filesystem::path file;
  std::optional<std::array<std::size_t, 3>> size; ///< headerless raw only; else from the file's name
  std::optional<ScalarType> type;                 ///< headerless raw only; else from the file's name
  std::optional<glm::dvec3> spacing;              ///< world units, > 0; replaces what the file says
  std::optional<bool> big_endian;                 ///< headerless raw only; default little endian
  std::optional<int> component;                   ///< keep this component only, from 0
  std::size_t frame = 0;                          ///< which frame of a 4D file, from 0
  std::string series; ///< DICOM: the series instance UID, or a part of it or of the description that only one
                      ///< series in the folder has
};

/// Reads one frame of a volume with its place in the world and its statistics. Values are what the file
/// means: scl_slope (NIfTI) and rescale slope and intercept (DICOM) are applied. All 1 to 4 components are
/// kept unless `component` names one.
///
/// `format` is "NRRD", "MetaImage", "NIfTI" (RAS becomes LPS), "DICOM", "VTK", "VTI", "PNG stack", "TIFF
/// stack", "JPEG stack" or "raw"; docs/volumes.md says what of each is read.
///
/// Throws FileError for a file that is damaged, truncated, unsupported or whose header claims more than its
/// files can hold (before anything of the claimed size is allocated), UsageError for a `frame`, `component`,
/// `series` or raw key that does not fit the file, LimitError for more than the machine's memory. Warnings
/// (of ITK and GDCM too) go to `progress.warn`.
Volume read_volume(const VolumeSource& source, const Progress& progress = {});

/// The files that make up the volume, in reading order: the header and then its data files, a DICOM series in
/// sorted order, a stack in natural order. Throws as read_volume does.
std::vector<std::filesystem::path> files_of(const VolumeSource& source);

/// Whether the file is NIfTI of intent 1006 (NIFTI_INTENT_DISPVECT), whose vectors are along R, A and S.
/// Those of other files are along L, P and S where ITK wrote them, in NIfTI of intent 1007 as well. Throws as
/// read_volume.
bool has_ras_displacements(const std::filesystem::path& file);

/// SHA-256 in lower-case hexadecimal: of the file's bytes for one file; for several the SHA-256 of their
/// binary digests concatenated in the given order, so that names and folders do not matter but the order
/// does. Throws FileError when a file cannot be read.
std::string sha256_of(const std::vector<std::filesystem::path>& files);

/// The same of the bytes of a text.
std::string sha256_of_text(const std::string& text);

} // namespace slicelens
