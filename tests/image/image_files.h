// Pictures and files for the tests of reading and writing.
#pragma once

#include "core/errors.h"
#include "image/image_io.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>

namespace slicelens {

namespace fs = std::filesystem;

/// A folder of its own for one test case, removed at its end.
struct Scratch {
  fs::path folder;
  explicit Scratch(const std::string& name)
      : folder(fs::temp_directory_path() / ("slicelens_image_" + name + "_" + std::to_string(::getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Scratch() {
    std::error_code error;
    fs::remove_all(folder, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path operator/(const std::string& name) const { return folder / name; }
};

/// Associated colour of random size and alpha.
inline Image random_image(int width, int height, unsigned seed) {
  Image image = make_image(width, height);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    const float alpha = uniform(random);
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i + c] = alpha * uniform(random);
    image.pixels[i + 3] = alpha;
  }
  return image;
}

inline std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

inline void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Four bytes, the highest first.
inline std::string number(std::uint32_t n) {
  return {static_cast<char>(n >> 24U), static_cast<char>(n >> 16U), static_cast<char>(n >> 8U),
          static_cast<char>(n)};
}

/// A chunk of a PNG.
inline std::string chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFFU; // ISO 15948 §5.5
  for (const char c : type + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit)
      crc = (crc & 1U) != 0 ? 0xEDB88320U ^ (crc >> 1U) : crc >> 1U;
  }
  return number(static_cast<std::uint32_t>(data.size())) + type + data + number(~crc);
}

/// A PNG made by hand: the header's sizes, depth and colour type, chunks before the pixels, and the rows with
/// their filter bytes, stored without compression.
inline std::string png_of(std::uint32_t width, std::uint32_t height, char depth, char colour_type,
                          const std::string& chunks, const std::string& rows) {
  const auto length = static_cast<char>(rows.size()); // below 128
  std::uint32_t low = 1;                              // Adler-32
  std::uint32_t high = 0;
  for (const char c : rows) {
    low = (low + static_cast<unsigned char>(c)) % 65521U;
    high = (high + low) % 65521U;
  }
  const std::string stored = std::string("\x78\x01\x01", 3) + length + '\0' + static_cast<char>(~length) +
                             '\xff' + rows + number(high << 16U | low);
  return std::string("\x89PNG\r\n\x1a\n", 8) +
         chunk("IHDR", number(width) + number(height) + depth + colour_type + std::string(3, '\0')) + chunks +
         chunk("IDAT", stored) + chunk("IEND", "");
}

inline constexpr PixelDepth all_depths[] = {PixelDepth::png8, PixelDepth::png16, PixelDepth::exr_half,
                                            PixelDepth::exr_float};

inline std::string name_for(PixelDepth depth) {
  return depth == PixelDepth::png8 || depth == PixelDepth::png16 ? "a.png" : "a.exr";
}

/// An uncompressed EXR of one float channel made by hand (the OpenEXR file layout, version 2), all pixels
/// `value`. Windows are xMin, yMin, xMax, yMax.
inline std::string exr_of(const std::string& channel_name, std::array<std::int32_t, 4> data_window,
                          std::array<std::int32_t, 4> display_window, float value) {
  std::string file("\x76\x2f\x31\x01\x02\0\0\0", 8);
  const auto append = [&](const auto& data) {
    file.append(reinterpret_cast<const char*>(&data), sizeof data);
  };
  const auto attribute = [&](const std::string& name, const std::string& type, const std::string& data) {
    file += name + '\0' + type + '\0';
    append(static_cast<std::int32_t>(data.size()));
    file += data;
  };
  const auto bytes_of = [](const auto& data) {
    return std::string(reinterpret_cast<const char*>(&data), sizeof data);
  };
  const std::array<std::int32_t, 4> float_channel{2, 0, 1, 1}; // type, linear, sampling in x and y
  attribute("channels", "chlist", channel_name + '\0' + bytes_of(float_channel) + '\0');
  attribute("compression", "compression", std::string(1, '\0'));
  attribute("dataWindow", "box2i", bytes_of(data_window));
  attribute("displayWindow", "box2i", bytes_of(display_window));
  attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  attribute("pixelAspectRatio", "float", bytes_of(1.0F));
  attribute("screenWindowCenter", "v2f", std::string(8, '\0'));
  attribute("screenWindowWidth", "float", bytes_of(1.0F));
  file += '\0';
  // at most 16 pixels on a side are written, whatever the window claims
  const std::int32_t width = std::min(data_window[2] - data_window[0] + 1, 16);
  const std::int32_t height = std::min(data_window[3] - data_window[1] + 1, 16);
  const auto row_bytes = static_cast<std::int32_t>(sizeof(float)) * width;
  const std::uint64_t rows = file.size() + 8 * static_cast<std::uint64_t>(height);
  for (std::int32_t y = 0; y < height; ++y)
    append(rows + static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(8 + row_bytes));
  for (std::int32_t y = 0; y < height; ++y) {
    append(data_window[1] + y);
    append(row_bytes);
    for (std::int32_t x = 0; x < width; ++x)
      append(value);
  }
  return file;
}

} // namespace slicelens
