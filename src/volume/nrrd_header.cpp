#include "volume/nrrd_header.h"

#include "core/errors.h"
#include "core/text.h"
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
  if (encoding == "bzip2" || encoding == "bz2")
    return Encoding::bzip2;
  if (encoding == "ascii" || encoding == "text" || encoding == "txt")
    return Encoding::text;
  if (encoding == "hex")
    return Encoding::hex;
  throw FileError(path.string(),
                  "'encoding: " + one_line(name) + "' is not known; raw, gzip, bzip2, ascii and hex are");
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
  return existing_data_files(path, names, "'data file: LIST' lists no files");
}

long long skip_of(const fs::path& path, const NrrdHeader& header, const std::string& name,
                  const std::string& synonym, long long least) {
  const auto text = field_of(header, name, synonym);
  if (!text)
    return 0;
  const auto skip = integers_of(path, name, *text);
  if (skip.size() != 1 || skip[0] < least)
    throw FileError(path.string(),
                    "'" + name + ": " + one_line(*text) + "' must be " + std::to_string(least) + " or more");
  return skip[0];
}

} // namespace

std::vector<std::string> nrrd_vector_words(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '(') {
      const std::size_t close = std::min(text.find(')', at), text.size() - 1);
      words.push_back(text.substr(at, close + 1 - at));
      at = close + 1;
    } else if (text[at] == ' ' || text[at] == '\t') {
      ++at;
    } else {
      const std::size_t end = std::min(text.find_first_of(" \t(", at), text.size());
      words.push_back(text.substr(at, end - at));
      at = end;
    }
  }
  return words;
}

namespace {

NrrdHeader::Axis axis_of_kind(const fs::path& path, const std::string& kind) {
  using Axis = NrrdHeader::Axis;
  if (kind == "complex")
    throw FileError(path.string(), "'kinds' says complex numbers; write magnitude or one part as scalars");
  if (kind.find("matrix") != std::string::npos)
    throw FileError(path.string(), "'kinds' says '" + kind + "'; tensors are not supported, scalars are");
  if (kind == "space" || kind == "domain" || kind == "???" || kind == "none")
    return Axis::space;
  return kind == "time" || kind == "list" ? Axis::frame : Axis::component;
}

/// What each axis is, by its kind, else by having a direction, else by its place.
std::vector<NrrdHeader::Axis> axes_of(const fs::path& path, const NrrdHeader& header) {
  using Axis = NrrdHeader::Axis;
  std::vector<Axis> axes(header.sizes.size(), Axis::space);
  const auto kinds = field_of(header, "kinds");
  const auto directions = field_of(header, "space directions");
  if (kinds) {
    const auto words = words_of(lower(*kinds));
    if (words.size() != axes.size())
      throw FileError(path.string(), "'kinds' has " + std::to_string(words.size()) + " words for " +
                                         std::to_string(axes.size()) + " axes");
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
      axes[axis] = axis_of_kind(path, words[axis]);
  } else if (directions) {
    const auto words = nrrd_vector_words(*directions);
    const bool any = std::any_of(words.begin(), words.end(), [](const auto& w) { return w[0] == '('; });
    for (std::size_t axis = 0; any && axis < axes.size() && axis < words.size(); ++axis) {
      if (words[axis][0] != '(')
        axes[axis] = axis == 0 && header.sizes[0] <= 4 ? Axis::component : Axis::frame;
    }
  }
  if (axes.size() == 4 && std::count(axes.begin(), axes.end(), Axis::space) == 4)
    axes[3] = Axis::frame;
  const auto count = [&](Axis kind) { return std::count(axes.begin(), axes.end(), kind); };
  if (count(Axis::space) < 1 || count(Axis::space) > 3 || count(Axis::frame) > 1 ||
      count(Axis::component) > 1)
    throw FileError(path.string(), "has " + std::to_string(count(Axis::space)) + " axes of space, " +
                                       std::to_string(count(Axis::frame)) + " of time or lists and " +
                                       std::to_string(count(Axis::component)) +
                                       " of components; up to three, one and one are supported");
  for (std::size_t axis = 0; axis < axes.size(); ++axis) {
    if (axes[axis] == Axis::component && header.sizes[axis] > 4)
      throw FileError(path.string(),
                      "has " + std::to_string(header.sizes[axis]) + " components; 1 to 4 are supported");
  }
  return axes;
}

void check_spacings(const fs::path& path, const NrrdHeader& header) {
  const auto spacings = field_of(header, "spacings");
  if (!spacings)
    return;
  const std::vector<double> values = numbers_of(path, "spacings", *spacings);
  for (std::size_t axis = 0; axis < values.size() && axis < header.axes.size(); ++axis) {
    // NaN is the format's word for "this axis has no spacing": right for colour and time only.
    const bool space = header.axes[axis] == NrrdHeader::Axis::space;
    if (std::isinf(values[axis]) || values[axis] == 0 || (space && std::isnan(values[axis])))
      throw FileError(path.string(), "'spacings' is " + number_text(values[axis]) + " on axis " +
                                         std::to_string(axis) + "; a finite number other than 0 is needed");
  }
}

} // namespace

NrrdHeader parse_nrrd(const fs::path& path) {
  const std::uintmax_t file_bytes = require_file(path);
  if (head_of(path, 8).rfind("NRRD000", 0) != 0)
    throw FileError(path.string(), "does not start with 'NRRD000'; it is no NRRD file");
  NrrdHeader header = parse(path);
  const auto dimension = integers_of(path, "dimension", required_field(path, header, "dimension"));
  header.sizes = integers_of(path, "sizes", required_field(path, header, "sizes"));
  if (dimension.size() != 1 || dimension[0] < 1 || dimension[0] > 5)
    throw FileError(path.string(), "'dimension' is '" + one_line(*field_of(header, "dimension")) +
                                       "'; 1 to 5 are supported");
  if (header.sizes.size() != static_cast<std::size_t>(dimension[0]))
    throw FileError(path.string(), "'sizes' has " + std::to_string(header.sizes.size()) +
                                       " numbers but 'dimension' is " + std::to_string(dimension[0]));
  header.scalar_bytes = scalar_bytes_of(path, required_field(path, header, "type"));
  header.encoding = encoding_of(path, required_field(path, header, "encoding"));
  const bool binary = header.encoding != Encoding::text;
  if (header.scalar_bytes > 1 && binary) {
    const std::string endian = lower(field_of(header, "endian").value_or(""));
    if (endian != "little" && endian != "big")
      throw FileError(path.string(), "'endian' must be little or big for numbers of " +
                                         std::to_string(header.scalar_bytes) + " bytes");
  }
  const std::uintmax_t claimed = claimed_bytes(path, "sizes", header.sizes, header.scalar_bytes);
  header.axes = axes_of(path, header);
  check_spacings(path, header);
  header.line_skip = skip_of(path, header, "line skip", "lineskip", 0);
  header.byte_skip = skip_of(path, header, "byte skip", "byteskip", -1);
  header.data_files = data_files_of(path, header);

  std::uintmax_t stored = 0;
  for (const fs::path& file : header.data_files)
    stored += fs::file_size(file);
  if (header.data_files.empty())
    stored = file_bytes - std::min<std::uintmax_t>(file_bytes, header.bytes);
  if (header.encoding == Encoding::raw && header.byte_skip > 0) {
    const std::uintmax_t files = std::max<std::uintmax_t>(1, header.data_files.size());
    const auto skip = static_cast<std::uintmax_t>(header.byte_skip);
    stored = skip > stored / files ? 0 : stored - skip * files;
  }
  check_claim(path, "sizes", claimed, stored, header.encoding, header.scalar_bytes);
  if (header.encoding == Encoding::deflate && header.line_skip == 0) {
    // zlib passes what is not gzip through as it is: it would be taken for voxels.
    const fs::path& file = header.data_files.empty() ? path : header.data_files.front();
    const std::size_t start = header.data_files.empty() ? header.bytes : 0;
    const std::string mark =
        head_of(file, start + 2).substr(std::min<std::size_t>(start, fs::file_size(file)));
    if (mark != "\x1f\x8b")
      throw FileError(path.string(),
                      "'encoding: gzip' but the data are not; the header is wrong or the file damaged");
  }
  return header;
}

} // namespace slicelens
