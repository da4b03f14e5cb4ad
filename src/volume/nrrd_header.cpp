// NRRD and NHDR headers (format definition: https://teem.sourceforge.net/nrrd/format.html).
#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"
#include "volume/header_scan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t header_limit = std::size_t{4} << 20;

struct NrrdHeader {
  std::map<std::string, std::string> fields; ///< lower-case name → text
  std::vector<std::string> listed_files;     ///< lines after `data file: LIST`
  std::size_t bytes = 0;                     ///< length of the header with its closing empty line
};

NrrdHeader parse(const fs::path& path) {
  std::istringstream in(head_of(path, header_limit));
  std::string line;
  std::getline(in, line);
  NrrdHeader header;
  bool closed = false;
  bool in_list = false;
  header.bytes = line.size() + 1;
  while (std::getline(in, line)) {
    header.bytes += line.size() + 1;
    line = trimmed(line);
    if (line.empty()) {
      closed = true;
      break;
    }
    if (in_list) {
      header.listed_files.push_back(line);
      continue;
    }
    const std::size_t colon = line.find(": ");
    const std::size_t key = line.find(":=");
    if (line[0] == '#' || (key != std::string::npos && key < colon))
      continue;
    if (colon == std::string::npos) {
      if (line.back() == ':')
        continue;
      throw FileError(path.string(),
                      "the header line '" + one_line(line) + "' is no 'field: value'; the header is damaged");
    }
    const std::string field = lower(trimmed(line.substr(0, colon)));
    header.fields[field] = trimmed(line.substr(colon + 2));
    in_list =
        (field == "data file" || field == "datafile") && lower(header.fields[field]).rfind("list", 0) == 0;
  }
  const bool detached = header.fields.count("data file") + header.fields.count("datafile") > 0;
  if (!closed && !detached)
    throw FileError(path.string(), "the header has no closing empty line; the file is truncated");
  return header;
}

std::optional<std::string> field_of(const NrrdHeader& header, const std::string& name,
                                    const std::string& synonym = "") {
  auto found = header.fields.find(name);
  if (found == header.fields.end() && !synonym.empty())
    found = header.fields.find(synonym);
  if (found == header.fields.end())
    return std::nullopt;
  return found->second;
}

std::string required_field(const fs::path& path, const NrrdHeader& header, const std::string& name) {
  const auto text = field_of(header, name);
  if (!text || text->empty())
    throw FileError(path.string(), "the header has no '" + name + "'; a NRRD volume needs it");
  return *text;
}

std::uintmax_t scalar_bytes_of(const fs::path& path, const std::string& type) {
  static const std::map<std::string, std::uintmax_t> sizes = {{"signed char", 1},
                                                              {"int8", 1},
                                                              {"int8_t", 1},
                                                              {"uchar", 1},
                                                              {"unsigned char", 1},
                                                              {"uint8", 1},
                                                              {"uint8_t", 1},
                                                              {"short", 2},
                                                              {"short int", 2},
                                                              {"signed short", 2},
                                                              {"signed short int", 2},
                                                              {"int16", 2},
                                                              {"int16_t", 2},
                                                              {"ushort", 2},
                                                              {"unsigned short", 2},
                                                              {"unsigned short int", 2},
                                                              {"uint16", 2},
                                                              {"uint16_t", 2},
                                                              {"int", 4},
                                                              {"signed int", 4},
                                                              {"int32", 4},
                                                              {"int32_t", 4},
                                                              {"uint", 4},
                                                              {"unsigned int", 4},
                                                              {"uint32", 4},
                                                              {"uint32_t", 4},
                                                              {"longlong", 8},
                                                              {"long long", 8},
                                                              {"long long int", 8},
                                                              {"signed long long", 8},
                                                              {"signed long long int", 8},
                                                              {"int64", 8},
                                                              {"int64_t", 8},
                                                              {"ulonglong", 8},
                                                              {"unsigned long long", 8},
                                                              {"unsigned long long int", 8},
                                                              {"uint64", 8},
                                                              {"uint64_t", 8},
                                                              {"float", 4},
                                                              {"double", 8}};
  const auto found = sizes.find(lower(type));
  if (found == sizes.end())
    throw FileError(path.string(), "'type: " + one_line(type) +
                                       "' is not supported; integers of 8 to 64 bits, float and double are");
  return found->second;
}

Encoding encoding_of(const fs::path& path, const std::string& name) {
  const std::string encoding = lower(name);
  if (encoding == "raw")
    return Encoding::raw;
  if (encoding == "gzip" || encoding == "gz")
    return Encoding::deflate;
  if (encoding == "ascii" || encoding == "text" || encoding == "txt")
    return Encoding::text;
  if (encoding == "hex")
    return Encoding::hex;
  throw FileError(path.string(),
                  "'encoding: " + one_line(name) + "' is not supported; write it again as raw or gzip");
}

std::vector<fs::path> data_files_of(const fs::path& path, const NrrdHeader& header) {
  const auto named = field_of(header, "data file", "datafile");
  if (!named)
    return {};
  std::vector<std::string> names = header.listed_files;
  const std::vector<std::string> words = words_of(*named);
  if (words.empty())
    throw FileError(path.string(), "'data file' is empty; name the file with the voxels");
  if (lower(words[0]) != "list") {
    // A pattern is followed by first, last, step and perhaps the slices' dimension; a plain name may hold
    // spaces.
    if (words[0].find('%') != std::string::npos && words.size() >= 4) {
      const auto range = integers_of(path, "data file", words[1] + " " + words[2] + " " + words[3]);
      names = numbered_names(path, words[0], range[0], range[1], range[2]);
    } else {
      names = {*named};
    }
  }
  std::vector<fs::path> files;
  for (const std::string& name : names) {
    const fs::path file = fs::path(name).is_absolute() ? fs::path(name) : path.parent_path() / name;
    std::error_code error;
    if (!fs::exists(file, error))
      throw FileError(path.string(),
                      "its data file '" + one_line(name) + "' is missing; put it beside the header");
    require_file(file);
    files.push_back(file);
  }
  if (files.empty())
    throw FileError(path.string(), "'data file: LIST' lists no files");
  return files;
}

/// Refuses what the axes say that a volume cannot be; tells whether the first axis is a list.
bool check_axes(const fs::path& path, const NrrdHeader& header, const std::vector<long long>& sizes) {
  const auto kinds_text = field_of(header, "kinds");
  const std::vector<std::string> kinds =
      kinds_text ? words_of(lower(*kinds_text)) : std::vector<std::string>();
  for (std::size_t axis = 0; axis < kinds.size(); ++axis) {
    if (kinds[axis] == "complex")
      throw FileError(path.string(), "'kinds' says complex numbers; write magnitude or one part as scalars");
    if (kinds[axis].find("matrix") != std::string::npos)
      throw FileError(path.string(),
                      "'kinds' says '" + kinds[axis] + "'; tensors are not supported, scalars are");
    if (kinds[axis] == "time" && axis + 1 != sizes.size())
      throw FileError(path.string(),
                      "'kinds' has time on axis " + std::to_string(axis) + "; time must be the last axis");
  }
  if (const auto spacings = field_of(header, "spacings")) {
    const std::vector<double> values = numbers_of(path, "spacings", *spacings);
    for (const double value : values) {
      // NaN is the format's word for "this axis has no spacing" (colour, time); refused later on an axis of
      // space, where it would be a guess.
      if (std::isinf(value) || value == 0)
        throw FileError(path.string(), "'spacings' holds " + number_text(value) +
                                           "; every spacing must be a finite number other than 0");
    }
    const auto is_space = [&](std::size_t axis) {
      if (axis < kinds.size())
        return kinds[axis] == "space" || kinds[axis] == "domain";
      return sizes.size() <= 3;
    };
    for (std::size_t axis = 0; axis < values.size(); ++axis) {
      if (std::isnan(values[axis]) && is_space(axis))
        throw FileError(path.string(), "'spacings' is nan on axis " + std::to_string(axis) +
                                           "; give the distance between its voxels");
    }
  }
  return !kinds.empty() && kinds[0] == "list";
}

} // namespace

HeaderScan scan_nrrd(const fs::path& path) {
  const std::uintmax_t file_bytes = require_file(path);
  const std::string magic = head_of(path, 8);
  if (magic.rfind("NRRD000", 0) != 0)
    throw FileError(path.string(), "does not start with 'NRRD000'; it is no NRRD file");
  const NrrdHeader header = parse(path);

  const auto dimension = integers_of(path, "dimension", required_field(path, header, "dimension"));
  const auto sizes = integers_of(path, "sizes", required_field(path, header, "sizes"));
  if (dimension.size() != 1 || dimension[0] < 1 || dimension[0] > 5)
    throw FileError(path.string(), "'dimension' is '" + one_line(*field_of(header, "dimension")) +
                                       "'; 1 to 5 are supported");
  if (sizes.size() != static_cast<std::size_t>(dimension[0]))
    throw FileError(path.string(), "'sizes' has " + std::to_string(sizes.size()) +
                                       " numbers but 'dimension' is " + std::to_string(dimension[0]));
  const std::uintmax_t scalar = scalar_bytes_of(path, required_field(path, header, "type"));
  const Encoding encoding = encoding_of(path, required_field(path, header, "encoding"));
  if (scalar > 1 && (encoding == Encoding::raw || encoding == Encoding::deflate) &&
      !field_of(header, "endian"))
    throw FileError(path.string(), "the header has no 'endian'; numbers of " + std::to_string(scalar) +
                                       " bytes need it (little or big)");
  HeaderScan scan;
  scan.frames_first = check_axes(path, header, sizes);
  scan.data_files = data_files_of(path, header);

  const std::uintmax_t claimed = claimed_bytes(path, "sizes", sizes, scalar);
  std::uintmax_t stored = 0;
  for (const fs::path& file : scan.data_files)
    stored += fs::file_size(file);
  if (scan.data_files.empty())
    stored = file_bytes - std::min<std::uintmax_t>(file_bytes, header.bytes);
  const auto skip_text = field_of(header, "byte skip", "byteskip");
  if (skip_text && encoding == Encoding::raw) {
    const auto skip = integers_of(path, "byte skip", *skip_text);
    if (skip.size() != 1 || skip[0] < -1)
      throw FileError(path.string(), "'byte skip: " + one_line(*skip_text) + "' must be -1 or more");
    const std::uintmax_t skipped = (skip[0] > 0 ? static_cast<std::uintmax_t>(skip[0]) : 0) *
                                   std::max<std::uintmax_t>(1, scan.data_files.size());
    stored -= std::min(stored, skipped);
  }
  check_claim(path, "sizes", claimed, stored, encoding, scalar);
  return scan;
}

} // namespace slicelens
