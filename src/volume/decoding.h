// Reading a file's bytes as they are, or through zlib or libbz2. Private to src/volume.
#pragma once

#include "volume/file_checks.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

namespace slicelens {

/// Decoded bytes in order.
class ByteStream {
public:
  ByteStream() = default;
  virtual ~ByteStream() = default;
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;

  /// Up to `count` bytes; fewer only at the end, where checksums have been compared. Throws FileError when
  /// the data are damaged or end in the middle of a compressed stream.
  virtual std::size_t read(std::byte* out, std::size_t count) = 0;
};

/// The file from `offset`: raw, text and hex as they are, deflate (zlib or gzip, several streams in turn),
/// bzip2.
std::unique_ptr<ByteStream> open_stream(const std::filesystem::path& path, std::uintmax_t offset,
                                        Encoding encoding);

} // namespace slicelens
