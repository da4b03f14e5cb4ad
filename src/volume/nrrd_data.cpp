#include "volume/nrrd_data.h"

#include "core/errors.h"
#include "core/text.h"
#include "volume/decoding.h"
#include "volume/readers.h"
#include "volume/vti_data.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// Bytes grow with what is really there: a header that lies about compressed data costs no memory.
constexpr std::size_t piece_bytes = std::size_t{1} << 24;

/// Longest header of another format in front of compressed voxels that `byte skip: -1` leaves out.
constexpr std::uintmax_t most_skipped = std::uintmax_t{64} << 20;

std::vector<fs::path> files_of(const fs::path& path, const NrrdHeader& header) {
  return header.data_files.empty() ? std::vector<fs::path>{path} : header.data_files;
}

/// Where a file's data begin behind the header and the lines that are skipped (before anything is decoded).
std::uintmax_t start_of(const fs::path& path, const NrrdHeader& header, const fs::path& file) {
  std::uintmax_t start = header.data_files.empty() ? header.bytes : 0;
  if (header.line_skip == 0)
    return start;
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(start));
  for (long long line = 0; line < header.line_skip; ++line) {
    int c = 0;
    do {
      c = in.get();
      if (c == std::char_traits<char>::eof())
        throw FileError(path.string(), "has fewer lines than 'line skip' says");
      ++start;
    } while (c != '\n');
  }
  return start;
}

/// The data's length once decoded, at most `limit`.
std::uintmax_t decoded_length(const fs::path& path, const fs::path& file, std::uintmax_t start,
                              Encoding encoding, std::uintmax_t limit) {
  if (encoding == Encoding::raw) {
    const std::uintmax_t length = fs::file_size(file);
    return length - std::min(length, start);
  }
  const auto stream = open_stream(file, start, encoding);
  std::vector<std::byte> ignored(std::size_t{1} << 20);
  std::uintmax_t length = 0;
  while (const std::size_t got = stream->read(ignored.data(), ignored.size())) {
    length += got;
    if (length > limit)
      throw FileError(path.string(),
                      "'byte skip: -1' but its data are far longer than 'sizes' says; the header is wrong");
  }
  return length;
}

/// The decoded bytes of all data files in turn, `per_file` of each.
class NrrdStream {
public:
  NrrdStream(const fs::path& path, const NrrdHeader& header, std::uintmax_t total)
      : path_(path), header_(header), files_(files_of(path, header)), per_file_(total / files_.size()) {}

  void skip(std::uintmax_t count) {
    std::vector<std::byte> ignored(std::min<std::uintmax_t>(count, std::size_t{1} << 20));
    while (count > 0) {
      const auto piece = static_cast<std::size_t>(std::min<std::uintmax_t>(count, ignored.size()));
      read(ignored.data(), piece);
      count -= piece;
    }
  }

  void read(std::byte* out, std::size_t count) {
    while (count > 0) {
      if (left_ == 0)
        open_next();
      const auto piece = static_cast<std::size_t>(std::min<std::uintmax_t>(count, left_));
      const std::size_t got = stream_->read(out, piece);
      if (got == 0)
        throw FileError(path_.string(),
                        "its data end " + std::to_string(left_) +
                            " bytes before 'sizes' says; the file is truncated or its header wrong");
      out += got;
      count -= got;
      left_ -= got;
    }
  }

  /// Whether the file read last holds more than its share and a line's end; compares its checksum.
  bool has_more() {
    std::array<std::byte, 3> beyond{};
    return stream_ && left_ == 0 && stream_->read(beyond.data(), beyond.size()) == beyond.size();
  }

private:
  void open_next() {
    if (next_ == files_.size())
      throw FileError(path_.string(), "its data files hold less than 'sizes' says");
    const fs::path& file = files_[next_++];
    const std::uintmax_t start = start_of(path_, header_, file);
    std::uintmax_t skipped = static_cast<std::uintmax_t>(std::max(header_.byte_skip, 0LL));
    if (header_.byte_skip == -1) {
      const std::uintmax_t length =
          decoded_length(path_, file, start, header_.encoding, per_file_ + most_skipped);
      skipped = length - std::min(length, per_file_);
    }
    const bool raw = header_.encoding == Encoding::raw;
    stream_ = open_stream(file, start + (raw ? skipped : 0), header_.encoding);
    left_ = per_file_;
    if (raw)
      return;
    std::vector<std::byte> ignored(std::size_t{1} << 16); // bytes are skipped in what is decoded
    while (skipped > 0) {
      const auto piece = static_cast<std::size_t>(std::min<std::uintmax_t>(skipped, ignored.size()));
      const std::size_t got = stream_->read(ignored.data(), piece);
      if (got == 0)
        throw FileError(path_.string(), "its data end within 'byte skip'");
      skipped -= got;
    }
  }

  const fs::path& path_;
  const NrrdHeader& header_;
  std::vector<fs::path> files_;
  std::uintmax_t per_file_;
  std::size_t next_ = 0;
  std::uintmax_t left_ = 0;
  std::unique_ptr<ByteStream> stream_;
};

/// Text and hexadecimal data of all files as one string, skipped lines and bytes left out.
std::string text_of(const fs::path& path, const NrrdHeader& header) {
  std::string text;
  for (const fs::path& file : files_of(path, header)) {
    const auto skipped = static_cast<std::uintmax_t>(std::max(header.byte_skip, 0LL));
    const std::uintmax_t start = start_of(path, header, file) + skipped;
    const std::uintmax_t length = fs::file_size(file);
    const std::size_t old = text.size();
    text.resize(old + static_cast<std::size_t>(length - std::min(length, start)));
    const std::size_t got = open_stream(file, start, Encoding::raw)
                                ->read(reinterpret_cast<std::byte*>(text.data() + old), text.size() - old);
    text.resize(old + got);
    text += '\n';
  }
  return text;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9')
    return c - '0';
  const char small = static_cast<char>(c | 32);
  return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
}

/// Pairs of digits; white space between digits is left out.
std::vector<std::byte> bytes_of_hex(const fs::path& path, const std::string& text, std::size_t count) {
  std::vector<std::byte> bytes;
  bytes.reserve(std::min(count, text.size() / 2));
  int high = -1;
  for (const char c : text) {
    if (bytes.size() == count)
      break;
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t')
      continue;
    const int digit = hex_digit(c);
    if (digit < 0)
      throw FileError(path.string(), "its hex data hold a character that is no hexadecimal digit");
    if (high >= 0)
      bytes.push_back(static_cast<std::byte>(high << 4 | digit));
    high = high >= 0 ? -1 : digit;
  }
  if (bytes.size() < count)
    throw FileError(path.string(), "its hex data end after " + std::to_string(bytes.size()) + " of " +
                                       std::to_string(count) + " bytes; the file is truncated");
  return bytes;
}

std::vector<std::byte> part_of(std::vector<std::byte> all, const NrrdPart& part) {
  all.erase(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(part.first));
  all.resize(part.count);
  return all;
}

std::vector<std::byte> read_text(const fs::path& path, const NrrdHeader& header, ScalarType type,
                                 const NrrdPart& part) {
  std::string text = text_of(path, header);
  std::replace(text.begin(), text.end(), ',', ' ');
  Volume all;
  all.type = type;
  all.voxels.resize(part.total);
  read_ascii_array(path, text.c_str(), all);
  return part_of(std::move(all.voxels), part);
}

void warn_of_more(const fs::path& path, std::size_t total, const Progress& progress) {
  report_warning(progress, path.string() + ": its data are longer than 'sizes' says; the first " +
                               std::to_string(total) +
                               " bytes are used (a header in front of them needs 'byte skip')");
}

std::vector<std::byte> read_binary(const fs::path& path, const NrrdHeader& header, const NrrdPart& part,
                                   const Progress& progress) {
  NrrdStream stream(path, header, part.total);
  stream.skip(part.first);
  std::vector<std::byte> bytes;
  while (bytes.size() < part.count) {
    const std::size_t done = bytes.size();
    const std::size_t piece = std::min(part.count - done, std::max(piece_bytes, done));
    bytes.resize(done + piece);
    stream.read(bytes.data() + done, piece);
  }
  if (part.first + part.count == part.total && stream.has_more())
    warn_of_more(path, part.total, progress);
  return bytes;
}

} // namespace

std::vector<std::byte> read_nrrd_data(const fs::path& path, const NrrdHeader& header, ScalarType type,
                                      const NrrdPart& part, const Progress& progress) {
  if (header.encoding == Encoding::text)
    return read_text(path, header, type, part);
  std::vector<std::byte> bytes = header.encoding == Encoding::hex
                                     ? part_of(bytes_of_hex(path, text_of(path, header), part.total), part)
                                     : read_binary(path, header, part, progress);
  if (is_swapped(header))
    swap_bytes(bytes, header.scalar_bytes);
  return bytes;
}

bool is_swapped(const NrrdHeader& header) {
  const auto endian = header.fields.find("endian");
  const bool big = endian != header.fields.end() && lower(endian->second) == "big";
  return header.scalar_bytes > 1 && big != (std::endian::native == std::endian::big);
}

std::vector<RawLayout::Piece> nrrd_pieces(const fs::path& path, const NrrdHeader& header, std::size_t total,
                                          bool to_end, const Progress& progress) {
  const std::vector<fs::path> files = files_of(path, header);
  if (total % files.size() != 0)
    return {};
  const std::uintmax_t share = total / files.size();
  std::vector<RawLayout::Piece> pieces;
  std::uintmax_t left = 0; // behind the last file's share
  for (const fs::path& file : files) {
    std::uintmax_t start = start_of(path, header, file);
    const std::uintmax_t length = fs::file_size(file) - std::min(fs::file_size(file), start);
    start += header.byte_skip == -1 ? length - std::min(length, share)
                                    : static_cast<std::uintmax_t>(header.byte_skip);
    const std::uintmax_t there = fs::file_size(file) - std::min(fs::file_size(file), start);
    if (there < share) {
      throw FileError(path.string(), "its data end " + std::to_string(share - there) +
                                         " bytes before 'sizes' says; the file is truncated or its header "
                                         "wrong");
    }
    left = there - share;
    pieces.push_back({file, start, share});
  }
  if (to_end && left >= 3) // as has_more: more than a line's end
    warn_of_more(path, total, progress);
  return pieces;
}

} // namespace slicelens
