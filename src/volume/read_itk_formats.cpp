#include "core/errors.h"
#include "volume/header_scan.h"
#include "volume/itk_reading.h"
#include "volume/readers.h"

#include <itkMetaImageIO.h>
#include <itkVTKImageIO.h>

#include <algorithm>
#include <cstring>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// ITK says what the header means. Raw data of any layout are its to read too; compressed data and text,
/// whose damage it does not notice, and frames are read here.
Volume read_with(itk::ImageIOBase& io, const fs::path& path, std::size_t frame, const std::string& format,
                 const HeaderScan& scan, bool itk_reads_raw, const Progress& progress) {
  Volume volume;
  with_libraries(path, progress, [&] {
    io.SetFileName(path.string());
    io.ReadImageInformation();
    volume = header_of(io, path);
    volume.format = format;
    if (scan.encoding == Encoding::raw && itk_reads_raw) {
      read_frame(io, path, frame, volume);
      return;
    }
    if (frame >= volume.frames)
      throw UsageError("volume.frame is " + std::to_string(frame) + " but " + path.string() + " has " +
                       std::to_string(volume.frames) + " frame(s), counted from 0");
    const std::size_t bytes = voxel_bytes(volume);
    const std::size_t all = checked_product(bytes, volume.frames, path.string());
    check_memory(path, all);
    volume.voxels.resize(all);
    read_voxels(path, scan, volume);
    volume.voxels.erase(volume.voxels.begin(),
                        volume.voxels.begin() + static_cast<std::ptrdiff_t>(frame * bytes));
    volume.voxels.resize(bytes);
  });
  return volume;
}

} // namespace

Volume read_meta(const fs::path& path, std::size_t frame, const Progress& progress) {
  return read_with(*itk::MetaImageIO::New(), path, frame, "MetaImage", scan_meta(path), true, progress);
}

Volume read_vtk(const fs::path& path, std::size_t frame, const Progress& progress) {
  return read_with(*itk::VTKImageIO::New(), path, frame, "VTK", scan_vtk(path), false, progress);
}

} // namespace slicelens
