// A scan as bytes, and scans that are kept from one run of the program to the next. Private to src/volume.
#pragma once

#include "core/progress.h"
#include "volume/byte_record.h"
#include "volume/read.h"
#include "volume/scan.h"

#include <filesystem>
#include <optional>
#include <string>

namespace slicelens {

void put_scan(ByteWriter& out, const VoxelScan& scan);

/// Throws FileError unless the record is whole and its sizes are those of a volume of `dims`.
VoxelScan get_scan(ByteReader& in, const std::array<std::size_t, 3>& dims);

/// CRC-32 of zlib.
std::uint32_t crc_of(std::span<const std::byte> bytes);

/// $XDG_CACHE_HOME/slicelens, else ~/.cache/slicelens; empty where neither variable is set. Not made.
std::filesystem::path user_cache();

/// What of a source, beside its files' contents, decides which voxels it names.
std::string choice_text(const VolumeSource& source);

/// A scan of the files that stamps_text gave `identity` for (with the keys that choose among their voxels),
/// and the type of their voxels.
struct KeptScan {
  ScalarType type = ScalarType::u8;
  VoxelScan scan;
};

/// Nothing where none is kept. One that is damaged counts as none and is warned of.
std::optional<KeptScan> kept_scan(const std::string& identity, const std::array<std::size_t, 3>& dims,
                                  const Progress& progress);

/// Warns where it cannot be written: the next run scans again.
void keep_scan(const std::string& identity, const KeptScan& kept, const Progress& progress);

} // namespace slicelens
