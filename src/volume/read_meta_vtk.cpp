#include "core/errors.h"
#include "volume/file_checks.h"
#include "volume/header_scan.h"
#include "volume/itk_reading.h"
#include "volume/readers.h"

#include <itkMetaImageIO.h>

#include <algorithm>
#include <cstring>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

void check_frame(const fs::path& path, std::size_t frame, const Volume& volume) {
  if (frame >= volume.frames)
    throw UsageError("volume.frame is " + std::to_string(frame) + " but " + path.string() + " has " +
                     std::to_string(volume.frames) + " frame(s), counted from 0");
}

} // namespace

/// ITK says what the header means. Raw data of any layout are its to read too; compressed data and text,
/// whose damage it does not notice, and frames are read here.
Volume read_meta(const fs::path& path, std::size_t frame, const Progress& progress) {
  const HeaderScan scan = scan_meta(path);
  Volume volume;
  with_libraries(path, progress, [&] {
    const auto io = itk::MetaImageIO::New();
    io->SetFileName(path.string());
    io->ReadImageInformation();
    volume = header_of(*io, path);
    volume.format = "MetaImage";
    const std::size_t bytes = voxel_bytes(volume);
    const std::size_t all = checked_product(bytes, volume.frames, path.string());
    if (all != scan.claimed)
      throw FileError(path.string(), "its header can be read in two ways ('DimSize', 'ElementType' or "
                                     "'ElementNumberOfChannels' twice, for instance)");
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
