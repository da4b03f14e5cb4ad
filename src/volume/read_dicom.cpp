#include "core/errors.h"
#include "core/text.h"
#include "volume/dicom_header.h"
#include "volume/dicom_series.h"
#include "volume/dicom_slices.h"
#include "volume/file_checks.h"
#include "volume/readers.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// Backslash-separated numbers of a text element; empty when one is none.
std::vector<double> numbers_at(const DicomHeader& header, std::uint32_t tag) {
  std::string text = header.text(tag);
  std::replace(text.begin(), text.end(), '\\', ' ');
  try {
    return numbers_of({}, "number", text);
  } catch (const FileError&) {
    return {};
  }
}

long long whole_at(const DicomHeader& header, std::uint32_t tag, long long other) {
  const std::vector<double> values = numbers_at(header, tag);
  return values.empty() || !(std::abs(values[0]) < 1e15) ? other : static_cast<long long>(values[0]);
}

bool all_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

void place_slice(Volume& volume, std::size_t k, Volume& slice, const fs::path& file) {
  require_components(slice, volume.components, file);
  if (slice.type != volume.type) {
    const ScalarType common = type_for_both(volume.type, slice.type);
    if (common != volume.type) {
      volume.voxels = converted(volume.voxels, volume.type, common);
      volume.type = common;
    }
    if (common != slice.type)
      slice.voxels = converted(slice.voxels, slice.type, common);
  }
  std::copy(slice.voxels.begin(), slice.voxels.end(),
            volume.voxels.begin() + static_cast<std::ptrdiff_t>(k * slice.voxels.size()));
}

/// GDCM asserts on pixel descriptions that cannot be, so they are refused here.
void check_pixels(const fs::path& path, const DicomHeader& header, const DicomFile& file) {
  const std::size_t samples = header.number(0x00280002, 1);
  const std::size_t bits = header.number(0x00280100, 0);
  const std::size_t stored = header.number(0x00280101, bits);
  const std::size_t high = header.number(0x00280102, stored - 1);
  if (samples < 1 || samples > 4)
    throw FileError(path.string(),
                    "'Samples per Pixel' is " + std::to_string(samples) + "; 1 to 4 are supported");
  if (bits != 1 && bits != 8 && bits != 12 && bits != 16 && bits != 32 && bits != 64)
    throw FileError(path.string(),
                    "'Bits Allocated' is " + std::to_string(bits) + "; 8, 16 or 32 are supported");
  if (stored < 1 || stored > bits || high >= bits || high + 1 < stored)
    throw FileError(path.string(), "'Bits Stored' is " + std::to_string(stored) + " and 'High Bit' " +
                                       std::to_string(high) + " in " + std::to_string(bits) +
                                       " allocated bits");
  if (header.number(0x00280103, 0) > 1)
    throw FileError(path.string(), "'Pixel Representation' is neither 0 nor 1");
  for (const std::uint32_t tag : {0x00281052u, 0x00281053u}) {
    const std::vector<double> values = numbers_at(header, tag);
    if (!header.text(tag).empty() && (values.size() != 1 || !std::isfinite(values[0])))
      throw FileError(path.string(),
                      "'Rescale' holds '" + one_line(header.text(tag)) + "'; one number is needed");
  }
  const std::uintmax_t claimed =
      claimed_bytes(path, "Rows, Columns, Number of Frames",
                    {static_cast<long long>(file.rows), static_cast<long long>(file.columns),
                     static_cast<long long>(file.frames), static_cast<long long>(samples)},
                    bits) /
      8;
  check_claim(path, "Rows, Columns, Number of Frames", claimed, header.pixel_bytes,
              header.encapsulated ? Encoding::codec : Encoding::raw);
}

std::vector<DicomFile> scan_all(const std::vector<fs::path>& candidates, const fs::path& named,
                                const Progress& progress) {
  std::vector<DicomFile> files;
  for (const fs::path& candidate : candidates) {
    try {
      files.push_back(scan_dicom(candidate));
    } catch (const FileError& error) {
      if (candidate == named || candidates.size() == 1)
        throw;
      report_warning(progress, std::string(error.what()) + " (left out)");
    }
  }
  return files;
}

std::string name_of_source(const VolumeSource& source) { return source.file.string(); }

} // namespace

namespace {

/// What the functional groups of an enhanced file say of its frames.
void read_groups(const fs::path& path, const DicomHeader& header, DicomFile& file) {
  const auto values = [&](std::uint32_t tag, std::size_t count) {
    std::vector<std::vector<double>> lists;
    const auto found = header.frame_values.find(tag);
    if (found == header.frame_values.end())
      return lists;
    for (std::string text : found->second) {
      std::replace(text.begin(), text.end(), '\\', ' ');
      text.erase(std::remove(text.begin(), text.end(), '\0'), text.end());
      std::vector<double> numbers = numbers_of(path, "functional groups", text);
      if (numbers.size() != count || !all_finite(numbers))
        throw FileError(path.string(), "its functional groups hold '" + one_line(text) + "'; " +
                                           std::to_string(count) + " finite numbers are needed");
      lists.push_back(std::move(numbers));
    }
    return lists;
  };
  const auto axes = values(0x00200037, 6);
  for (const std::vector<double>& a : axes) {
    const glm::dmat2x3 own(a[0], a[1], a[2], a[3], a[4], a[5]);
    if (file.axes &&
        (glm::length(own[0] - (*file.axes)[0]) > 1e-2 || glm::length(own[1] - (*file.axes)[1]) > 1e-2))
      throw FileError(path.string(),
                      "its frames have different Image Orientations; such frames form no volume");
    if (!(std::abs(glm::length(glm::cross(own[0], own[1])) - 1) < 0.1))
      throw FileError(path.string(), "'Image Orientation (Patient)' holds no two perpendicular unit vectors");
    file.axes = own;
  }
  const auto spacings = values(0x00280030, 2);
  if (!spacings.empty() && spacings[0][0] > 0 && spacings[0][1] > 0)
    file.pixel_spacing = glm::dvec2(spacings[0][1], spacings[0][0]); // rows first in the file
  const auto positions = values(0x00200032, 3);
  if (positions.size() == file.frames) {
    for (const std::vector<double>& p : positions)
      file.frame_positions.emplace_back(p[0], p[1], p[2]);
  }
}

/// The pictures of one enhanced file in the stack's order.
Volume read_enhanced(const DicomStack& stack, const Progress& progress) {
  Volume all = read_one(stack.slices.front(), progress);
  const std::size_t slice_bytes = voxel_bytes(all) / all.dims[2];
  Volume volume = all;
  volume.format = "DICOM";
  volume.frames = stack.frames;
  volume.dims[2] = stack.slices.size();
  volume.voxels.assign(slice_bytes * stack.slices.size(), {});
  for (std::size_t k = 0; k < stack.slices.size(); ++k) {
    const std::size_t index = stack.slices[k].index;
    if (index >= all.dims[2])
      throw FileError(stack.slices[k].file.string(),
                      "has fewer pictures than positions; the file is damaged");
    std::copy_n(all.voxels.begin() + static_cast<std::ptrdiff_t>(index * slice_bytes), slice_bytes,
                volume.voxels.begin() + static_cast<std::ptrdiff_t>(k * slice_bytes));
  }
  const DicomFile& first = stack.slices.front();
  volume.origin = *first.position;
  volume.direction[0] = glm::normalize((*first.axes)[0]);
  volume.direction[1] = glm::normalize((*first.axes)[1]);
  volume.direction[2] = stack.axis.value_or(glm::normalize(glm::cross((*first.axes)[0], (*first.axes)[1])));
  volume.spacing.z = stack.spacing.value_or(1);
  if (first.pixel_spacing) {
    volume.spacing.x = first.pixel_spacing->x;
    volume.spacing.y = first.pixel_spacing->y;
  }
  return volume;
}

} // namespace

DicomStack dicom_stack(const std::vector<fs::path>& candidates, const fs::path& named,
                       const VolumeSource& source, const Progress& progress) {
  return stack_of(scan_all(candidates, named, progress), named, name_of_source(source), source.series,
                  source.frame, progress);
}

bool is_dicom(const fs::path& path) {
  const std::string head = head_of(path, 132);
  if (head.size() == 132 && head.compare(128, 4, "DICM") == 0)
    return true;
  // Without the preamble only a file whose name suggests DICOM and which starts with a low group is tried.
  const std::string extension = lower(path.extension().string());
  const bool named = extension.empty() || extension == ".dcm" || extension == ".ima";
  return named && head.size() >= 8 && (head[0] == 2 || head[0] == 8) && head[1] == 0 && head[3] == 0;
}

DicomFile scan_dicom(const fs::path& path) {
  const DicomHeader header = scan_dicom_structure(path);
  DicomFile file;
  file.file = path;
  file.series = header.text(0x0020000e);
  file.description = one_line(header.text(0x0008103e));
  file.instance = header.text(0x00080018);
  file.mosaic = header.text(0x00080008).find("MOSAIC") != std::string::npos;
  file.rows = header.number(0x00280010, 0);
  file.columns = header.number(0x00280011, 0);
  if (file.rows == 0 || file.columns == 0 || !header.has_pixels)
    throw FileError(path.string(), "holds no image (no Rows, Columns or pixel data); name a DICOM image");
  const long long frames = whole_at(header, 0x00280008, 1);
  if (frames < 1)
    throw FileError(path.string(),
                    "'Number of Frames' is " + std::to_string(frames) + "; at least 1 is needed");
  file.frames = static_cast<std::size_t>(frames);
  file.temporal = whole_at(header, 0x00200100, 0);
  file.acquisition = whole_at(header, 0x00200012, 0);
  file.number = whole_at(header, 0x00200013, 0);
  const std::vector<double> position = numbers_at(header, 0x00200032);
  const std::vector<double> axes = numbers_at(header, 0x00200037);
  if (position.size() == 3 && all_finite(position))
    file.position = glm::dvec3(position[0], position[1], position[2]);
  if (axes.size() == 6 && all_finite(axes)) {
    file.axes = glm::dmat2x3(axes[0], axes[1], axes[2], axes[3], axes[4], axes[5]);
    const glm::dvec3 normal = glm::cross((*file.axes)[0], (*file.axes)[1]);
    if (!(std::abs(glm::length(normal) - 1) < 0.1))
      throw FileError(path.string(), "'Image Orientation (Patient)' holds no two perpendicular unit vectors");
  }
  if (file.frames > 1)
    read_groups(path, header, file);
  check_pixels(path, header, file);
  return file;
}

std::vector<fs::path> dicom_files(const std::vector<fs::path>& candidates, const fs::path& named,
                                  const VolumeSource& source, const Progress& progress) {
  const DicomStack stack = dicom_stack(candidates, named, source, progress);
  if (stack.one_file)
    return {stack.slices.front().file};
  std::vector<fs::path> files;
  for (const DicomFile& slice : stack.slices)
    files.push_back(slice.file);
  return files;
}

Volume read_dicom(const std::vector<fs::path>& candidates, const fs::path& named, const VolumeSource& source,
                  const Progress& caller) {
  const Progress progress = saying_once(caller);
  const DicomStack stack = dicom_stack(candidates, named, source, progress);
  if (stack.one_file)
    return read_enhanced(stack, progress);
  const std::size_t count = stack.slices.size();
  if (count == 1 && stack.slices.front().frames > 1)
    report_warning(
        progress,
        source.file.string() +
            ": its frames have no positions; they are slices in order at distance 1 (volume.spacing "
            "gives another)");
  Volume volume = read_one(stack.slices.front(), progress);
  const std::size_t slice_bytes = voxel_bytes(volume);
  place_stack(volume, stack);
  if (count == 1)
    return volume;
  check_memory(source.file, checked_product(slice_bytes, count, source.file.string()));
  volume.voxels.resize(slice_bytes * count);
  for (std::size_t k = 1; k < count; ++k) {
    Volume slice = read_one(stack.slices[k], progress);
    place_slice(volume, k, slice, stack.slices[k].file);
    report_progress(progress, "load", static_cast<double>(k + 1) / static_cast<double>(count));
  }
  return volume;
}

} // namespace slicelens
