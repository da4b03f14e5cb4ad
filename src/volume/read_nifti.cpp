#include "core/errors.h"
#include "volume/file_checks.h"
#include "volume/itk_reading.h"
#include "volume/nifti_header.h"
#include "volume/readers.h"

#include <itkNiftiImageIO.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

struct GzClose {
  void operator()(gzFile_s* file) const { ::gzclose(file); }
};

/// Reads exactly `bytes` bytes, or throws.
void read_all(gzFile_s* file, const fs::path& path, std::byte* out, std::size_t bytes) {
  while (bytes > 0) {
    const unsigned piece = static_cast<unsigned>(std::min<std::size_t>(bytes, std::size_t{1} << 24));
    const int count = ::gzread(file, out, piece);
    if (count <= 0)
      throw FileError(path.string(), "ends " + std::to_string(bytes) +
                                         " bytes before the voxels do; the file is truncated or damaged");
    out += count;
    bytes -= static_cast<std::size_t>(count);
  }
}

/// slope · stored + intercept, in float, or in double where float cannot hold the stored numbers.
void rescale(Volume& volume, double slope, double intercept) {
  const bool wide =
      size_of(volume.type) > 4 || volume.type == ScalarType::u32 || volume.type == ScalarType::i32;
  const std::size_t count = voxel_count(volume) * static_cast<std::size_t>(volume.components);
  std::vector<std::byte> scaled(checked_product(count, wide ? 8 : 4, "volume"));
  visit_scalar_type(volume.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    const T* in = reinterpret_cast<const T*>(volume.voxels.data());
    for (std::size_t i = 0; i < count; ++i) {
      const double value = slope * static_cast<double>(in[i]) + intercept;
      if (wide)
        reinterpret_cast<double*>(scaled.data())[i] = value;
      else
        reinterpret_cast<float*>(scaled.data())[i] = static_cast<float>(value);
    }
  });
  volume.voxels = std::move(scaled);
  volume.type = wide ? ScalarType::f64 : ScalarType::f32;
}

Volume place_of(const NiftiHeader& header, const fs::path& path) {
  Volume volume;
  for (int axis = 0; axis < 3; ++axis) {
    volume.dims[static_cast<std::size_t>(axis)] =
        static_cast<std::size_t>(header.dims[static_cast<std::size_t>(axis)]);
    const glm::dvec3 column(header.affine[axis]);
    volume.spacing[axis] = glm::length(column);
    if (!(volume.spacing[axis] > 0)) {
      throw FileError(path.string(), "the spacing of axis " + std::to_string(axis) +
                                         " is 0; a finite number above 0 is needed");
    }
    volume.direction[axis] = column / volume.spacing[axis];
  }
  if (std::abs(glm::determinant(volume.direction)) < 1e-6)
    throw FileError(path.string(), "its axes lie in one plane; the sform or qform is damaged");
  volume.origin = glm::dvec3(header.affine[3]);
  return volume;
}

/// Axis 5 holds a vector's components, each a whole volume (nifti1.h, "dim[5]"), when there are 2 to 4 and no
/// time axis; further axes count frames.
std::size_t planes_of(const NiftiHeader& header) {
  const bool vector =
      header.dims[3] == 1 && header.dims[4] >= 2 && header.dims[4] <= 4 && header.components_in_voxel == 1;
  return vector ? static_cast<std::size_t>(header.dims[4]) : 1;
}

} // namespace

Volume read_nifti_directly(const fs::path& path, std::size_t frame, const Progress& progress) {
  const NiftiHeader header = scan_nifti(path);
  if (header.sheared)
    report_warning(progress, path.string() + ": its axes are not perpendicular (sheared); they are kept so");
  Volume volume = place_of(header, path);
  volume.type = header.stored_type;
  volume.components = header.components_in_voxel;
  volume.format = "NIfTI";
  const std::size_t planes = planes_of(header);
  for (std::size_t axis = 3; axis < 7; ++axis)
    volume.frames = checked_product(volume.frames, static_cast<std::size_t>(header.dims[axis]), "frames");
  volume.frames /= planes;
  if (frame >= volume.frames)
    throw UsageError("volume.frame is " + std::to_string(frame) + " but " + path.string() + " has " +
                     std::to_string(volume.frames) + " frame(s), counted from 0");
  const std::size_t plane_bytes = voxel_bytes(volume);
  if (planes > 1)
    volume.components = static_cast<int>(planes);
  const std::size_t bytes = voxel_bytes(volume);
  check_memory(path, bytes);
  const std::unique_ptr<gzFile_s, GzClose> file(::gzopen(header.data_file.c_str(), "rb"));
  if (!file)
    throw FileError(header.data_file.string(), "cannot be opened");
  const std::uintmax_t start = header.data_offset + static_cast<std::uintmax_t>(frame) * bytes;
  if (::gzseek(file.get(), static_cast<z_off_t>(start), SEEK_SET) < 0)
    throw FileError(header.data_file.string(), "ends before its voxels; the file is truncated or damaged");
  volume.voxels.resize(bytes);
  if (planes == 1) {
    read_all(file.get(), header.data_file, volume.voxels.data(), bytes);
  } else {
    std::vector<std::byte> plane(plane_bytes);
    const std::size_t scalar = size_of(volume.type);
    for (std::size_t p = 0; p < planes; ++p) {
      read_all(file.get(), header.data_file, plane.data(), plane_bytes);
      for (std::size_t i = 0; i < plane_bytes / scalar; ++i)
        std::memcpy(volume.voxels.data() + (i * planes + p) * scalar, plane.data() + i * scalar, scalar);
    }
  }
  // The checksum follows the last byte; asking for one more makes zlib compare it.
  std::byte beyond{};
  if (frame + 1 == volume.frames && ::gzread(file.get(), &beyond, 1) < 0)
    throw FileError(header.data_file.string(), "its compressed data are truncated or damaged (checksum)");
  if (header.swapped)
    swap_bytes(volume.voxels, size_of(volume.type));
  if (header.slope != 1 || header.intercept != 0)
    rescale(volume, header.slope, header.intercept);
  return volume;
}

Volume read_nifti(const fs::path& path, std::size_t frame, const Progress& progress) {
  Volume volume = read_nifti_directly(path, frame, progress);
  // ITK's word on where the volume lies, so that it lies where ITK's users see it. It refuses sheared axes,
  // NIfTI-2 and sforms that contradict the voxel sizes; its own reading of the voxels does not notice
  // truncated or damaged gzip data and overruns its buffer for some files with five axes.
  with_libraries(path, {}, [&] {
    const auto io = itk::NiftiImageIO::New();
    const std::string name = nifti_header_file(path).string();
    io->SetFileName(name);
    if (!io->CanReadFile(name.c_str()))
      return;
    Volume place;
    try {
      io->ReadImageInformation();
      place = header_of(*io, path);
    } catch (const std::exception&) {
      return;
    }
    if (place.dims == volume.dims) {
      volume.spacing = place.spacing;
      volume.origin = place.origin;
      volume.direction = place.direction;
    }
  });
  return volume;
}

} // namespace slicelens
