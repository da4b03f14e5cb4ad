#include "volume/on_disk.h"

#include "core/errors.h"
#include "core/text.h"
#include "volume/dicom_slices.h"
#include "volume/file_stamp.h"
#include "volume/header_scan.h"
#include "volume/nifti_header.h"
#include "volume/raw_stream.h"
#include "volume/readers.h"
#include "volume/scan.h"
#include "volume/scan_record.h"
#include "volume/volume_input.h"

#include <utility>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

OpenedVolume opened_raw(const Input& input, const VolumeSource& source, const Progress& progress) {
  OpenedVolume opened = input.kind == InputFormat::nrrd   ? open_nrrd(source.file, source.frame, progress)
                        : input.kind == InputFormat::meta ? open_meta(source.file, source.frame, progress)
                                                          : open_raw(source);
  check_frame(opened.volume, source);
  if (source.component)
    check_component(opened.volume, *source.component);
  return opened;
}

bool holds_raw(InputFormat kind) {
  return kind == InputFormat::raw || kind == InputFormat::nrrd || kind == InputFormat::meta;
}

bool streams(const OpenedVolume& opened, const VolumeSource& source) {
  return opened.layout && opened.layout->step[0] <= most_row_step &&
         (opened.volume.components == 1 || source.component);
}

Volume nifti_outline(const fs::path& file) {
  const NiftiHeader header = scan_nifti(file);
  Volume volume;
  for (std::size_t axis = 0; axis < 3; ++axis)
    volume.dims[axis] = static_cast<std::size_t>(header.dims[axis]);
  for (std::size_t axis = 3; axis < 7; ++axis)
    volume.frames *= static_cast<std::size_t>(header.dims[axis]);
  volume.components = header.components_in_voxel;
  volume.type = header.stored_type;
  if (header.slope != 1 || header.intercept != 0)
    volume.type = size_of(header.stored_type) > 2 ? ScalarType::f64 : ScalarType::f32;
  volume.format = "NIfTI";
  return volume;
}

/// The volume with its stream and what is to be known of its voxels.
Volume with_scan(Volume volume, std::unique_ptr<const VoxelStream> stream, const std::string& where,
                 const std::string& identity, int threads, ScanKeeping keeping, const Progress& progress) {
  std::optional<KeptScan> kept = kept_scan(identity, volume.dims, progress);
  if (!kept || kept->type != volume.type) {
    kept = KeptScan{volume.type, scan_voxels(*stream, volume, threads, progress)};
    if (keeping == ScanKeeping::keep)
      keep_scan(identity, *kept, progress);
  }
  set_statistics(volume, kept->scan);
  auto streamed = std::make_shared<StreamedVoxels>();
  streamed->stream = std::move(stream);
  streamed->cells = std::move(kept->scan.cells);
  streamed->samples = std::move(kept->scan.samples);
  streamed->where = where;
  volume.streamed = std::move(streamed);
  return volume;
}

} // namespace

std::optional<VolumeOutline> outline_of(const VolumeSource& source, const Progress& progress) {
  const Input input = resolve(source);
  if (input.kind != InputFormat::raw)
    refuse_raw_keys(source);
  VolumeOutline outline;
  if (holds_raw(input.kind)) {
    OpenedVolume opened = opened_raw(input, source, progress);
    outline.streams = streams(opened, source);
    outline.volume = std::move(opened.volume);
  } else if (input.kind == InputFormat::nifti) {
    outline.volume = nifti_outline(source.file);
  } else if (input.kind == InputFormat::vtk) {
    scan_vtk(source.file, outline.volume);
  } else if (input.kind == InputFormat::dicom) {
    const DicomStack stack = dicom_stack(input.files, input.named, source, saying_once(progress));
    outline.volume = dicom_outline(stack, {});
    outline.streams = is_sliced(stack) && outline.volume.components == 1;
  } else {
    return std::nullopt;
  }
  apply_spacing(outline.volume, source);
  return outline;
}

namespace {

std::optional<Volume> stream_dicom(const Input& input, const VolumeSource& source, const Progress& caller,
                                   ScanKeeping keeping) {
  const Progress progress = saying_once(caller);
  const DicomStack stack = dicom_stack(input.files, input.named, source, progress);
  std::vector<fs::path> files;
  for (const DicomFile& slice : stack.slices)
    files.push_back(slice.file);
  const std::string identity = stamps_text(files) + choice_text(source);
  if (!is_sliced(stack))
    return std::nullopt;
  Volume volume = dicom_outline(stack, progress);
  check_frame(volume, source);
  if (source.component)
    check_component(volume, *source.component);
  if (volume.components > 1)
    return std::nullopt;
  const std::optional<KeptScan> kept = kept_scan(identity, volume.dims, {});
  volume.type = kept ? kept->type : dicom_type(stack, volume.components, progress);
  apply_spacing(volume, source);
  auto stream = dicom_stream(stack, volume.type);
  // One thread: slices are decoded one at a time, and what the decoder prints must not meet what others do.
  return with_scan(std::move(volume), std::move(stream), "stream: " + source.file.string(), identity, 1,
                   keeping, progress);
}

} // namespace

std::optional<Volume> stream_volume(const VolumeSource& source, const Progress& progress,
                                    ScanKeeping keeping) {
  report_progress(progress, "load", 0);
  const Input input = resolve(source);
  if (input.kind == InputFormat::dicom) {
    refuse_raw_keys(source);
    return stream_dicom(input, source, progress, keeping);
  }
  if (!holds_raw(input.kind))
    return std::nullopt;
  if (input.kind != InputFormat::raw)
    refuse_raw_keys(source);
  const std::string identity = stamps_text(files_of(source)) + choice_text(source);
  OpenedVolume opened = opened_raw(input, source, progress);
  if (!streams(opened, source))
    return std::nullopt;
  auto stream = raw_stream(opened, source.component.value_or(0));
  Volume volume = std::move(opened.volume);
  volume.components = 1;
  apply_spacing(volume, source);
  volume = with_scan(std::move(volume), std::move(stream), "stream: " + source.file.string(), identity, 0,
                     keeping, progress);
  report_progress(progress, "load", 1);
  return volume;
}

} // namespace slicelens
