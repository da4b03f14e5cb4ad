#include "core/errors.h"
#include "volume/file_checks.h"
#include "volume/itk_reading.h"
#include "volume/jpeg_slice.h"
#include "volume/png_slice.h"
#include "volume/readers.h"

#include <itkTIFFImageIO.h>

#include <algorithm>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// One image file; ITK reads TIFF.
class SliceFile {
public:
  SliceFile(const std::string& kind, const fs::path& file) : file_(file), is_png_(kind == "PNG") {
    const std::uintmax_t bytes = require_file(file);
    if (kind == "TIFF")
      io_ = itk::TIFFImageIO::New().GetPointer();
    if (io_) {
      io_->SetFileName(file.string());
      io_->ReadImageInformation();
    }
    header_ = io_ ? header_of(*io_, file) : is_png_ ? png_header(file) : jpeg_header(file);
    check_claim(file, "size", voxel_bytes(header_), bytes, Encoding::codec);
  }

  const Volume& header() const { return header_; }

  /// Writes voxel_bytes(header()) bytes.
  void read(std::byte* out) {
    if (!io_) {
      is_png_ ? read_png(file_, out) : read_jpeg(file_, out);
      return;
    }
    itk::ImageIORegion region(io_->GetNumberOfDimensions());
    for (unsigned axis = 0; axis < io_->GetNumberOfDimensions(); ++axis) {
      region.SetIndex(axis, 0);
      region.SetSize(axis, io_->GetDimensions(axis));
    }
    io_->SetIORegion(region);
    io_->Read(out);
  }

private:
  fs::path file_;
  bool is_png_;
  itk::ImageIOBase::Pointer io_;
  Volume header_;
};

std::string shape_text(const Volume& v) {
  return std::to_string(v.dims[0]) + " x " + std::to_string(v.dims[1]) + " " + name_of(v.type) + " with " +
         std::to_string(v.components) + " component(s)";
}

} // namespace

std::string image_kind(const fs::path& path) {
  const std::string head = head_of(path, 8);
  if (head.rfind("\x89PNG\r\n\x1a\n", 0) == 0)
    return "PNG";
  const std::string mark = head.substr(0, 4);
  if (mark == std::string("II*\0", 4) || mark == std::string("MM\0*", 4) || mark == std::string("II+\0", 4) ||
      mark == std::string("MM\0+", 4))
    return "TIFF";
  if (head.rfind("\xff\xd8\xff", 0) == 0)
    return "JPEG";
  return "";
}

Volume read_images(const std::vector<fs::path>& files, const Progress& progress) {
  const std::string kind = image_kind(files.front());
  Volume volume;
  std::size_t slice_bytes = 0;
  for (std::size_t k = 0; k < files.size(); ++k) {
    const fs::path& file = files[k];
    require_file(file);
    if (image_kind(file) != kind)
      throw FileError(file.string(), "is no " + kind + " image as " + files.front().filename().string() +
                                         " before it is; a stack holds one kind");
    with_libraries(file, progress, [&] {
      SliceFile slice(kind, file);
      const Volume& image = slice.header();
      if (k == 0) {
        volume = image;
        slice_bytes = voxel_bytes(image);
        const std::size_t bytes = checked_product(slice_bytes, files.size(), file.string());
        check_memory(file, bytes);
        if (files.size() > 1) {
          volume.dims[2] = files.size();
          volume.voxels.resize(bytes);
        }
      }
      if (files.size() > 1 && image.dims[2] != 1)
        throw FileError(file.string(),
                        "has " + std::to_string(image.dims[2]) +
                            " pages; name it alone, or use one page for each slice of a stack");
      if (image.dims[0] != volume.dims[0] || image.dims[1] != volume.dims[1] || image.type != volume.type ||
          image.components != volume.components)
        throw FileError(file.string(), "is " + shape_text(image) + " but " +
                                           files.front().filename().string() + " is " + shape_text(volume) +
                                           "; a stack needs images of one size");
      if (files.size() == 1)
        volume.voxels.resize(slice_bytes);
      slice.read(volume.voxels.data() + k * slice_bytes);
    });
    report_progress(progress, "load", static_cast<double>(k + 1) / static_cast<double>(files.size()));
  }
  // Resolutions in image files are print sizes (dots per inch), not voxel distances, and many images carry
  // none: a stack has spacing 1 unless the scene says otherwise.
  volume.spacing = glm::dvec3(1);
  volume.origin = glm::dvec3(0);
  volume.direction = glm::dmat3(1);
  volume.format = kind + " stack";
  return volume;
}

} // namespace slicelens
