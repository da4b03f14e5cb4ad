// What reading and writing files of bricks share. For volume/brick_*.cpp only.
#pragma once

#include "volume/brick_file.h"
#include "volume/byte_record.h"

#include <cstdint>

namespace slicelens {

/// The first bytes of a file of bricks. Written last, so that a file that is not whole has none.
struct BrickPrologue {
  std::uint64_t header_at = 0;
  std::uint64_t header_bytes = 0;
  std::uint32_t header_checksum = 0;
  std::uint64_t file_bytes = 0;
};

/// Bytes of a prologue, and where the bricks begin.
inline constexpr std::size_t prologue_bytes = 64;

std::vector<std::byte> bytes_of(const BrickPrologue& prologue);
std::vector<std::byte> bytes_of(const BrickHeader& header);

/// A stream over one level of a file that is being written: nothing checks that it stays as it is.
std::unique_ptr<const VoxelStream> unfinished_level(const std::filesystem::path& path, const BrickGrid& grid);

} // namespace slicelens
