#include "volume/read.h"

#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"
#include "volume/header_scan.h"
#include "volume/nifti_header.h"
#include "volume/nrrd_header.h"
#include "volume/readers.h"
#include "volume/volume_input.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

void keep_component(Volume& volume, int component) {
  check_component(volume, component);
  if (volume.components == 1)
    return;
  const std::size_t scalar = size_of(volume.type);
  const std::size_t stride = scalar * static_cast<std::size_t>(volume.components);
  const std::size_t count = voxel_count(volume);
  std::byte* const voxels = volume.voxels.data();
  for (std::size_t i = 0; i < count; ++i)
    std::memmove(voxels + i * scalar, voxels + i * stride + static_cast<std::size_t>(component) * scalar,
                 scalar);
  volume.voxels.resize(count * scalar);
  volume.voxels.shrink_to_fit();
  volume.components = 1;
}

Volume read_input(const VolumeSource& source, const Input& input, const Progress& progress) {
  switch (input.kind) {
  case InputFormat::nrrd:
    return read_nrrd(source.file, source.frame, progress);
  case InputFormat::meta:
    return read_meta(source.file, source.frame, progress);
  case InputFormat::nifti:
    return read_nifti(source.file, source.frame, progress);
  case InputFormat::vtk:
    return read_vtk(source.file, source.frame, progress);
  case InputFormat::vti:
    return read_vti(source.file, progress);
  case InputFormat::images:
    return read_images(input.files, progress);
  case InputFormat::dicom:
    return read_dicom(input.files, input.named, source, progress);
  case InputFormat::raw:
    break;
  }
  return read_raw(source, progress);
}

} // namespace

Volume read_volume(const VolumeSource& source, const Progress& progress) {
  report_progress(progress, "load", 0);
  const Input input = resolve(source);
  if (input.kind != InputFormat::raw)
    refuse_raw_keys(source);
  Volume volume = read_input(source, input, progress);
  check_frame(volume, source);
  if (source.component)
    keep_component(volume, *source.component);
  apply_spacing(volume, source);
  update_statistics(volume);
  report_progress(progress, "load", 1);
  return volume;
}

bool has_ras_displacements(const fs::path& file) {
  constexpr int displacement_vectors = 1006; // nifti1.h, NIFTI_INTENT_DISPVECT
  VolumeSource source;
  source.file = file;
  return format_of(source, file) == InputFormat::nifti && scan_nifti(file).intent == displacement_vectors;
}

std::vector<fs::path> files_of(const VolumeSource& source) {
  const Input input = resolve(source);
  std::vector<fs::path> files = {source.file};
  std::vector<fs::path> data;
  switch (input.kind) {
  case InputFormat::nrrd:
    data = parse_nrrd(source.file).data_files;
    break;
  case InputFormat::meta:
    data = scan_meta(source.file).data_files;
    break;
  case InputFormat::nifti: {
    const NiftiHeader header = scan_nifti(source.file);
    files = {nifti_header_file(source.file)};
    if (header.pair)
      data = {header.data_file};
    break;
  }
  case InputFormat::images:
    return input.files;
  case InputFormat::dicom:
    return dicom_files(input.files, input.named, source, {});
  case InputFormat::vtk:
  case InputFormat::vti:
  case InputFormat::raw:
    break;
  }
  files.insert(files.end(), data.begin(), data.end());
  return files;
}

} // namespace slicelens
