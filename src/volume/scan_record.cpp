#include "volume/scan_record.h"

#include "core/files.h"
#include "volume/file_checks.h"
#include "volume/file_stamp.h"
#include "volume/read.h"

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t magic = 0x316e616373636c73; // "slcscan1" on a little-endian machine

fs::path place_of(const std::string& identity) {
  const fs::path folder = user_cache();
  return folder.empty() ? folder : folder / (sha256_of_text(identity).substr(0, 40) + ".scan");
}

/// The file's payload, whose checksum fits. Throws FileError.
std::vector<std::byte> payload_of(const fs::path& path) {
  const Descriptor file = open_to_read(path);
  const std::uintmax_t size = stamp_of(file.number(), path).size;
  constexpr std::size_t head = sizeof magic + sizeof(std::uint32_t);
  check_memory(path, size);
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  if (size < head || read_at(file.number(), path, 0, bytes.data(), bytes.size()) < bytes.size())
    throw FileError(path.string(), "is truncated");
  ByteReader in(bytes, path.string());
  const bool known = in.get<std::uint64_t>() == magic;
  if (!known || in.get<std::uint32_t>() != crc_of(std::span(bytes).subspan(head)))
    throw FileError(path.string(), "is damaged");
  bytes.erase(bytes.begin(), bytes.begin() + head);
  return bytes;
}

} // namespace

void put_scan(ByteWriter& out, const VoxelScan& scan) {
  out.put(scan.min);
  out.put(scan.max);
  out.put(scan.mean);
  out.put(static_cast<std::uint64_t>(scan.non_finite));
  out.put(static_cast<std::uint64_t>(scan.cells.reach));
  out.put_list(scan.cells.smallest);
  out.put_list(scan.cells.largest);
  out.put_list(scan.samples);
}

VoxelScan get_scan(ByteReader& in, const std::array<std::size_t, 3>& dims) {
  VoxelScan scan;
  scan.min = in.get<double>();
  scan.max = in.get<double>();
  scan.mean = in.get<double>();
  scan.non_finite = static_cast<std::size_t>(in.get<std::uint64_t>());
  scan.cells.reach = static_cast<std::size_t>(in.get<std::uint64_t>());
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scan.cells.size[axis] = dims[axis] / cell_edge + (dims[axis] % cell_edge > 0 ? 1 : 0);
    count = checked_product(count, scan.cells.size[axis], "volume");
  }
  scan.cells.smallest = in.get_list<float>();
  scan.cells.largest = in.get_list<float>();
  scan.samples = in.get_list<double>();
  if (!(scan.min <= scan.max) || scan.cells.reach != scan_reach || scan.cells.smallest.size() != count ||
      scan.cells.largest.size() != count)
    in.damaged();
  return scan;
}

std::uint32_t crc_of(std::span<const std::byte> bytes) {
  return static_cast<std::uint32_t>(::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

fs::path user_cache() {
  const char* const own = std::getenv("XDG_CACHE_HOME");
  if (own != nullptr && *own == '/') // the specification: relative ones are ignored
    return fs::path(own) / "slicelens";
  const char* const home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? fs::path(home) / ".cache" / "slicelens" : fs::path();
}

std::string choice_text(const VolumeSource& source) {
  std::string text = "frame " + std::to_string(source.frame) + "\ncomponent " +
                     std::to_string(source.component.value_or(0)) + "\nseries " + source.series + "\n";
  if (source.size) {
    for (const std::size_t n : *source.size)
      text += std::to_string(n) + " ";
  }
  text += source.type ? name_of(*source.type) : "";
  return text + (source.big_endian.value_or(false) ? " big\n" : "\n");
}

std::optional<KeptScan> kept_scan(const std::string& identity, const std::array<std::size_t, 3>& dims,
                                  const Progress& progress) {
  const fs::path path = place_of(identity);
  std::error_code error;
  if (path.empty() || !fs::is_regular_file(path, error))
    return std::nullopt;
  try {
    const std::vector<std::byte> bytes = payload_of(path);
    ByteReader in(bytes, path.string());
    if (in.get_text() != identity)
      in.damaged();
    const auto type = in.get<std::uint8_t>();
    if (type > static_cast<std::uint8_t>(ScalarType::f64))
      in.damaged();
    KeptScan kept{static_cast<ScalarType>(type), get_scan(in, dims)};
    if (!in.at_end())
      in.damaged();
    return kept;
  } catch (const Error& problem) {
    report_warning(progress, std::string(problem.what()) + "; it is made again");
    return std::nullopt;
  }
}

void keep_scan(const std::string& identity, const KeptScan& kept, const Progress& progress) {
  const fs::path path = place_of(identity);
  if (path.empty())
    return;
  ByteWriter payload;
  payload.put_text(identity);
  payload.put(static_cast<std::uint8_t>(kept.type));
  put_scan(payload, kept.scan);
  ByteWriter head;
  head.put(magic);
  head.put(crc_of(payload.bytes()));
  try {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    write_atomically(path, [&](const fs::path& temporary) {
      std::ofstream out(temporary, std::ios::binary);
      for (const ByteWriter* part : {&head, &payload})
        out.write(reinterpret_cast<const char*>(part->bytes().data()),
                  static_cast<std::streamsize>(part->bytes().size()));
      out.close();
      if (!out)
        throw FileError(path.string(), "cannot be written in full");
    });
  } catch (const Error& problem) {
    report_warning(progress,
                   std::string(problem.what()) + " (the next run reads the whole volume once more)");
  }
}

} // namespace slicelens
