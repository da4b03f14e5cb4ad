// The data arrays of VTK XML files: ascii, base64 or raw bytes, plain or in zlib blocks. Private to
// src/volume.
#pragma once

#include "volume/volume.h"

#include <cstddef>
#include <filesystem>
#include <functional>

namespace slicelens {

/// How a file stores its arrays: attributes of <VTKFile> (VTK file formats, "XML File Formats").
struct VtiStorage {
  bool big_endian = false;
  std::size_t header_bytes = 4; ///< header_type: 4 for UInt32, 8 for UInt64
  bool zlib = false;            ///< compressor="vtkZLibDataCompressor"
};

/// Gives the next `count` bytes of an array (header and data in one run), or throws.
using ByteSource = std::function<void(std::byte* out, std::size_t count)>;

/// Bytes out of base64 text: each group of four characters gives 1 to 3 bytes, and a padded group may be
/// followed by another (VTK encodes the header and the blocks one after the other). White space is skipped.
/// `next` gives the next character or a negative number at the end.
ByteSource base64_source(const std::filesystem::path& path, std::function<int()> next);

/// Reads one array of exactly volume.voxels.size() bytes into it, in the machine's byte order. `stored` is
/// the number of bytes that `source` can give at most.
void read_array(const std::filesystem::path& path, const VtiStorage& storage, const ByteSource& source,
                std::uintmax_t stored, Volume& volume);

/// The same from decimal text.
void read_ascii_array(const std::filesystem::path& path, const char* text, Volume& volume);

} // namespace slicelens
