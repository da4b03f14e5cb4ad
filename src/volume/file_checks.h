// Checks that every reader makes before it believes a header. Private to src/volume.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// How voxels are stored, which bounds how many bytes a file of a given length can hold.
enum class Encoding {
  raw,     ///< as they are
  deflate, ///< zlib or gzip: at most 1032 bytes out of one (RFC 1951: a 258 byte match takes 2 bits)
  bzip2,   ///< at most a million bytes out of one: a block of 900 000 run lengths of 255 in some 45 bytes
  text,    ///< decimal numbers with separators: at least two characters each
  hex,     ///< two characters a byte
  codec    ///< an image codec (JPEG, RLE, LZW …): bounded loosely
};

/// Throws FileError unless `path` is a regular, readable file that is not empty. Returns its size in bytes.
std::uintmax_t require_file(const std::filesystem::path& path);

/// The data files that a header names, relative to its folder. Throws FileError naming `header` and the first
/// one that is missing, `none` when there are no names, and as require_file does.
std::vector<std::filesystem::path> existing_data_files(const std::filesystem::path& header,
                                                       const std::vector<std::string>& names,
                                                       const std::string& none);

/// Closes a C file, for std::unique_ptr.
struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// Product of `sizes` and `unit` (bytes of one voxel). Throws FileError naming `field` when a size is not
/// positive or the product does not fit 63 bits.
std::uintmax_t claimed_bytes(const std::filesystem::path& path, const std::string& field,
                             const std::vector<long long>& sizes, std::uintmax_t unit);

/// Throws FileError when `stored` bytes cannot decode to the `claimed` ones that `field` promises;
/// `scalar_bytes` is the size of one number (for text).
void check_claim(const std::filesystem::path& path, const std::string& field, std::uintmax_t claimed,
                 std::uintmax_t stored, Encoding encoding, std::uintmax_t scalar_bytes = 1);

/// Throws LimitError when `bytes` is more than the machine's memory.
void check_memory(const std::filesystem::path& path, std::uintmax_t bytes);

/// The text without leading and trailing white space.
std::string trimmed(const std::string& text);

/// The first line that says something, without control characters and at most 200 characters long: what
/// libraries' long exception texts become in our one-line messages.
std::string one_line(const std::string& text);

/// Words separated by white space.
std::vector<std::string> words_of(const std::string& text);

/// The integers in `text`. Throws FileError naming `field` when a word is not an integer of 63 bits.
std::vector<long long> integers_of(const std::filesystem::path& path, const std::string& field,
                                   const std::string& text);

/// The numbers in `text` ("nan" and "inf" are numbers). Throws FileError naming `field` otherwise.
std::vector<double> numbers_of(const std::filesystem::path& path, const std::string& field,
                               const std::string& text);

/// Files "prefix%03dsuffix" with a printf integer conversion, for first, first + step … last. Throws
/// FileError when the pattern has no single integer conversion or would give more than `limit` names.
std::vector<std::string> numbered_names(const std::filesystem::path& path, const std::string& pattern,
                                        long long first, long long last, long long step,
                                        std::size_t limit = 100000);

/// The leading bytes of a file as text, at most `limit`.
std::string head_of(const std::filesystem::path& path, std::size_t limit);

} // namespace slicelens
