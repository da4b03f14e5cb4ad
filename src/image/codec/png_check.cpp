#include "image/codec/png_check.h"

#include "core/errors.h"
#include "image/codec/limits.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <vector>

namespace slicelens {

namespace {

constexpr std::string_view signature{"\x89PNG\r\n\x1a\n", 8};

/// ISO 15948 Annex D.
std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit)
      c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1U) : c >> 1U;
    table[n] = c;
  }
  return table;
}

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(0, 4))
    value = value << 8U | static_cast<unsigned char>(c);
  return value;
}

/// Fewest bytes that the rows of an IHDR's picture take before compression.
double raw_bytes(std::string_view header) {
  constexpr std::array<int, 7> samples{1, 0, 3, 1, 2, 0, 4}; // of colour types 0 to 6
  const auto colour_type = static_cast<unsigned char>(header[9]);
  const int channels = colour_type < samples.size() ? samples[colour_type] : 0;
  return static_cast<double>(big_endian(header)) * big_endian(header.substr(4)) * channels *
         static_cast<unsigned char>(header[8]) / 8;
}

[[noreturn]] void cut_short(const std::string& path, const std::string& type) {
  throw FileError(path, "is cut short in its " + type + " chunk; write or copy the file again");
}

} // namespace

void check_png(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::array<char, 8> start{};
  const bool complete = static_cast<bool>(in.read(start.data(), 8));
  if (std::string_view(start.data() + 1, 3) != signature.substr(1, 3))
    return;
  if (!complete || std::string_view(start.data(), 8) != signature)
    throw FileError(path, "is damaged: the PNG signature is not right (was it copied as text?)");
  const auto table = crc_table();
  std::vector<char> buffer(std::size_t{1} << 16);
  double pixels_need = 0;
  double pixels_have = 0;
  std::string type = "first";
  for (bool first = true; type != "IEND"; first = false) {
    if (!in.read(buffer.data(), 8))
      cut_short(path, first ? "IHDR" : "last");
    const std::uint32_t length = big_endian({buffer.data(), 4});
    type.assign(buffer.data() + 4, 4);
    if (!std::all_of(type.begin(), type.end(), [](char c) { return (c | 32) >= 'a' && (c | 32) <= 'z'; }))
      throw FileError(path, "is damaged: a PNG chunk has no valid name; write or copy the file again");
    if (first && (type != "IHDR" || length != 13))
      throw FileError(path, "is damaged: a PNG must start with an IHDR chunk of 13 bytes");
    std::uint32_t crc = 0xFFFFFFFFU;
    const auto update = [&](const char* bytes, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i)
        crc = table[(crc ^ static_cast<unsigned char>(bytes[i])) & 255U] ^ (crc >> 8U);
    };
    update(type.data(), 4);
    for (std::size_t left = length; left > 0;) {
      const std::size_t piece = std::min(left, buffer.size());
      if (!in.read(buffer.data(), static_cast<std::streamsize>(piece)))
        cut_short(path, type);
      update(buffer.data(), piece);
      left -= piece;
      if (first) {
        check_size(path, big_endian({buffer.data(), 4}), big_endian({buffer.data() + 4, 4}), 4);
        pixels_need = raw_bytes({buffer.data(), 13});
      }
    }
    std::array<char, 4> stored{};
    if (!in.read(stored.data(), 4))
      cut_short(path, type);
    if (big_endian({stored.data(), 4}) != ~crc)
      throw FileError(path,
                      "is damaged: the checksum of its " + type + " chunk is wrong; copy the file again");
    if (type == "IDAT")
      pixels_have += length;
  }
  if (pixels_need > 1032 * pixels_have) // deflate cannot shrink further (zlib's technical details)
    throw FileError(path, "is damaged: too short for the size that its header claims");
}

} // namespace slicelens
