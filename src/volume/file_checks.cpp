#include "volume/file_checks.h"

#include "core/errors.h"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>
#include <regex>
#include <sstream>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// Most bytes that one stored byte can become. For codecs the worst are long runs of one value (TIFF's G4,
/// JPEG-LS, JPEG 2000); the bound only has to keep a few bytes from claiming gigabytes.
std::uintmax_t expansion_of(Encoding encoding) {
  switch (encoding) {
  case Encoding::deflate:
    return 1032;
  case Encoding::bzip2:
    return 1 << 20;
  case Encoding::codec:
    return 16384;
  case Encoding::raw:
  case Encoding::text:
  case Encoding::hex:
    break;
  }
  return 1;
}

} // namespace

std::uintmax_t require_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    throw FileError(path.string(), "no such file; check the path");
  if (status.type() == fs::file_type::none)
    throw FileError(path.string(), "cannot be opened: " + error.message());
  if (status.type() == fs::file_type::directory)
    throw FileError(path.string(), "is a folder; a file is needed here");
  if (status.type() != fs::file_type::regular)
    throw FileError(path.string(), "is not a regular file (a pipe, socket or device); give a file on disk");
  if (::access(path.c_str(), R_OK) != 0)
    throw FileError(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
  const std::uintmax_t size = fs::file_size(path, error);
  if (error)
    throw FileError(path.string(), "cannot be opened: " + error.message());
  if (size == 0)
    throw FileError(path.string(), "is empty; a volume file is needed here");
  return size;
}

std::uintmax_t claimed_bytes(const fs::path& path, const std::string& field,
                             const std::vector<long long>& sizes, std::uintmax_t unit) {
  std::uintmax_t product = unit;
  for (const long long size : sizes) {
    if (size <= 0)
      throw FileError(path.string(),
                      "'" + field + "' holds " + std::to_string(size) + "; every size must be at least 1");
    if (product > static_cast<std::uintmax_t>(std::numeric_limits<std::int64_t>::max()) /
                      static_cast<std::uintmax_t>(size))
      throw FileError(path.string(),
                      "'" + field + "' claims more bytes than any file can hold; the header is damaged");
    product *= static_cast<std::uintmax_t>(size);
  }
  return product;
}

void check_claim(const fs::path& path, const std::string& field, std::uintmax_t claimed,
                 std::uintmax_t stored, Encoding encoding, std::uintmax_t scalar_bytes) {
  std::uintmax_t most = stored;
  if (encoding == Encoding::text)
    most = (stored + 1) / 2 * scalar_bytes;
  else if (encoding == Encoding::hex)
    most = stored / 2;
  else
    most = stored > std::numeric_limits<std::uintmax_t>::max() / expansion_of(encoding)
               ? std::numeric_limits<std::uintmax_t>::max()
               : stored * expansion_of(encoding);
  if (claimed <= most)
    return;
  const bool packed =
      encoding == Encoding::deflate || encoding == Encoding::bzip2 || encoding == Encoding::codec;
  throw FileError(path.string(), "'" + field + "' claims " + std::to_string(claimed) +
                                     " bytes of voxels but the data are " + std::to_string(stored) +
                                     (packed ? " compressed bytes, which cannot hold them" : " bytes") +
                                     "; the file is truncated or its header wrong");
}

void check_memory(const fs::path& path, std::uintmax_t bytes) {
  const long pages = ::sysconf(_SC_PHYS_PAGES);
  const long page = ::sysconf(_SC_PAGE_SIZE);
  if (pages <= 0 || page <= 0)
    return;
  const std::uintmax_t memory = static_cast<std::uintmax_t>(pages) * static_cast<std::uintmax_t>(page);
  if (bytes > memory)
    throw LimitError(path.string() + ": holds " + std::to_string(bytes) + " bytes of voxels, more than the " +
                     std::to_string(memory) +
                     " bytes of memory of this machine; crop or downsample it first");
}

std::string trimmed(const std::string& text) {
  const char* const white = " \t\r\n\f\v";
  const std::size_t first = text.find_first_not_of(white);
  if (first == std::string::npos)
    return {};
  return text.substr(first, text.find_last_not_of(white) - first + 1);
}

std::string one_line(const std::string& text) {
  std::istringstream in(text);
  std::string line;
  while (std::getline(in, line) && trimmed(line).empty())
    continue;
  line = trimmed(line);
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 32 || c == 127)
      c = ' ';
  }
  return line.size() > 200 ? line.substr(0, 197) + "..." : line;
}

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;)
    words.push_back(word);
  return words;
}

std::vector<long long> integers_of(const fs::path& path, const std::string& field, const std::string& text) {
  std::vector<long long> numbers;
  for (const std::string& word : words_of(text)) {
    long long value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, status] = std::from_chars(word.data(), end, value);
    if (status != std::errc() || stop != end)
      throw FileError(path.string(), "'" + field + "' holds '" + one_line(word) + "'; an integer is needed");
    numbers.push_back(value);
  }
  return numbers;
}

std::vector<double> numbers_of(const fs::path& path, const std::string& field, const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : words_of(text)) {
    double value = 0;
    const char* begin = word.data() + (word[0] == '+' ? 1 : 0);
    const char* const end = word.data() + word.size();
    const auto [stop, status] = std::from_chars(begin, end, value);
    if ((status != std::errc() && status != std::errc::result_out_of_range) || stop != end)
      throw FileError(path.string(), "'" + field + "' holds '" + one_line(word) + "'; a number is needed");
    numbers.push_back(value);
  }
  return numbers;
}

std::vector<std::string> numbered_names(const fs::path& path, const std::string& pattern, long long first,
                                        long long last, long long step, std::size_t limit) {
  // Only one conversion of an int with a modest width may reach snprintf: the pattern comes from a file.
  static const std::regex integer("([^%]*)%0?[0-9]{0,2}[diu]([^%]*)");
  if (!std::regex_match(pattern, integer))
    throw FileError(path.string(), "the data file pattern '" + one_line(pattern) +
                                       "' needs exactly one integer conversion such as %03d");
  constexpr long long most = 1000000000; // keeps the arithmetic and the int of the conversion in range
  if (std::abs(first) > most || std::abs(last) > most || std::abs(step) > most || step == 0 ||
      (last - first) / step < 0 || static_cast<std::size_t>((last - first) / step) >= limit)
    throw FileError(path.string(), "the range of the data file pattern '" + one_line(pattern) +
                                       "' gives no or too many files");
  std::vector<std::string> names;
  for (long long n = first; step > 0 ? n <= last : n >= last; n += step) {
    std::array<char, 4096> name{};
    const int length = std::snprintf(name.data(), name.size(), pattern.c_str(), static_cast<int>(n));
    if (length < 0 || static_cast<std::size_t>(length) >= name.size())
      throw FileError(path.string(), "the data file pattern is too long");
    names.emplace_back(name.data());
  }
  return names;
}

std::string head_of(const fs::path& path, std::size_t limit) {
  std::ifstream in(path, std::ios::binary);
  if (!in)
    throw FileError(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
  std::string text(limit, '\0');
  in.read(text.data(), static_cast<std::streamsize>(limit));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

std::vector<std::filesystem::path> existing_data_files(const std::filesystem::path& header,
                                                       const std::vector<std::string>& names,
                                                       const std::string& none) {
  std::vector<std::filesystem::path> files;
  for (const std::string& name : names) {
    const std::filesystem::path named(name);
    const std::filesystem::path file = named.is_absolute() ? named : header.parent_path() / named;
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
      throw FileError(header.string(),
                      "its data file '" + one_line(name) + "' is missing; put it beside the header");
    }
    require_file(file);
    files.push_back(file);
  }
  if (files.empty())
    throw FileError(header.string(), none);
  return files;
}

} // namespace slicelens
