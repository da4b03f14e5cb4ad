#include "volume/vti_data.h"

#include "core/errors.h"
#include "volume/file_checks.h"
#include "volume/readers.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <type_traits>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

int digit_of(int c) {
  if (c >= 'A' && c <= 'Z')
    return c - 'A';
  if (c >= 'a' && c <= 'z')
    return c - 'a' + 26;
  if (c >= '0' && c <= '9')
    return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

bool foreign(const VtiStorage& storage) {
  return storage.big_endian != (std::endian::native == std::endian::big);
}

std::uint64_t header_word(const VtiStorage& storage, const ByteSource& source) {
  std::vector<std::byte> bytes(storage.header_bytes);
  source(bytes.data(), bytes.size());
  if (foreign(storage))
    std::reverse(bytes.begin(), bytes.end());
  if (storage.header_bytes == 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), sizeof word);
    return word;
  }
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data(), sizeof word);
  return word;
}

[[noreturn]] void throw_size(const fs::path& path, std::uint64_t found, std::uint64_t expected) {
  throw FileError(path.string(), "its data array says it has " + std::to_string(found) +
                                     " bytes but 'Extent' and 'type' need " + std::to_string(expected));
}

/// Header: number of blocks, bytes of a block, bytes of the last one if shorter, compressed bytes of each.
void read_zlib_blocks(const fs::path& path, const VtiStorage& storage, const ByteSource& source,
                      std::uintmax_t stored, std::vector<std::byte>& out) {
  const std::uint64_t blocks = header_word(storage, source);
  const std::uint64_t block_bytes = header_word(storage, source);
  const std::uint64_t last_bytes = header_word(storage, source);
  if (blocks == 0 || blocks > stored / storage.header_bytes || block_bytes == 0 || block_bytes > out.size() ||
      last_bytes >= block_bytes) {
    // A single block larger than the array can only be a partial one.
    if (!(blocks == 1 && last_bytes == out.size()))
      throw FileError(path.string(), "the block header of its compressed data is damaged");
  }
  const std::uint64_t full = last_bytes == 0 ? blocks : blocks - 1;
  const bool fits = full == 0 || block_bytes <= out.size() / full;
  const std::uint64_t total = fits ? full * block_bytes + last_bytes : ~std::uint64_t{0};
  if (total != out.size())
    throw_size(path, total, out.size());
  std::vector<std::uint64_t> packed(blocks);
  for (std::uint64_t& bytes : packed) {
    bytes = header_word(storage, source);
    if (bytes > stored)
      throw FileError(path.string(), "a compressed block claims " + std::to_string(bytes) +
                                         " bytes, more than the file has; the file is truncated or damaged");
  }
  std::vector<std::byte> block;
  std::size_t at = 0;
  for (std::uint64_t k = 0; k < blocks; ++k) {
    block.resize(packed[k]);
    source(block.data(), block.size());
    const uLongf expected = static_cast<uLongf>(k < full ? block_bytes : last_bytes);
    uLongf length = expected;
    const int status =
        ::uncompress(reinterpret_cast<Bytef*>(out.data() + at), &length,
                     reinterpret_cast<const Bytef*>(block.data()), static_cast<uLong>(block.size()));
    if (status != Z_OK || length != expected)
      throw FileError(path.string(), "compressed block " + std::to_string(k) + " is damaged");
    at += expected;
  }
}

} // namespace

ByteSource base64_source(const fs::path& path, std::function<int()> next) {
  struct State {
    std::array<std::byte, 3> ready{};
    std::size_t first = 0;
    std::size_t count = 0;
  };
  return [path, next = std::move(next), state = State{}](std::byte* out, std::size_t count) mutable {
    for (std::size_t done = 0; done < count;) {
      if (state.first == state.count) {
        std::array<int, 4> digits{};
        std::size_t padding = 0;
        for (int& digit : digits) {
          int c = next();
          while (c == ' ' || c == '\n' || c == '\r' || c == '\t')
            c = next();
          digit = c == '=' ? 0 : digit_of(c);
          padding += c == '=' ? 1 : 0;
          if (digit < 0)
            throw FileError(path.string(), c < 0 ? "its base64 data end too early; the file is truncated"
                                                 : "its base64 data hold a character that is none");
        }
        if (padding > 2)
          throw FileError(path.string(), "its base64 data are padded wrongly");
        const unsigned word = static_cast<unsigned>(digits[0]) << 18 |
                              static_cast<unsigned>(digits[1]) << 12 | static_cast<unsigned>(digits[2]) << 6 |
                              static_cast<unsigned>(digits[3]);
        state.ready = {std::byte(word >> 16 & 255), std::byte(word >> 8 & 255), std::byte(word & 255)};
        state.first = 0;
        state.count = 3 - padding;
      }
      out[done++] = state.ready[state.first++];
    }
  };
}

void read_array(const fs::path& path, const VtiStorage& storage, const ByteSource& source,
                std::uintmax_t stored, Volume& volume) {
  if (storage.zlib) {
    read_zlib_blocks(path, storage, source, stored, volume.voxels);
  } else {
    const std::uint64_t bytes = header_word(storage, source);
    if (bytes != volume.voxels.size())
      throw_size(path, bytes, volume.voxels.size());
    source(volume.voxels.data(), volume.voxels.size());
  }
  if (foreign(storage))
    swap_bytes(volume.voxels, size_of(volume.type));
}

void read_ascii_array(const fs::path& path, const char* text, Volume& volume) {
  const char* const end = text + std::strlen(text);
  const std::size_t count = volume.voxels.size() / size_of(volume.type);
  visit_scalar_type(volume.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    T* const out = reinterpret_cast<T*>(volume.voxels.data());
    for (std::size_t i = 0; i < count; ++i) {
      while (text != end && std::strchr(" \t\r\n", *text) != nullptr)
        ++text;
      // from_chars reads the 8-bit types as numbers too, as VTK writes them.
      const auto [stop, status] = std::from_chars(text, end, out[i]);
      if (status != std::errc())
        throw FileError(path.string(), text == end ? "its ascii data end after " + std::to_string(i) +
                                                         " of " + std::to_string(count) + " numbers"
                                                   : "number " + std::to_string(i) +
                                                         " of its ascii data is none of its type");
      text = stop;
    }
  });
}

} // namespace slicelens
