// Sorting DICOM files into series and slices. Private to src/volume.
#pragma once

#include "core/progress.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// What one file's header says (DICOM PS3.3, C.7.6.1 to C.7.6.3).
struct DicomFile {
  std::filesystem::path file;
  std::string series;      ///< Series Instance UID
  std::string description; ///< Series Description
  std::string instance;    ///< SOP Instance UID
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::size_t frames = 1;             ///< Number of Frames
  std::optional<glm::dvec3> position; ///< Image Position (Patient), mm, LPS
  std::optional<glm::dmat2x3> axes;   ///< Image Orientation (Patient): directions of columns' and rows' index
  double along = 0;                   ///< position along the slice normal, mm
  std::vector<glm::dvec3> frame_positions; ///< of an enhanced file's frames; empty when it has none for each
  std::optional<glm::dvec2> pixel_spacing; ///< of an enhanced file: between columns, between rows, mm
  std::size_t index = 0;  ///< which picture of the file, once its frames are slices of a stack
  long long temporal = 0; ///< Temporal Position Identifier
  long long acquisition = 0;
  long long number = 0; ///< Instance Number
  bool mosaic = false;  ///< Siemens mosaic: many slices in one picture
};

/// Reads one header and checks that the pixel data can hold what it claims. Throws FileError when it is no
/// DICOM image.
DicomFile scan_dicom(const std::filesystem::path& path);

/// A stack of slices: one frame of a series.
struct DicomStack {
  std::vector<DicomFile> slices;  ///< ascending along the normal
  bool one_file = false;          ///< slices are the pictures `index` of one enhanced file
  std::size_t frames = 1;         ///< how many stacks share these positions
  std::optional<double> spacing;  ///< from the positions; none for a single slice or without positions
  std::optional<glm::dvec3> axis; ///< unit world direction from slice to slice (the normal, unless sheared)
};

/// Chooses the series (see VolumeSource::series; that of `named` when it is not empty) and its `frame`, sorts
/// along the slice normal and checks that the slices form one regular grid. Deviations under 1 % of the
/// distance pass, under 10 % are warned of, larger ones are refused; so are slices of different size or
/// orientation. A shear (gantry tilt) is kept in `axis` and warned of. Throws FileError or UsageError.
DicomStack stack_of(std::vector<DicomFile> files, const std::filesystem::path& named,
                    const std::string& source, const std::string& series, std::size_t frame,
                    const Progress& progress);

} // namespace slicelens
