#include "core/errors.h"
#include "volume/brick_parts.h"
#include "volume/file_checks.h"
#include "volume/file_stamp.h"
#include "volume/pyramid.h"
#include "volume/scan_record.h"

#include <algorithm>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t magic = 0x316b636972626c73; // "slbrick1" on a little-endian machine
constexpr std::size_t most_levels = 64;             // a volume of 2^63 voxels on an axis has no more

void put_vector(ByteWriter& out, const glm::dvec3& v) {
  for (int axis = 0; axis < 3; ++axis)
    out.put(v[axis]);
}

glm::dvec3 get_vector(ByteReader& in) {
  glm::dvec3 v;
  for (int axis = 0; axis < 3; ++axis)
    v[axis] = in.get<double>();
  return v;
}

ScalarType get_type(ByteReader& in) {
  const auto type = in.get<std::uint8_t>();
  if (type > static_cast<std::uint8_t>(ScalarType::f64))
    in.damaged();
  return static_cast<ScalarType>(type);
}

BrickPrologue get_prologue(const std::vector<std::byte>& bytes, const fs::path& path, std::uintmax_t size) {
  ByteReader in(bytes, path.string());
  if (bytes.size() < prologue_bytes || in.get<std::uint64_t>() != magic)
    throw FileError(path.string(), "is no copy of a volume in bricks");
  BrickPrologue prologue;
  prologue.header_at = in.get<std::uint64_t>();
  prologue.header_bytes = in.get<std::uint64_t>();
  prologue.file_bytes = in.get<std::uint64_t>();
  prologue.header_checksum = in.get<std::uint32_t>();
  const std::size_t covered = 4 * sizeof(std::uint64_t) + sizeof(std::uint32_t);
  if (in.get<std::uint32_t>() != crc_of(std::span(bytes).first(covered)))
    in.damaged();
  if (prologue.file_bytes != size) {
    throw FileError(path.string(), "has " + std::to_string(size) + " bytes, but had " +
                                       std::to_string(prologue.file_bytes) +
                                       " when it was written; it is truncated");
  }
  if (prologue.header_at > size || prologue.header_bytes > size - prologue.header_at)
    in.damaged();
  return prologue;
}

/// The levels' grids, which must be those that half_size makes of `volume`, one behind the other.
std::vector<BrickGrid> get_levels(ByteReader& in, const Volume& volume) {
  const auto count = in.get<std::uint8_t>();
  if (count < 1 || count > most_levels)
    in.damaged();
  std::vector<BrickGrid> levels;
  std::uint64_t start = prologue_bytes;
  for (std::size_t level = 0; level < count; ++level) {
    std::vector<std::uint32_t> checksums = in.get_list<std::uint32_t>();
    const auto dims = level_dims(volume.dims, level);
    std::uintmax_t bricks = 1;
    for (const std::size_t n : dims) {
      bricks *= n / file_brick + (n % file_brick > 0 ? 1 : 0);
      if (bricks > checksums.size()) // before anything of that size is made
        in.damaged();
    }
    if (bricks != checksums.size())
      in.damaged();
    levels.push_back(brick_grid(dims, level == 0 ? volume.type : coarser_type(volume.type), start));
    levels.back().checksum = std::move(checksums);
    start = levels.back().offsets.back();
  }
  return levels;
}

BrickHeader get_header(ByteReader& in) {
  BrickHeader header;
  header.source.name = in.get_text();
  header.source.sha256 = in.get_text();
  header.source.choice = in.get_text();
  Volume& volume = header.volume;
  for (std::size_t& n : volume.dims) {
    n = static_cast<std::size_t>(in.get<std::uint64_t>());
    if (n < 1 || n > (std::size_t{1} << 40))
      in.damaged();
  }
  volume.type = get_type(in);
  volume.spacing = get_vector(in);
  volume.origin = get_vector(in);
  for (int axis = 0; axis < 3; ++axis)
    volume.direction[axis] = get_vector(in);
  volume.frames = static_cast<std::size_t>(in.get<std::uint64_t>());
  volume.format = in.get_text();
  header.levels = get_levels(in, volume);
  header.scan = get_scan(in, volume.dims);
  set_statistics(volume, header.scan);
  if (!in.at_end())
    in.damaged();
  return header;
}

} // namespace

VoxelBox BrickGrid::box(std::size_t brick) const {
  const std::array<std::size_t, 3> at = {brick % bricks[0], brick / bricks[0] % bricks[1],
                                         brick / bricks[0] / bricks[1]};
  VoxelBox box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t core = at[axis] * file_brick;
    box.first[axis] = core - std::min(core, file_brick_overlap);
    box.size[axis] = std::min(core + file_brick + file_brick_overlap, dims[axis]) - box.first[axis];
  }
  return box;
}

BrickGrid brick_grid(const std::array<std::size_t, 3>& dims, ScalarType type, std::uint64_t start) {
  BrickGrid grid;
  grid.dims = dims;
  grid.type = type;
  for (std::size_t axis = 0; axis < 3; ++axis)
    grid.bricks[axis] = (dims[axis] + file_brick - 1) / file_brick;
  const std::size_t count =
      checked_product(checked_product(grid.bricks[0], grid.bricks[1], "volume"), grid.bricks[2], "volume");
  grid.offsets.reserve(count + 1);
  for (std::size_t brick = 0; brick < count; ++brick) {
    grid.offsets.push_back(start);
    start += voxel_count(grid.box(brick)) * size_of(type);
  }
  grid.offsets.push_back(start);
  return grid;
}

std::vector<std::byte> bytes_of(const BrickPrologue& prologue) {
  ByteWriter out;
  out.put(magic);
  out.put(prologue.header_at);
  out.put(prologue.header_bytes);
  out.put(prologue.file_bytes);
  out.put(prologue.header_checksum);
  out.put(crc_of(out.bytes()));
  std::vector<std::byte> bytes = out.bytes();
  bytes.resize(prologue_bytes);
  return bytes;
}

std::vector<std::byte> bytes_of(const BrickHeader& header) {
  ByteWriter out;
  out.put_text(header.source.name);
  out.put_text(header.source.sha256);
  out.put_text(header.source.choice);
  for (const std::size_t n : header.volume.dims)
    out.put(static_cast<std::uint64_t>(n));
  out.put(static_cast<std::uint8_t>(header.volume.type));
  put_vector(out, header.volume.spacing);
  put_vector(out, header.volume.origin);
  for (int axis = 0; axis < 3; ++axis)
    put_vector(out, header.volume.direction[axis]);
  out.put(static_cast<std::uint64_t>(header.volume.frames));
  out.put_text(header.volume.format);
  out.put(static_cast<std::uint8_t>(header.levels.size()));
  for (const BrickGrid& level : header.levels)
    out.put_list(level.checksum);
  put_scan(out, header.scan);
  return out.bytes();
}

BrickHeader read_brick_header(const fs::path& path) {
  require_file(path);
  const Descriptor file = open_to_read(path);
  const std::uintmax_t size = stamp_of(file.number(), path).size;
  std::vector<std::byte> bytes(prologue_bytes);
  bytes.resize(read_at(file.number(), path, 0, bytes.data(), bytes.size()));
  const BrickPrologue prologue = get_prologue(bytes, path, size);
  check_memory(path, prologue.header_bytes);
  bytes.resize(static_cast<std::size_t>(prologue.header_bytes));
  const std::size_t got = read_at(file.number(), path, prologue.header_at, bytes.data(), bytes.size());
  ByteReader in(bytes, path.string());
  if (got < bytes.size() || crc_of(bytes) != prologue.header_checksum)
    in.damaged();
  BrickHeader header = get_header(in);
  if (header.levels.back().offsets.back() != prologue.header_at)
    in.damaged();
  return header;
}

} // namespace slicelens
