#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"
#include "volume/readers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <regex>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

const char* const remedy =
    "; give --set volume.size=[X,Y,Z] and --set volume.type=TYPE, or name the file like "
    "foot_256x256x256_uint8.raw";

struct NameClaim {
  std::optional<std::array<long long, 3>> size;
  std::optional<ScalarType> type;
};

/// Size and type as they are usually put into names: foot_256x256x256_uint8.raw, foot-256x256x256-u16,
/// foot_256_256_256_ushort.raw.
NameClaim claim_of_name(const fs::path& path) {
  NameClaim claim;
  const std::string name = lower(path.filename().string());
  static const std::regex sizes("(^|[^0-9])([0-9]{1,9})(x|_)([0-9]{1,9})\\3([0-9]{1,9})([^0-9]|$)");
  std::smatch match;
  if (std::regex_search(name, match, sizes))
    claim.size = {std::stoll(match[2]), std::stoll(match[4]), std::stoll(match[5])};
  static const std::regex word("[a-z]+[0-9]*");
  for (auto it = std::sregex_iterator(name.begin(), name.end(), word); it != std::sregex_iterator(); ++it) {
    try {
      claim.type = scalar_type_from_name(it->str());
    } catch (const UsageError&) {
      continue; // not every word of a name is a type
    }
  }
  return claim;
}

/// What to do about a file whose size or type is not known: a header of the same name beside it knows both.
std::string remedy_for(const fs::path& path) {
  for (const char* extension : {".nhdr", ".mhd", ".mha"}) {
    std::error_code error;
    fs::path header = path;
    if (fs::exists(header.replace_extension(extension), error))
      return "; name " + header.filename().string() + " beside it, which describes it";
  }
  return remedy;
}

} // namespace

void swap_bytes(std::span<std::byte> scalars, std::size_t size) {
  if (size < 2)
    return;
  for (std::size_t at = 0; at + size <= scalars.size(); at += size)
    std::reverse(scalars.begin() + static_cast<std::ptrdiff_t>(at),
                 scalars.begin() + static_cast<std::ptrdiff_t>(at + size));
}

OpenedVolume open_raw(const VolumeSource& source) {
  const fs::path& path = source.file;
  const std::uintmax_t found = require_file(path);
  const NameClaim claim = claim_of_name(path);
  if (!source.size && !claim.size)
    throw FileError(path.string(), "is headerless and its size is not known" + remedy_for(path));
  if (!source.type && !claim.type)
    throw FileError(path.string(), "is headerless and its scalar type is not known" + remedy_for(path));

  Volume volume;
  volume.type = source.type ? *source.type : *claim.type;
  std::vector<long long> size;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size.push_back(source.size
                       ? static_cast<long long>(std::min<std::size_t>((*source.size)[axis], 1LL << 62))
                       : (*claim.size)[axis]);
    if (source.size && size.back() <= 0)
      throw UsageError("volume.size holds 0; every size must be at least 1");
    volume.dims[axis] = static_cast<std::size_t>(size.back());
  }
  const std::uintmax_t expected = claimed_bytes(path, "size", size, size_of(volume.type));
  if (expected != found) {
    throw FileError(path.string(), std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " +
                                       std::to_string(size[2]) + " voxels of " + name_of(volume.type) +
                                       " are " + std::to_string(expected) + " bytes but the file has " +
                                       std::to_string(found) + "; correct volume.size or volume.type");
  }
  volume.format = "raw";
  const bool big = source.big_endian.value_or(false);
  RawLayout layout;
  layout.pieces = {{path, 0, expected}};
  layout.step = {1, volume.dims[0], std::uintmax_t{volume.dims[0]} * volume.dims[1]};
  layout.swapped = big != (std::endian::native == std::endian::big);
  return {std::move(volume), std::move(layout)};
}

Volume read_raw(const VolumeSource& source, const Progress&) {
  OpenedVolume opened = open_raw(source);
  Volume volume = std::move(opened.volume);
  const fs::path& path = source.file;
  const std::size_t expected = voxel_bytes(volume);
  check_memory(path, expected);
  volume.voxels.resize(expected);
  std::ifstream in(path, std::ios::binary);
  if (!in.read(reinterpret_cast<char*>(volume.voxels.data()), static_cast<std::streamsize>(expected)))
    throw FileError(path.string(), "cannot be read in full");
  if (opened.layout->swapped)
    swap_bytes(volume.voxels, size_of(volume.type));
  return volume;
}

} // namespace slicelens
