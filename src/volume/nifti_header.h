// NIfTI-1, NIfTI-2 and Analyze 7.5 headers (nifti1.h and nifti2.h of the NIfTI Data Format Working Group).
// Private to src/volume.
#pragma once

#include "volume/volume.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace slicelens {

struct NiftiHeader {
  std::filesystem::path data_file; ///< the file itself for .nii, the .img of a pair
  bool pair = false;               ///< .hdr and .img
  int version = 1;                 ///< 0 Analyze 7.5, 1, 2
  bool swapped = false;            ///< the other byte order than the machine's
  std::array<long long, 7> dims{1, 1, 1, 1, 1, 1, 1};
  ScalarType stored_type = ScalarType::u8; ///< type of one component in the file
  int components_in_voxel = 1;             ///< 3 for RGB24, 4 for RGBA32
  std::uintmax_t data_offset = 0;
  double slope = 1;     ///< value = slope · stored + intercept
  double intercept = 0; ///< 0 with slope 1: stored values are the values
  int intent = 0;       ///< nifti1.h's code
  bool sheared = false; ///< the axes that `affine` gives are not perpendicular
  glm::dmat4 affine{1}; ///< LPS world, in mm, from voxel index (sform, else qform, else voxel sizes)
};

/// Parses and checks a header (gzip'd or not; the .img of a pair stands for its .hdr). Throws FileError when
/// it is damaged, claims more than its data file can hold, or holds what a Volume cannot be (complex numbers,
/// 128-bit floats, bits).
NiftiHeader scan_nifti(const std::filesystem::path& path);

/// The header of a pair for its .hdr or .img, any other path as it is.
std::filesystem::path nifti_header_file(const std::filesystem::path& path);

} // namespace slicelens
