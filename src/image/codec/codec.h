// What the codec module offers to image_io.cpp: the only two files that know it.
#pragma once

#include "image/image_io.h"

#include <cstddef>
#include <vector>

namespace slicelens {

/// Raised with every change of CodecFunctions or of a type in it.
inline constexpr int codec_version = 1;

/// The functions throw the errors of core/errors.h. `path` is a regular file.
struct CodecFunctions {
  int version = codec_version;
  /// The bytes of a file. `path` appears in messages only.
  std::vector<unsigned char> (*encode)(const Image& image, PixelDepth depth,
                                       const std::string& path) = nullptr;
  /// The picture, or with `pixels` false only its metadata (width and height stay 0).
  Image (*decode)(const std::string& path, bool pixels) = nullptr;
};

/// Type and name of the module's one exported function.
using CodecEntry = const CodecFunctions* (*)();
inline constexpr const char* codec_entry_name = "slicelens_codec_functions";

} // namespace slicelens
