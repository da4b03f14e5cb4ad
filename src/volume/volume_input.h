// What volume.file turned out to name. Private to src/volume.
#pragma once

#include "volume/read.h"

#include <filesystem>
#include <vector>

namespace slicelens {

enum class InputFormat { nrrd, meta, nifti, vtk, vti, images, dicom, raw };

struct Input {
  InputFormat kind = InputFormat::raw;
  std::vector<std::filesystem::path>
      files;                   ///< one file, a stack in order, or the candidates for a DICOM series
  std::filesystem::path named; ///< DICOM: the one file that was named, empty for a folder or pattern
};

/// The format of one existing file: by its first bytes where the format has a mark, else by its name. Throws
/// FileError for a file of no known format.
InputFormat format_of(const VolumeSource& source, const std::filesystem::path& path);

/// Finds the files of a folder or pattern as well. Throws FileError where there are none, UsageError for an
/// empty name.
Input resolve(const VolumeSource& source);

// What of a source does not fit its file throws UsageError.

/// Keys that only headerless data take would be ignored elsewhere: say so instead.
void refuse_raw_keys(const VolumeSource& source);
void check_frame(const Volume& volume, const VolumeSource& source);
void check_component(const Volume& volume, int component);
/// Puts the spacing that the source gives in place of the file's.
void apply_spacing(Volume& volume, const VolumeSource& source);

} // namespace slicelens
