// Helpers for tests that write small volume files byte by byte.
#pragma once

#include "catch.h"
#include "core/errors.h"
#include "deflated.h"
#include "temporary_folder.h"
#include "volume/read.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace slicelens {

inline void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The bytes of numbers, in the machine's order or reversed.
template <class T>
std::string bytes_of(const std::vector<T>& numbers, bool reversed = false) {
  std::string bytes;
  for (const T number : numbers) {
    std::string one(sizeof(T), '\0');
    std::memcpy(one.data(), &number, sizeof(T));
    bytes += reversed ? std::string(one.rbegin(), one.rend()) : one;
  }
  return bytes;
}

inline Volume read_file(const std::filesystem::path& path, std::size_t frame = 0) {
  VolumeSource source;
  source.file = path;
  source.frame = frame;
  return read_volume(source);
}

/// The message with which reading `path` is refused; "" when it is read.
inline std::string refusal(const std::filesystem::path& path) {
  try {
    read_file(path);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// All scalars of a volume as doubles.
inline std::vector<double> scalars_of(const Volume& volume) {
  std::vector<double> scalars;
  for (std::size_t i = 0; i < volume.voxels.size() / size_of(volume.type); ++i)
    scalars.push_back(scalar_at(volume, i));
  return scalars;
}

} // namespace slicelens
