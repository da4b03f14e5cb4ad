// NRRD is read here and not through ITK, which knows neither bzip2 nor frames beside a 3D space nor a space
// without directions.
#include "core/errors.h"
#include "core/text.h"
#include "volume/file_checks.h"
#include "volume/nrrd_data.h"
#include "volume/readers.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

using Axis = NrrdHeader::Axis;

ScalarType type_of(const NrrdHeader& header) {
  const std::string name = lower(header.fields.at("type"));
  if (name == "float")
    return ScalarType::f32;
  if (name == "double")
    return ScalarType::f64;
  const bool is_unsigned = name[0] == 'u';
  switch (header.scalar_bytes) {
  case 1:
    return is_unsigned ? ScalarType::u8 : ScalarType::i8;
  case 2:
    return is_unsigned ? ScalarType::u16 : ScalarType::i16;
  case 4:
    return is_unsigned ? ScalarType::u32 : ScalarType::i32;
  default:
    return is_unsigned ? ScalarType::u64 : ScalarType::i64;
  }
}

std::string field_of(const NrrdHeader& header, const char* name) {
  const auto found = header.fields.find(name);
  return found == header.fields.end() ? std::string() : found->second;
}

/// "(1,2,3)", with one to four numbers, as a vector of three; nothing for "none" and for a vector of NaNs,
/// which says the same.
std::optional<glm::dvec3> vector_of(const fs::path& path, const std::string& field, std::string text) {
  if (text.empty() || text[0] != '(')
    return std::nullopt;
  for (char& c : text) {
    if (c == '(' || c == ')' || c == ',')
      c = ' ';
  }
  const std::vector<double> numbers = numbers_of(path, field, text);
  if (std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isnan(number); }))
    return std::nullopt;
  glm::dvec3 vector(0);
  for (std::size_t k = 0; k < numbers.size() && k < 3; ++k) {
    if (!(std::abs(numbers[k]) < 1e30))
      throw FileError(path.string(),
                      "'" + field + "' holds " + number_text(numbers[k]) + "; finite numbers are needed");
    vector[static_cast<int>(k)] = numbers[k];
  }
  return vector;
}

/// Turns a vector of the header's space into LPS.
glm::dvec3 lps_of(const std::string& space, glm::dvec3 v) {
  if (space.rfind("right", 0) == 0 || space == "ras" || space == "rast")
    v.x = -v.x;
  if (space.find("anterior") != std::string::npos || space == "ras" || space == "rast" || space == "las" ||
      space == "last")
    v.y = -v.y;
  return v;
}

/// The words between quotation marks.
std::vector<std::string> quoted_words(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t open = text.find('"'); open != std::string::npos; open = text.find('"', open)) {
    const std::size_t close = text.find('"', open + 1);
    if (close == std::string::npos)
      break;
    words.push_back(text.substr(open + 1, close - open - 1));
    open = close + 1;
  }
  return words;
}

std::optional<double> metres_of(const std::string& unit) {
  static const std::map<std::string, double> units = {{"m", 1},
                                                      {"meter", 1},
                                                      {"metre", 1},
                                                      {"meters", 1},
                                                      {"metres", 1},
                                                      {"dm", 0.1},
                                                      {"cm", 1e-2},
                                                      {"mm", 1e-3},
                                                      {"millimeter", 1e-3},
                                                      {"millimetre", 1e-3},
                                                      {"millimeters", 1e-3},
                                                      {"um", 1e-6},
                                                      {"\xc2\xb5m", 1e-6},
                                                      {"\xce\xbcm", 1e-6},
                                                      {"micron", 1e-6},
                                                      {"microns", 1e-6},
                                                      {"micrometer", 1e-6},
                                                      {"micrometers", 1e-6},
                                                      {"nm", 1e-9},
                                                      {"nanometer", 1e-9},
                                                      {"nanometers", 1e-9}};
  const auto found = units.find(lower(trimmed(unit)));
  return found == units.end() ? std::nullopt : std::optional(found->second);
}

/// Factors that bring axes with different units of length to the first one's. One unit for all is the data's
/// own and stays.
glm::dvec3 common_unit(const fs::path& path, const std::vector<std::string>& units,
                       const Progress& progress) {
  glm::dvec3 factors(1);
  if (std::all_of(units.begin(), units.end(), [&](const std::string& unit) { return unit == units.front(); }))
    return factors;
  const std::string text = join(units, ", ");
  for (std::size_t axis = 0; axis < units.size() && axis < 3; ++axis) {
    const auto first = metres_of(units[0]);
    const auto own = metres_of(units[axis]);
    if (!first || !own) {
      report_warning(progress, path.string() + ": its axes have different units (" + one_line(text) +
                                   ") that are no known lengths; its numbers are used as they are");
      return glm::dvec3(1);
    }
    factors[static_cast<int>(axis)] = *own / *first;
  }
  report_warning(progress, path.string() + ": its axes have different units (" + one_line(text) +
                               "); all are turned to " + one_line(units[0]));
  return factors;
}

/// Fills directions that the header does not give: perpendicular to the others.
void complete(glm::dmat3& directions, int known) {
  if (known == 1) {
    const glm::dvec3 d = directions[0];
    const glm::dvec3 other = std::abs(d.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    directions[1] = glm::normalize(other - d * glm::dot(d, other));
  }
  if (known < 3)
    directions[2] = glm::cross(directions[0], directions[1]);
}

/// Place by `space directions` and `space origin`. Returns false when the header has no directions for its
/// axes of space.
bool place_in_space(const fs::path& path, const NrrdHeader& header, const std::string& space, Volume& volume,
                    const Progress& progress) {
  const std::vector<std::string> words = nrrd_vector_words(field_of(header, "space directions"));
  const std::vector<std::string> units = quoted_words(field_of(header, "space units"));
  const glm::dvec3 factors = units.empty() ? glm::dvec3(1) : common_unit(path, units, progress);
  int known = 0;
  glm::dmat3 directions(1);
  for (std::size_t axis = 0; axis < header.axes.size() && known < 3; ++axis) {
    if (header.axes[axis] != Axis::space)
      continue;
    const auto vector = axis < words.size() ? vector_of(path, "space directions", words[axis]) : std::nullopt;
    if (!vector)
      return false;
    const glm::dvec3 column = lps_of(space, *vector * factors);
    const double length = glm::length(column);
    if (!(length > 0))
      throw FileError(path.string(), "'space directions' holds a vector without length");
    volume.spacing[known] = length;
    directions[known++] = column / length;
  }
  complete(directions, known);
  volume.direction = directions;
  if (const auto origin = vector_of(path, "space origin", field_of(header, "space origin")))
    volume.origin = lps_of(space, *origin * factors);
  return true;
}

/// Place by `spacings` (negative: the axis runs the other way) and, without a space, `axis mins`.
void place_by_axes(const fs::path& path, const NrrdHeader& header, const std::string& space, Volume& volume,
                   const Progress& progress) {
  const std::vector<double> spacings = numbers_of(path, "spacings", field_of(header, "spacings"));
  const std::vector<double> mins = numbers_of(path, "axis mins", field_of(header, "axis mins"));
  const std::vector<std::string> centers =
      words_of(lower(field_of(header, "centers") + " " + field_of(header, "centerings")));
  const std::vector<std::string> units = quoted_words(field_of(header, "units"));
  std::vector<std::string> space_units;
  std::vector<std::size_t> axes; // of space
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    if (header.axes[axis] == Axis::space) {
      axes.push_back(axis);
      space_units.push_back(axis < units.size() ? units[axis] : "");
    }
  }
  const glm::dvec3 factors = units.empty() ? glm::dvec3(1) : common_unit(path, space_units, progress);
  const auto origin = vector_of(path, "space origin", field_of(header, "space origin"));
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const int column = static_cast<int>(k);
    glm::dvec3 direction(0);
    direction[column] = 1;
    const double spacing = axes[k] < spacings.size() ? spacings[axes[k]] * factors[column] : 1;
    volume.spacing[column] = std::abs(spacing);
    volume.direction[column] = lps_of(space, spacing < 0 ? -direction : direction);
    if (!origin && space.empty() && axes[k] < mins.size() && std::isfinite(mins[axes[k]])) {
      const bool node = axes[k] < centers.size() && centers[axes[k]] == "node";
      volume.origin[column] = mins[axes[k]] * factors[column] + (node ? 0 : spacing / 2);
    }
  }
  if (origin)
    volume.origin = lps_of(space, *origin);
}

void place(const fs::path& path, const NrrdHeader& header, Volume& volume, const Progress& progress) {
  const std::string space = lower(field_of(header, "space"));
  if (!place_in_space(path, header, space, volume, progress))
    place_by_axes(path, header, space, volume, progress);
  if (!(std::abs(glm::determinant(volume.direction)) > 1e-6))
    throw FileError(path.string(), "'space directions' hold no three independent directions");
}

/// Which scalars of the file make up the wanted frame: their distance from voxel to voxel, component to
/// component and frame to frame, in scalars.
struct Layout {
  std::array<std::size_t, 3> voxel{0, 0, 0};
  std::size_t component = 0;
  std::size_t frame = 0;
  std::size_t total = 1; ///< scalars in the file
};

Layout layout_of(const fs::path& path, const NrrdHeader& header, Volume& volume) {
  Layout layout;
  std::size_t space_axis = 0;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    const auto size = static_cast<std::size_t>(header.sizes[axis]);
    if (header.axes[axis] == Axis::space) {
      layout.voxel[space_axis] = layout.total;
      volume.dims[space_axis++] = size;
    } else if (header.axes[axis] == Axis::frame) {
      layout.frame = layout.total;
      volume.frames = size;
    } else {
      layout.component = layout.total;
      volume.components = static_cast<int>(size);
    }
    layout.total = checked_product(layout.total, size, path.string());
  }
  return layout;
}

/// Components first, then space, then frames: a frame is one piece of the file.
bool is_contiguous(const Layout& layout, const Volume& volume) {
  const bool components_first = volume.components == 1 || layout.component == 1;
  const bool frames_last = volume.frames == 1 || layout.frame * volume.frames == layout.total;
  return components_first && frames_last;
}

std::vector<std::byte> gathered(const std::vector<std::byte>& all, const Layout& layout, const Volume& volume,
                                std::size_t frame) {
  const std::size_t scalar = size_of(volume.type);
  std::vector<std::byte> voxels(voxel_bytes(volume));
  std::byte* out = voxels.data();
  for (std::size_t k = 0; k < volume.dims[2]; ++k) {
    for (std::size_t j = 0; j < volume.dims[1]; ++j) {
      for (std::size_t i = 0; i < volume.dims[0]; ++i) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(volume.components); ++c) {
          const std::size_t from = i * layout.voxel[0] + j * layout.voxel[1] + k * layout.voxel[2] +
                                   c * layout.component + frame * layout.frame;
          std::memcpy(out, all.data() + from * scalar, scalar);
          out += scalar;
        }
      }
    }
  }
  return voxels;
}

} // namespace

namespace {

/// All but the voxels.
Volume described(const fs::path& path, const NrrdHeader& header, std::size_t frame, Layout& layout,
                 const Progress& progress) {
  Volume volume;
  volume.format = "NRRD";
  volume.type = type_of(header);
  layout = layout_of(path, header, volume);
  if (frame >= volume.frames)
    throw UsageError("volume.frame is " + std::to_string(frame) + " but " + path.string() + " has " +
                     std::to_string(volume.frames) + " frame(s), counted from 0");
  place(path, header, volume, progress);
  return volume;
}

} // namespace

OpenedVolume open_nrrd(const fs::path& path, std::size_t frame, const Progress& progress) {
  const NrrdHeader header = parse_nrrd(path);
  Layout layout;
  OpenedVolume opened{described(path, header, frame, layout, progress), std::nullopt};
  if (header.encoding != Encoding::raw)
    return opened;
  const std::size_t total = checked_product(layout.total, size_of(opened.volume.type), path.string());
  RawLayout raw;
  const bool to_end = frame + 1 == opened.volume.frames || !is_contiguous(layout, opened.volume);
  raw.pieces = nrrd_pieces(path, header, total, to_end, progress);
  raw.first = frame * layout.frame;
  // Axes that the file does not have hold one voxel.
  raw.step = {layout.voxel[0], layout.voxel[1], layout.voxel[2]};
  raw.component_step = layout.component;
  raw.swapped = is_swapped(header);
  if (!raw.pieces.empty())
    opened.layout = std::move(raw);
  return opened;
}

Volume read_nrrd(const fs::path& path, std::size_t frame, const Progress& progress) {
  const NrrdHeader header = parse_nrrd(path);
  Layout layout;
  Volume volume = described(path, header, frame, layout, progress);
  const std::size_t bytes = voxel_bytes(volume);
  const std::size_t total = checked_product(layout.total, size_of(volume.type), path.string());
  const bool whole =
      !is_contiguous(layout, volume) || header.encoding == Encoding::text || header.encoding == Encoding::hex;
  check_memory(path, whole ? total : bytes);
  if (is_contiguous(layout, volume)) {
    volume.voxels = read_nrrd_data(path, header, volume.type, {frame * bytes, bytes, total}, progress);
  } else {
    volume.voxels = gathered(read_nrrd_data(path, header, volume.type, {0, total, total}, progress), layout,
                             volume, frame);
  }
  return volume;
}

} // namespace slicelens
