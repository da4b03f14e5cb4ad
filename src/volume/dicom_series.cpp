#include "volume/dicom_series.h"

#include "core/errors.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// Positions (mm) closer than this are equal: below any real slice distance, above the text's rounding.
constexpr double same_position = 1e-3;

std::string described(const std::vector<DicomFile>& files) {
  std::map<std::string, std::pair<std::string, std::size_t>> series;
  for (const DicomFile& file : files) {
    series[file.series].first = file.description;
    ++series[file.series].second;
  }
  std::vector<std::string> texts;
  for (const auto& [uid, text] : series) {
    if (texts.size() == 20) {
      texts.push_back("and " + std::to_string(series.size() - 20) + " more");
      break;
    }
    texts.push_back(uid + " (" + (text.first.empty() ? "no description" : "'" + text.first + "'") + ", " +
                    std::to_string(text.second) + " files)");
  }
  return join(texts, "; ");
}

std::vector<DicomFile> one_series(const std::vector<DicomFile>& files, const fs::path& named,
                                  const std::string& source, const std::string& wanted) {
  std::set<std::string> uids;
  for (const DicomFile& file : files)
    uids.insert(file.series);
  std::set<std::string> chosen = uids;
  if (!wanted.empty()) {
    chosen.clear();
    for (const DicomFile& file : files) {
      if (file.series == wanted) {
        chosen = {wanted};
        break;
      }
      if (file.series.find(wanted) != std::string::npos || file.description.find(wanted) != std::string::npos)
        chosen.insert(file.series);
    }
    if (chosen.size() != 1)
      throw UsageError("volume.series '" + wanted + "' fits " + std::to_string(chosen.size()) +
                       " series of " + source + "; it holds " + described(files));
  } else if (!named.empty()) {
    for (const DicomFile& file : files) {
      if (file.file == named)
        chosen = {file.series};
    }
  }
  if (chosen.size() > 1)
    throw FileError(source, "holds " + std::to_string(chosen.size()) +
                                " series; choose one with --set volume.series=UID: " + described(files));
  std::vector<DicomFile> result;
  for (const DicomFile& file : files) {
    if (file.series == *chosen.begin())
      result.push_back(file);
  }
  return result;
}

/// Copies of one image (equal SOP instance UID, as in several transfer syntaxes) count once.
std::vector<DicomFile> without_copies(const std::vector<DicomFile>& files, const fs::path& named,
                                      const std::string& source, const Progress& progress) {
  std::map<std::string, std::size_t> kept; // instance → index in result
  std::vector<DicomFile> result;
  std::size_t copies = 0;
  for (const DicomFile& file : files) {
    const auto found = kept.find(file.instance);
    if (file.instance.empty() || found == kept.end()) {
      kept[file.instance] = result.size();
      result.push_back(file);
      continue;
    }
    ++copies;
    if (file.file == named)
      result[found->second] = file;
  }
  if (copies > 0)
    report_warning(progress,
                   source + ": " + std::to_string(copies) +
                       " file(s) hold copies of other images (same SOP Instance UID) and are left out");
  return result;
}

void check_alike(const std::vector<DicomFile>& files) {
  const DicomFile& first = files.front();
  for (const DicomFile& file : files) {
    if (file.rows != first.rows || file.columns != first.columns)
      throw FileError(file.file.string(),
                      "is " + std::to_string(file.columns) + " x " + std::to_string(file.rows) + " but " +
                          first.file.filename().string() + " of its series is " +
                          std::to_string(first.columns) + " x " + std::to_string(first.rows));
    if (file.axes.has_value() != first.axes.has_value() ||
        file.position.has_value() != first.position.has_value())
      throw FileError(file.file.string(), "has not the same Image Position or Orientation tags as " +
                                              first.file.filename().string() + " of its series");
    if (file.frames > 1 && files.size() > 1)
      throw FileError(file.file.string(), "holds " + std::to_string(file.frames) +
                                              " frames but is one of several files; give it alone");
    if (!file.axes)
      continue;
    for (int axis = 0; axis < 2; ++axis) {
      // 0.5°: scanners round the six cosines to few digits; localisers differ by far more.
      if (glm::dot(glm::normalize((*file.axes)[axis]), glm::normalize((*first.axes)[axis])) <
          std::cos(0.5 * 3.14159265358979 / 180))
        throw FileError(file.file.string(), "has another Image Orientation than " +
                                                first.file.filename().string() +
                                                " of its series; such slices form no volume");
    }
  }
}

/// Splits slices sorted by position into stacks that each have every position once.
std::vector<DicomFile> frame_of(const std::vector<DicomFile>& sorted, const std::string& source,
                                std::size_t frame, std::size_t& frames) {
  std::vector<std::vector<DicomFile>> groups;
  for (const DicomFile& file : sorted) {
    if (groups.empty() || std::abs(file.along - groups.back().front().along) > same_position)
      groups.emplace_back();
    groups.back().push_back(file);
  }
  frames = groups.front().size();
  for (const auto& group : groups) {
    if (group.size() != frames)
      throw FileError(source, "has " + std::to_string(group.size()) + " slices at position " +
                                  number_text(group.front().along) + " mm but " + std::to_string(frames) +
                                  " at others (" + group.back().file.filename().string() +
                                  "); files are missing or belong to another acquisition");
  }
  if (frame >= frames)
    throw UsageError("volume.frame is " + std::to_string(frame) + " but " + source + " has " +
                     std::to_string(frames) + " frame(s), counted from 0");
  std::vector<DicomFile> result;
  for (auto& group : groups) {
    std::sort(group.begin(), group.end(), [](const DicomFile& a, const DicomFile& b) {
      return std::tie(a.temporal, a.acquisition, a.number) < std::tie(b.temporal, b.acquisition, b.number);
    });
    result.push_back(group[frame]);
  }
  return result;
}

/// The frames of an enhanced file as slices.
std::vector<DicomFile> slices_of(const DicomFile& file) {
  std::vector<DicomFile> slices;
  for (std::size_t k = 0; k < file.frame_positions.size(); ++k) {
    DicomFile slice = file;
    slice.frames = 1;
    slice.frame_positions.clear();
    slice.position = file.frame_positions[k];
    slice.index = k;
    slice.number = static_cast<long long>(k);
    slices.push_back(slice);
  }
  return slices;
}

/// Distance and direction from slice to slice.
void measure(DicomStack& stack, const glm::dvec3& normal, const std::string& source,
             const Progress& progress) {
  const std::vector<DicomFile>& slices = stack.slices;
  const std::size_t gaps = slices.size() - 1;
  const double spacing = (slices.back().along - slices.front().along) / static_cast<double>(gaps);
  double worst = 0;
  double smallest = spacing;
  double largest = spacing;
  for (std::size_t k = 0; k < gaps; ++k) {
    const double gap = slices[k + 1].along - slices[k].along;
    smallest = std::min(smallest, gap);
    largest = std::max(largest, gap);
    worst = std::max(worst, std::abs(gap - spacing) / spacing);
  }
  const glm::dvec3 step = (*slices.back().position - *slices.front().position) / static_cast<double>(gaps);
  const double sideways = glm::length(step - glm::dot(step, normal) * normal);
  // 0.1 % (0.06°) is the rounding of the cosines; more is a tilted gantry.
  const bool tilted = sideways > 1e-3 * spacing;
  const double degrees = std::atan2(sideways, spacing) * 180 / 3.14159265358979;
  const std::string tilt = number_text(std::round(degrees * 100) / 100) + " degrees (tilted gantry)";
  const std::string uneven = "slice distances from " + number_text(std::round(smallest * 1e4) / 1e4) +
                             " to " + number_text(std::round(largest * 1e4) / 1e4) + " mm";
  if (worst > 0.1)
    throw FileError(source,
                    "has uneven " + uneven + (tilted ? " and is sheared by " + tilt : "") +
                        "; slices are missing or the scan is a mixed one: resample it to one distance");
  if (worst > 0.01)
    report_warning(progress, source + ": " + uneven + "; their mean is used");
  for (std::size_t k = 0; k < slices.size(); ++k) {
    const glm::dvec3 expected = *slices.front().position + step * static_cast<double>(k);
    const glm::dvec3 off = *slices[k].position - expected;
    if (glm::length(off - glm::dot(off, normal) * normal) > 0.1 * spacing + 1e-3)
      throw FileError(slices[k].file.string(),
                      "lies beside the line of the other slices; the series mixes scans");
  }
  if (tilted) {
    stack.axis = glm::normalize(step);
    stack.spacing = glm::length(step);
    report_warning(progress, source + ": the slices are sheared by " + tilt + "; the axes are kept so");
    return;
  }
  stack.spacing = spacing;
  stack.axis = normal;
}

} // namespace

DicomStack stack_of(std::vector<DicomFile> files, const fs::path& named, const std::string& source,
                    const std::string& series, std::size_t frame, const Progress& progress) {
  if (files.empty())
    throw FileError(source, "holds no DICOM images");
  files = without_copies(one_series(files, named, source, series), named, source, progress);
  if (files.size() > 1 && !named.empty()) {
    // Multi-frame files of one series are volumes of their own: the named one is meant.
    for (const DicomFile& file : files) {
      if (file.file == named && file.frames > 1) {
        files = {file};
        break;
      }
    }
  }
  for (const DicomFile& file : files) {
    if (file.mosaic && (named.empty() || file.file == named))
      throw FileError(file.file.string(), "is a Siemens mosaic (many slices in one picture); convert it to a "
                                          "series or to NIfTI first");
  }
  check_alike(files);
  DicomStack stack;
  if (files.size() == 1 && files.front().axes && files.front().frame_positions.size() > 1) {
    stack.one_file = true;
    files = slices_of(files.front());
  }
  if (files.size() == 1) {
    stack.slices = files;
    return stack;
  }
  if (!files.front().position || !files.front().axes) {
    std::sort(files.begin(), files.end(), [](const DicomFile& a, const DicomFile& b) {
      return a.number != b.number ? a.number < b.number
                                  : natural_less(a.file.filename().string(), b.file.filename().string());
    });
    report_warning(progress, source +
                                 ": the slices have no positions; they are sorted by Instance Number and "
                                 "put at distance 1");
    stack.slices = files;
    return stack;
  }
  const glm::dvec3 normal = glm::normalize(glm::cross((*files.front().axes)[0], (*files.front().axes)[1]));
  for (DicomFile& file : files)
    file.along = glm::dot(*file.position, normal);
  std::stable_sort(files.begin(), files.end(),
                   [](const DicomFile& a, const DicomFile& b) { return a.along < b.along; });
  if (!named.empty() && !stack.one_file && files.back().along - files.front().along <= same_position) {
    // Many pictures of one slice (a time series, other reconstructions): the file that was named is meant.
    for (const DicomFile& file : files) {
      if (file.file == named)
        stack.slices = {file};
    }
    report_warning(progress, source + ": " + std::to_string(files.size() - 1) +
                                 " other image(s) of its series lie at the same position and are left out");
    return stack;
  }
  stack.slices = frame_of(files, source, frame, stack.frames);
  if (stack.slices.size() > 1)
    measure(stack, normal, source, progress);
  return stack;
}

} // namespace slicelens
