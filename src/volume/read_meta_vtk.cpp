#include "core/errors.h"
#include "volume/file_checks.h"
#include "volume/header_scan.h"
#include "volume/itk_reading.h"
#include "volume/readers.h"

#include <itkMetaImageIO.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

void check_frame(const fs::path& path, std::size_t frame, const Volume& volume) {
  if (frame >= volume.frames)
    throw UsageError("volume.frame is " + std::to_string(frame) + " but " + path.string() + " has " +
                     std::to_string(volume.frames) + " frame(s), counted from 0");
}

/// ITK's word on a header, without voxels.
Volume described(itk::MetaImageIO& io, const fs::path& path, const HeaderScan& scan) {
  io.SetFileName(path.string());
  io.ReadImageInformation();
  Volume volume = header_of(io, path);
  volume.format = "MetaImage";
  if (checked_product(voxel_bytes(volume), volume.frames, path.string()) != scan.claimed)
    throw FileError(path.string(), "its header can be read in two ways ('DimSize', 'ElementType' or "
                                   "'ElementNumberOfChannels' twice, for instance)");
  return volume;
}

/// Where raw voxels start in a file of `size` bytes; nothing where MetaIO's reading of the header is not
/// sure.
std::optional<std::uintmax_t> start_of(const HeaderScan& scan, std::uintmax_t size) {
  if (scan.header_size == 0)
    return scan.offset;
  if (scan.header_size < 0)
    return size - std::min(size, scan.in_each_file);
  return scan.data_files.empty() ? std::nullopt
                                 : std::optional(static_cast<std::uintmax_t>(scan.header_size));
}

} // namespace

OpenedVolume open_meta(const fs::path& path, std::size_t frame, const Progress& progress) {
  const HeaderScan scan = scan_meta(path);
  OpenedVolume opened;
  with_libraries(path, progress, [&] {
    const auto io = itk::MetaImageIO::New();
    opened.volume = described(*io, path, scan);
  });
  const Volume& volume = opened.volume;
  check_frame(path, frame, volume);
  if (scan.encoding != Encoding::raw || scan.in_each_file == 0)
    return opened;
  RawLayout layout;
  for (const fs::path& file : scan.data_files.empty() ? std::vector<fs::path>{path} : scan.data_files) {
    const std::uintmax_t size = fs::file_size(file);
    const auto start = start_of(scan, size);
    if (!start || *start > size || size - *start < scan.in_each_file)
      return opened;
    layout.pieces.push_back({file, *start, scan.in_each_file});
  }
  const auto components = static_cast<std::uintmax_t>(volume.components);
  layout.first = frame * voxel_bytes(volume) / size_of(volume.type);
  layout.step = {components, components * volume.dims[0], components * volume.dims[0] * volume.dims[1]};
  layout.swapped = scan.big_endian != (std::endian::native == std::endian::big);
  opened.layout = std::move(layout);
  return opened;
}

/// ITK says what the header means. Raw data of any layout are its to read too; compressed data and text,
/// whose damage it does not notice, and frames are read here.
Volume read_meta(const fs::path& path, std::size_t frame, const Progress& progress) {
  const HeaderScan scan = scan_meta(path);
  Volume volume;
  with_libraries(path, progress, [&] {
    const auto io = itk::MetaImageIO::New();
    volume = described(*io, path, scan);
    const std::size_t bytes = voxel_bytes(volume);
    const std::size_t all = bytes * volume.frames;
    if (scan.encoding == Encoding::raw) {
      read_frame(*io, path, frame, volume);
      return;
    }
    check_frame(path, frame, volume);
    check_memory(path, all);
    volume.voxels.resize(all);
    read_voxels(path, scan, volume);
    volume.voxels.erase(volume.voxels.begin(),
                        volume.voxels.begin() + static_cast<std::ptrdiff_t>(frame * bytes));
    volume.voxels.resize(bytes);
  });
  return volume;
}

Volume read_vtk(const fs::path& path, std::size_t frame, const Progress&) {
  Volume volume;
  volume.format = "VTK";
  const HeaderScan scan = scan_vtk(path, volume);
  check_frame(path, frame, volume);
  check_memory(path, scan.claimed);
  volume.voxels.resize(voxel_bytes(volume));
  read_voxels(path, scan, volume);
  return volume;
}

} // namespace slicelens
