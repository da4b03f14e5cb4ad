// Legacy VTK files (VTK file formats, "Simple Legacy Formats"): structured points only.
#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"
#include "volume/header_scan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

ScalarType type_of(const fs::path& path, const std::string& name) {
  static const std::map<std::string, ScalarType> types = {
      {"unsigned_char", ScalarType::u8},   {"char", ScalarType::i8},
      {"unsigned_short", ScalarType::u16}, {"short", ScalarType::i16},
      {"unsigned_int", ScalarType::u32},   {"int", ScalarType::i32},
      {"unsigned_long", ScalarType::u64},  {"long", ScalarType::i64},
      {"float", ScalarType::f32},          {"double", ScalarType::f64},
      {"vtktypeint64", ScalarType::i64},   {"vtktypeuint64", ScalarType::u64}};
  const auto found = types.find(lower(name));
  if (found == types.end())
    throw FileError(path.string(), "'SCALARS' has the type '" + one_line(name) +
                                       "', which is not supported; unsigned_char to double are");
  return found->second;
}

glm::dvec3 distances_of(const fs::path& path, const std::string& field, const std::string& rest) {
  const std::vector<double> values = numbers_of(path, field, rest);
  bool good = values.size() == 3;
  for (const double value : values)
    good = good && std::isfinite(value) && (field == "ORIGIN" || value > 0);
  if (!good)
    throw FileError(path.string(), "'" + field + " " + one_line(rest) + "' needs three finite numbers" +
                                       (field == "ORIGIN" ? "" : " above 0"));
  return {values[0], values[1], values[2]};
}

/// Where the next line begins; the whole text's length at its end.
std::uintmax_t offset_after(std::istringstream& in) {
  const std::streamoff at = in.tellg();
  return at >= 0 ? static_cast<std::uintmax_t>(at) : in.view().size();
}

} // namespace

HeaderScan scan_vtk(const fs::path& path, Volume& volume) {
  const std::uintmax_t file_bytes = require_file(path);
  std::istringstream in(head_of(path, 1 << 16));
  std::string line;
  std::getline(in, line);
  if (line.rfind("# vtk DataFile", 0) != 0)
    throw FileError(path.string(), "does not start with '# vtk DataFile'; it is no legacy VTK file");
  std::getline(in, line); // the title
  std::getline(in, line);
  const std::string format = lower(trimmed(line));
  if (format != "ascii" && format != "binary")
    throw FileError(path.string(), "the third line is '" + one_line(line) + "'; ASCII or BINARY is needed");

  std::vector<long long> sizes;
  while (std::getline(in, line)) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty())
      continue;
    const std::string word = lower(words[0]);
    const std::string rest = line.substr(line.find(words[0]) + words[0].size());
    if (word == "dataset" && (words.size() < 2 || lower(words[1]) != "structured_points"))
      throw FileError(path.string(), "'" + one_line(line) + "' is not supported; STRUCTURED_POINTS is");
    if (word == "dimensions")
      sizes = integers_of(path, "DIMENSIONS", rest);
    else if (word == "spacing" || word == "aspect_ratio")
      volume.spacing = distances_of(path, "SPACING", rest);
    else if (word == "origin")
      volume.origin = distances_of(path, "ORIGIN", rest);
    else if (word == "cell_data")
      throw FileError(path.string(), "holds cell data; write the values as point data");
    else if (word == "vectors" || word == "tensors" || word == "field" || word == "color_scalars" ||
             word == "normals")
      throw FileError(path.string(), "'" + one_line(line) + "' is not supported; SCALARS are");
    else if (word == "scalars") {
      if (sizes.size() != 3 || words.size() < 3)
        throw FileError(path.string(), "needs 'DIMENSIONS nx ny nz' before 'SCALARS name type'");
      volume.type = type_of(path, words[2]);
      const std::uintmax_t scalar = size_of(volume.type);
      std::vector<long long> all_sizes = sizes;
      if (words.size() > 3) {
        const auto components = integers_of(path, "SCALARS", words[3]);
        if (components[0] < 1 || components[0] > 4)
          throw FileError(path.string(), "'SCALARS' has " + words[3] + " components; 1 to 4 are supported");
        all_sizes.push_back(components[0]);
        volume.components = static_cast<int>(components[0]);
      }
      HeaderScan scan;
      scan.offset = offset_after(in);
      if (std::getline(in, line) && lower(line).rfind("lookup_table", 0) == 0)
        scan.offset = offset_after(in);
      scan.stored = file_bytes - std::min(file_bytes, scan.offset);
      scan.encoding = format == "ascii" ? Encoding::text : Encoding::raw;
      scan.big_endian = true; // always, in this format
      scan.claimed = claimed_bytes(path, "DIMENSIONS", all_sizes, scalar);
      check_claim(path, "DIMENSIONS", scan.claimed, scan.stored, scan.encoding, scalar);
      for (std::size_t axis = 0; axis < 3; ++axis)
        volume.dims[axis] = static_cast<std::size_t>(sizes[axis]);
      return scan;
    }
  }
  throw FileError(path.string(), "has no 'SCALARS'; a volume needs point data of one scalar kind");
}

} // namespace slicelens
