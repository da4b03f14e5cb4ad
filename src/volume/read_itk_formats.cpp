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

Volume read_with(itk::ImageIOBase& io, const fs::path& path, std::size_t frame, const std::string& format,
                 const Progress& progress) {
  Volume volume;
  with_libraries(path, progress, [&] {
    io.SetFileName(path.string());
    io.ReadImageInformation();
    volume = header_of(io, path);
    volume.format = format;
    read_frame(io, path, frame, volume);
  });
  return volume;
}

} // namespace

Volume read_meta(const fs::path& path, std::size_t frame, const Progress& progress) {
  scan_meta(path);
  return read_with(*itk::MetaImageIO::New(), path, frame, "MetaImage", progress);
}

Volume read_vtk(const fs::path& path, std::size_t frame, const Progress& progress) {
  scan_vtk(path);
  return read_with(*itk::VTKImageIO::New(), path, frame, "VTK", progress);
}

} // namespace slicelens
