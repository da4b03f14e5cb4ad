#include "volume/volume_input.h"

#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"
#include "volume/readers.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <regex>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/// Regular, not hidden files of a folder in natural order.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entries(folder, error);
  if (error)
    throw FileError(folder.string(), "cannot be listed: " + error.message());
  for (const fs::directory_entry& entry : entries) {
    if (entry.is_regular_file(error) && entry.path().filename().string()[0] != '.')
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return files;
}

} // namespace

InputFormat format_of(const VolumeSource& source, const fs::path& path) {
  require_file(path);
  const std::string name = lower(path.filename().string());
  if (ends_with(name, ".raw"))
    return InputFormat::raw;
  const std::string head = head_of(path, 1024);
  if (head.rfind("NRRD000", 0) == 0 || ends_with(name, ".nrrd") || ends_with(name, ".nhdr"))
    return InputFormat::nrrd;
  if (ends_with(name, ".mha") || ends_with(name, ".mhd"))
    return InputFormat::meta;
  for (const char* end : {".nii", ".nii.gz", ".hdr", ".hdr.gz", ".img", ".img.gz"}) {
    if (ends_with(name, end))
      return InputFormat::nifti;
  }
  if (head.rfind("# vtk DataFile", 0) == 0 || ends_with(name, ".vtk"))
    return InputFormat::vtk;
  if (ends_with(name, ".vti") || head.find("<VTKFile") != std::string::npos)
    return InputFormat::vti;
  if (!image_kind(path).empty())
    return InputFormat::images;
  if (source.size)
    return InputFormat::raw;
  if (is_dicom(path))
    return InputFormat::dicom;
  static const std::regex size_in_name("[0-9]+x[0-9]+x[0-9]+");
  if (std::regex_search(name, size_in_name) && !ends_with(name, ".dat"))
    return InputFormat::raw;
  throw FileError(path.string(),
                  "is no volume that Slicelens knows (NRRD, MetaImage, NIfTI, DICOM, VTK, VTI, "
                  "PNG, TIFF or JPEG stacks; for headerless data give volume.size and volume.type)");
}

namespace {

/// The one folder in `folder`, or nothing: series are often kept in a folder of their own beside notes.
std::optional<fs::path> only_folder_in(const fs::path& folder) {
  std::optional<fs::path> only;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (!entry.is_directory(error) || entry.is_symlink(error) || entry.path().filename().string()[0] == '.')
      continue;
    if (only)
      return std::nullopt;
    only = entry.path();
  }
  return only;
}

/// The images or DICOM files among `files` (a folder's or a pattern's).
Input input_of_many(const VolumeSource& source, const std::vector<fs::path>& files) {
  std::map<std::string, std::vector<fs::path>> images;
  std::vector<fs::path> dicom;
  for (const fs::path& file : files) {
    std::error_code error;
    if (fs::file_size(file, error) == 0 || error)
      continue;
    if (const std::string kind = image_kind(file); !kind.empty())
      images[kind].push_back(file);
    else if (is_dicom(file))
      dicom.push_back(file);
  }
  const std::string name = source.file.string();
  if (images.empty() && dicom.empty()) {
    if (const auto inner = only_folder_in(source.file))
      return input_of_many(source, files_in(*inner));
  }
  if (images.size() + (dicom.empty() ? 0 : 1) > 1)
    throw FileError(name, "holds several kinds of images; name one kind by a pattern such as '*.png'");
  if (!dicom.empty())
    return {InputFormat::dicom, dicom, {}};
  if (images.empty())
    throw FileError(name, "holds no images and no DICOM files; name a volume file");
  return {InputFormat::images, images.begin()->second, {}};
}

/// Files of the pattern's folder whose names fit it: printf's %d and %03d, or the shell's * ? [].
std::vector<fs::path> files_of_pattern(const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  static const std::regex conversion("%0?[0-9]*[diu]");
  const bool printf_like = std::regex_search(name, conversion);
  if (!printf_like && name.find_first_of("*?[") == std::string::npos)
    throw FileError(pattern.string(), "no such file or folder; check the path");
  const fs::path folder = pattern.has_parent_path() ? pattern.parent_path() : fs::path(".");
  std::string glob = name;
  if (printf_like) {
    // Brackets and stars beside %d are letters of the name.
    glob =
        std::regex_replace(std::regex_replace(name, std::regex("([*?\\[\\]\\\\])"), "\\$1"), conversion, "*");
  }
  std::string digits;
  if (printf_like) {
    const std::string quoted = std::regex_replace(name, std::regex("([.*+?^${}()|\\[\\]\\\\])"), "\\$1");
    digits = std::regex_replace(quoted, conversion, "[0-9]+");
  }
  std::vector<fs::path> files;
  for (const fs::path& file : files_in(folder)) {
    const std::string candidate = file.filename().string();
    if (printf_like ? std::regex_match(candidate, std::regex(digits))
                    : ::fnmatch(glob.c_str(), candidate.c_str(), 0) == 0)
      files.push_back(file);
  }
  if (files.empty())
    throw FileError(pattern.string(), "no file fits this pattern");
  return files;
}

} // namespace

Input resolve(const VolumeSource& source) {
  if (source.file.empty())
    throw UsageError("volume.file is empty; name a volume file, a folder or a pattern");
  std::error_code error;
  const fs::file_status status = fs::status(source.file, error);
  if (status.type() == fs::file_type::directory)
    return input_of_many(source, files_in(source.file));
  if (status.type() == fs::file_type::not_found)
    return input_of_many(source, files_of_pattern(source.file));
  const InputFormat kind = format_of(source, source.file);
  if (kind != InputFormat::dicom)
    return {kind, {source.file}, {}};
  const fs::path folder = source.file.has_parent_path() ? source.file.parent_path() : fs::path(".");
  std::vector<fs::path> candidates;
  for (const fs::path& file : files_in(folder)) {
    if (fs::file_size(file, error) > 0 && !error && image_kind(file).empty() && is_dicom(file))
      candidates.push_back(file);
  }
  return {kind, candidates, source.file};
}

void refuse_raw_keys(const VolumeSource& source) {
  const char* key = source.size ? "size" : source.type ? "type" : source.big_endian ? "endian" : nullptr;
  if (key != nullptr)
    throw UsageError("volume." + std::string(key) + " is for headerless raw files; " + source.file.string() +
                     " says it itself");
}

void check_frame(const Volume& volume, const VolumeSource& source) {
  if (source.frame >= volume.frames)
    throw UsageError("volume.frame is " + std::to_string(source.frame) + " but " + source.file.string() +
                     " has " + std::to_string(volume.frames) + " frame(s), counted from 0");
}

void check_component(const Volume& volume, int component) {
  if (component < 0 || component >= volume.components)
    throw UsageError("volume.component is " + std::to_string(component) + " but the volume has " +
                     std::to_string(volume.components) + " component(s), counted from 0");
}

void apply_spacing(Volume& volume, const VolumeSource& source) {
  if (!source.spacing)
    return;
  for (int axis = 0; axis < 3; ++axis) {
    if (!((*source.spacing)[axis] > 0) || !std::isfinite((*source.spacing)[axis]))
      throw UsageError("volume.spacing holds " + number_text((*source.spacing)[axis]) +
                       "; finite numbers above 0 are needed");
  }
  volume.spacing = *source.spacing;
}

} // namespace slicelens
