// MetaImage headers (.mha with the voxels attached, .mhd beside them).
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

constexpr std::size_t header_limit = std::size_t{1} << 20;

struct MetaHeader {
  std::map<std::string, std::string> fields; ///< lower-case name → text
  std::vector<std::string> listed_files;     ///< lines after `ElementDataFile = LIST`
  std::size_t bytes = 0;                     ///< length up to and with the line of ElementDataFile
};

MetaHeader parse(const fs::path& path) {
  std::istringstream in(head_of(path, header_limit));
  MetaHeader header;
  bool in_list = false;
  for (std::string line; std::getline(in, line);) {
    if (in_list) {
      if (!trimmed(line).empty())
        header.listed_files.push_back(trimmed(line));
      continue;
    }
    header.bytes += line.size() + 1;
    std::size_t equals = line.find('=');
    if (equals == std::string::npos)
      equals = line.find(':');
    if (equals == std::string::npos) {
      if (trimmed(line).empty())
        continue;
      throw FileError(path.string(), "the header line '" + one_line(line) +
                                         "' is no 'Field = value'; it is no MetaImage or damaged");
    }
    const std::string field = lower(trimmed(line.substr(0, equals)));
    header.fields[field] = trimmed(line.substr(equals + 1));
    if (field == "elementdatafile") {
      if (lower(header.fields[field]).rfind("list", 0) != 0)
        return header;
      in_list = true;
    }
  }
  if (!in_list)
    throw FileError(path.string(), "the header has no 'ElementDataFile'; it is no MetaImage or truncated");
  return header;
}

std::optional<std::string> field_of(const MetaHeader& header, const std::string& name) {
  const auto found = header.fields.find(lower(name));
  if (found == header.fields.end())
    return std::nullopt;
  return found->second;
}

std::uintmax_t scalar_bytes_of(const fs::path& path, const std::string& type) {
  // MetaIO counts MET_LONG as 4 bytes, as its format defines it on every machine.
  static const std::map<std::string, std::uintmax_t> sizes = {
      {"MET_CHAR", 1},      {"MET_UCHAR", 1},      {"MET_SHORT", 2}, {"MET_USHORT", 2},
      {"MET_INT", 4},       {"MET_UINT", 4},       {"MET_LONG", 4},  {"MET_ULONG", 4},
      {"MET_LONG_LONG", 8}, {"MET_ULONG_LONG", 8}, {"MET_FLOAT", 4}, {"MET_DOUBLE", 8}};
  const std::string plain =
      type.size() > 6 && type.rfind("_ARRAY") == type.size() - 6 ? type.substr(0, type.size() - 6) : type;
  const auto found = sizes.find(plain);
  if (found == sizes.end())
    throw FileError(path.string(),
                    "'ElementType = " + one_line(type) + "' is not supported; MET_UCHAR to MET_DOUBLE are");
  return found->second;
}

bool is_true(const std::optional<std::string>& text) {
  return text && !text->empty() && ((*text)[0] == 'T' || (*text)[0] == 't' || (*text)[0] == '1');
}

std::vector<fs::path> data_files_of(const fs::path& path, const MetaHeader& header) {
  const std::string named = *field_of(header, "ElementDataFile");
  if (named.empty())
    throw FileError(path.string(), "'ElementDataFile' is empty; name the file with the voxels or LOCAL");
  if (lower(named) == "local")
    return {};
  std::vector<std::string> names = header.listed_files;
  if (lower(named).rfind("list", 0) != 0) {
    const std::vector<std::string> words = words_of(named);
    if (words[0].find('%') != std::string::npos && words.size() >= 4) {
      const auto range = integers_of(path, "ElementDataFile", words[1] + " " + words[2] + " " + words[3]);
      names = numbered_names(path, words[0], range[0], range[1], range[2]);
    } else {
      names = {named};
    }
  }
  return existing_data_files(path, names, "'ElementDataFile = LIST' lists no files");
}

/// Numbers that place the volume must be finite, and distances positive: MetaIO would take what it finds.
void check_geometry(const fs::path& path, const MetaHeader& header, std::size_t dimensions) {
  for (const char* name : {"ElementSpacing", "ElementSize", "Offset", "Position", "Origin", "TransformMatrix",
                           "Rotation", "Orientation"}) {
    const auto text = field_of(header, name);
    if (!text)
      continue;
    const std::vector<double> values = numbers_of(path, name, *text);
    const bool distance = std::string(name) == "ElementSpacing" || std::string(name) == "ElementSize";
    const bool matrix = std::string(name) == "TransformMatrix" || std::string(name) == "Rotation" ||
                        std::string(name) == "Orientation";
    if (values.size() < (matrix ? dimensions * dimensions : dimensions))
      throw FileError(path.string(), "'" + std::string(name) + "' has " + std::to_string(values.size()) +
                                         " numbers, which does not fit 'NDims'");
    for (const double value : values) {
      if (!std::isfinite(value) || (distance && value <= 0))
        throw FileError(path.string(), "'" + std::string(name) + "' holds " + number_text(value) + "; " +
                                           (distance ? "finite numbers above 0 are" : "finite numbers are") +
                                           " needed");
    }
  }
}

} // namespace

namespace {

/// Bytes of `claimed` in each data file, when there are as many as the axes beyond a file's make: all but the
/// last axis, or as many as `LIST 2` says. 0 otherwise.
std::uintmax_t share_of_files(const MetaHeader& header, const std::vector<long long>& sizes,
                              const HeaderScan& scan) {
  const std::vector<std::string> words = words_of(lower(field_of(header, "ElementDataFile").value_or("")));
  if (scan.data_files.empty() || words.empty())
    return scan.claimed;
  std::size_t inside = sizes.size() - 1; // axes of one file
  if (words[0] == "list" && words.size() == 2 && words[1].size() == 1)
    inside = static_cast<std::size_t>(words[1][0] - '0');
  else if (words[0] != "list" && words[0].find('%') == std::string::npos)
    inside = sizes.size();
  else if (words[0] == "list" ? words.size() != 1 : words.size() != 4)
    return 0;
  if (inside < 1 || inside > sizes.size())
    return 0;
  std::uintmax_t files = 1;
  for (std::size_t axis = inside; axis < sizes.size(); ++axis)
    files *= static_cast<std::uintmax_t>(sizes[axis]); // less than `claimed`, which did not overflow
  return files == scan.data_files.size() ? scan.claimed / files : 0;
}

} // namespace

HeaderScan scan_meta(const fs::path& path) {
  const std::uintmax_t file_bytes = require_file(path);
  const MetaHeader header = parse(path);
  const auto type = field_of(header, "ElementType");
  const auto dimensions = field_of(header, "NDims");
  const auto dim_size = field_of(header, "DimSize");
  if (!type || !dimensions || !dim_size)
    throw FileError(path.string(), "the header needs 'NDims', 'DimSize' and 'ElementType'");
  const auto sizes = integers_of(path, "DimSize", *dim_size);
  const auto count = integers_of(path, "NDims", *dimensions);
  if (count.size() != 1 || count[0] < 1 || count[0] > 4)
    throw FileError(path.string(), "'NDims = " + one_line(*dimensions) + "' is not supported; 1 to 4 are");
  if (sizes.size() != static_cast<std::size_t>(count[0]))
    throw FileError(path.string(), "'DimSize' has " + std::to_string(sizes.size()) +
                                       " numbers but 'NDims' is " + std::to_string(count[0]));
  check_geometry(path, header, sizes.size());
  const std::uintmax_t scalar = scalar_bytes_of(path, *type);
  std::vector<long long> all_sizes = sizes;
  if (const auto channels = field_of(header, "ElementNumberOfChannels")) {
    const auto value = integers_of(path, "ElementNumberOfChannels", *channels);
    if (value.size() != 1 || value[0] < 1 || value[0] > 4)
      throw FileError(path.string(),
                      "'ElementNumberOfChannels = " + one_line(*channels) + "' is not supported; 1 to 4 are");
    all_sizes.push_back(value[0]);
  }

  HeaderScan scan;
  scan.data_files = data_files_of(path, header);
  scan.offset = scan.data_files.empty() ? header.bytes : 0;
  scan.big_endian =
      is_true(field_of(header, "BinaryDataByteOrderMSB")) || is_true(field_of(header, "ElementByteOrderMSB"));
  std::uintmax_t stored = 0;
  for (const fs::path& file : scan.data_files)
    stored += fs::file_size(file);
  if (scan.data_files.empty())
    stored = file_bytes - std::min<std::uintmax_t>(file_bytes, header.bytes);

  Encoding encoding = Encoding::raw;
  if (is_true(field_of(header, "CompressedData"))) {
    encoding = Encoding::deflate;
    if (const auto text = field_of(header, "CompressedDataSize")) {
      const auto bytes = integers_of(path, "CompressedDataSize", *text);
      if (bytes.size() != 1 || bytes[0] < 1 || static_cast<std::uintmax_t>(bytes[0]) > stored)
        throw FileError(path.string(), "'CompressedDataSize = " + one_line(*text) + "' but the data are " +
                                           std::to_string(stored) + " bytes; the file is truncated");
      // The size is not used: files exist that give too small a one; the compressed stream knows its end.
    }
  } else if (const auto binary = field_of(header, "BinaryData"); binary && !is_true(binary)) {
    encoding = Encoding::text;
  }
  const auto skip_text = field_of(header, "HeaderSize");
  if (skip_text && encoding == Encoding::raw) {
    const auto skip = integers_of(path, "HeaderSize", *skip_text);
    if (skip.size() != 1 || skip[0] < -1)
      throw FileError(path.string(), "'HeaderSize = " + one_line(*skip_text) + "' must be -1 or more");
    scan.header_size = skip[0];
    const std::uintmax_t skipped = (skip[0] > 0 ? static_cast<std::uintmax_t>(skip[0]) : 0) *
                                   std::max<std::uintmax_t>(1, scan.data_files.size());
    stored -= std::min(stored, skipped);
  }
  scan.claimed = claimed_bytes(path, "DimSize", all_sizes, scalar);
  check_claim(path, "DimSize", scan.claimed, stored, encoding, scalar);
  scan.encoding = encoding;
  scan.in_each_file = encoding == Encoding::raw ? share_of_files(header, sizes, scan) : 0;
  scan.stored = stored;
  if (encoding != Encoding::raw && scan.data_files.size() > 1)
    throw FileError(path.string(),
                    "has several data files that are compressed or text; raw ones are supported");
  return scan;
}

} // namespace slicelens
