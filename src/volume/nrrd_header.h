// NRRD and NHDR headers (format definition: https://teem.sourceforge.net/nrrd/format.html). Private to
// src/volume.
#pragma once

#include "volume/file_checks.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace slicelens {

struct NrrdHeader {
  std::map<std::string, std::string> fields; ///< lower-case name → text
  std::vector<std::string> listed_files;     ///< lines after `data file: LIST`
  std::size_t bytes = 0;                     ///< length of the header with its closing empty line

  // What the fields mean, set by parse_nrrd:
  std::vector<std::filesystem::path> data_files; ///< empty when the voxels follow the header
  std::vector<long long> sizes;
  std::uintmax_t scalar_bytes = 1;
  Encoding encoding = Encoding::raw;
  long long line_skip = 0;
  long long byte_skip = 0; ///< -1: the data are the end of the file

  /// What each axis is.
  enum class Axis { component, space, frame };
  std::vector<Axis> axes;
};

/// Parses and checks a header, whether its data files are there and whether they can hold what it claims.
/// Throws FileError.
NrrdHeader parse_nrrd(const std::filesystem::path& path);

/// The words of `space directions` and the like: "(1,0,0)" or "none". Blanks inside the brackets are allowed.
std::vector<std::string> nrrd_vector_words(const std::string& text);

} // namespace slicelens
