#include "scene/transfer_files.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "scene/transfer_formats.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slicelens {

namespace fs = std::filesystem;

namespace transfer_formats {

namespace {

/// Two doubles with at most one other between them.
bool neighbours(double low, double high) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return low < high && high <= std::nextafter(std::nextafter(low, infinity), infinity);
}

template <class Curve>
void join_curve_steps(Curve& curve) {
  for (std::size_t i = 1; i < curve.points.size(); ++i) {
    if (neighbours(curve.points[i - 1].value, curve.points[i].value))
      curve.points[i - 1].value = curve.points[i].value;
  }
}

} // namespace

void join_steps(ColorCurve& curve) { join_curve_steps(curve); }
void join_steps(OpacityCurve& curve) { join_curve_steps(curve); }

std::vector<TransferPoint> written_points(const TransferFunction& transfer) {
  std::vector<TransferPoint> points = transfer.points;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i].value == points[i + 1].value)
      points[i].value = std::nextafter(points[i].value, -std::numeric_limits<double>::infinity());
  }
  return points;
}

std::size_t choose_map(const fs::path& path, const std::vector<std::string>& names, const std::string& map) {
  if (names.empty())
    throw FileError(path.string(), "holds no colour map");
  const auto found = std::find(names.begin(), names.end(), map);
  if (found != names.end())
    return static_cast<std::size_t>(found - names.begin());
  if (map.empty() && names.size() == 1)
    return 0;
  std::vector<std::string> some(
      names.begin(), names.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(names.size(), 12)));
  if (some.size() < names.size())
    some.emplace_back("…");
  if (map.empty()) {
    throw UsageError(path.string() + ": holds " + std::to_string(names.size()) +
                     " colour maps; name one with transfer.map (" + join(some) + ")");
  }
  const auto nearest = nearest_word(map, names);
  throw UsageError(path.string() + ": has no colour map '" + map + "'" +
                   (nearest ? "; did you mean '" + *nearest + "'?" : "") + " (" + join(some) + ")");
}

void check_count(const fs::path& path, const std::string& what, std::size_t count) {
  if (count > kMaxControlPoints) {
    throw FileError(path.string(), "has " + std::to_string(count) + " " + what + "; at most " +
                                       std::to_string(kMaxControlPoints) + " are read");
  }
}

} // namespace transfer_formats

using namespace transfer_formats;

namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

const char* name_of(ColorSpace space) {
  switch (space) {
  case ColorSpace::rgb:
    return "RGB";
  case ColorSpace::hsv:
  case ColorSpace::hsv_wrapped:
    return "HSV";
  case ColorSpace::lab:
    return "Lab";
  case ColorSpace::diverging:
    return "Diverging";
  case ColorSpace::step:
    return "Step";
  }
  return "";
}

OpacityCurve ramp_over(const ColorCurve& color) {
  OpacityCurve ramp;
  ramp.logarithmic = color.logarithmic;
  if (color.points.empty())
    return ramp;
  ramp.points.push_back({color.points.front().value, 0});
  ramp.points.push_back({color.points.back().value, 1});
  return ramp;
}

void stretch(TransferFunction& transfer, const ValueRange& range, const fs::path& path) {
  const double first = transfer.points.front().value;
  const double last = transfer.points.back().value;
  if (!(first < last)) {
    throw FileError(path.string(), "all its points lie at " + number_text(first) +
                                       ", which cannot be stretched; remove transfer.range");
  }
  for (TransferPoint& point : transfer.points) {
    const double f = (point.value - first) / (last - first);
    point.value = range[0] * (1 - f) + range[1] * f;
  }
}

/// Steps of three and more points at one value: only the outer ones have a side.
std::size_t hidden_points(const TransferFile& file) {
  std::size_t hidden = 0;
  const auto count = [&](const auto& points) {
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
      hidden += points[i - 1].value == points[i].value && points[i].value == points[i + 1].value ? 1 : 0;
  };
  count(file.color.points);
  count(file.opacity.points);
  return hidden;
}

/// Whether a display differs from the plain one.
bool says_something(const SlicerDisplay& display) {
  const auto flat = [](const OpacityPoint& point) { return point.opacity == 1; };
  const auto& gradient = display.gradient_opacity;
  return display.shade || display.interpolation != 1 || !std::all_of(gradient.begin(), gradient.end(), flat);
}

std::string join_sentences(const std::vector<std::string>& sentences) { return join(sentences, "; "); }

} // namespace

std::optional<TransferFormat> transfer_format_of(const fs::path& path) {
  const std::string name = lower(path.filename().string());
  if (ends_with(name, ".vp.json"))
    return TransferFormat::slicer_json;
  if (ends_with(name, ".json"))
    return TransferFormat::paraview_json;
  if (ends_with(name, ".xml"))
    return TransferFormat::paraview_xml;
  if (ends_with(name, ".vp"))
    return TransferFormat::slicer_text;
  if (ends_with(name, ".1dt"))
    return TransferFormat::table;
  return std::nullopt;
}

TransferFile read_transfer_file(const fs::path& path, const std::string& map) {
  const auto format = transfer_format_of(path);
  if (!format) {
    throw FileError(path.string(), "is no transfer function by its name; .json and .xml (ParaView), .vp and "
                                   ".vp.json (3D Slicer) and .1dt (ImageVis3D) are");
  }
  const bool several = *format == TransferFormat::paraview_json || *format == TransferFormat::paraview_xml;
  if (!several && !map.empty())
    throw UsageError("transfer.map: " + path.string() + " holds one transfer function; leave the key out");
  switch (*format) {
  case TransferFormat::paraview_json:
    return read_paraview_json(path, map);
  case TransferFormat::paraview_xml:
    return read_paraview_xml(path, map);
  case TransferFormat::slicer_text:
    return read_slicer_text(path);
  case TransferFormat::slicer_json:
    return read_slicer_json(path);
  case TransferFormat::table:
    return read_table(path);
  }
  return {};
}

ReadTransfer transfer_of(const TransferFile& file, const fs::path& path,
                         const std::optional<ValueRange>& range) {
  const bool ramp = file.opacity.points.empty();
  JoinedCurves joined;
  try {
    joined = slicelens::join(file.color, ramp ? ramp_over(file.color) : file.opacity);
  } catch (const UsageError& error) { // the file's numbers, not the user's
    throw FileError(path.string(), error.what());
  }
  ReadTransfer result;
  result.transfer = std::move(joined.transfer);
  result.transfer.name = file.name;
  result.transfer.unit_distance = file.unit_distance;
  if (range)
    stretch(result.transfer, *range, path);
  std::vector<std::string> notes;
  if (joined.resampled) {
    std::string how = "pieces bent";
    if (file.color.space != ColorSpace::rgb && file.color.space != ColorSpace::step)
      how = std::string("colours interpolated in ") + name_of(file.color.space);
    else if (file.color.logarithmic || file.opacity.logarithmic)
      how = "pieces bent by the logarithmic scale";
    notes.push_back(how + " are resampled to " + std::to_string(result.transfer.points.size()) +
                    " points, off by at most " + number_text(std::ceil(joined.deviation * 1e6) / 1e6));
  }
  if (ramp)
    notes.emplace_back("no opacity is given, so it rises from 0 to 1");
  std::vector<std::string> ignored = file.ignored;
  if (const std::size_t hidden = hidden_points(file); hidden > 0)
    ignored.push_back(std::to_string(hidden) + " point(s) inside a step");
  if (!ignored.empty())
    notes.push_back("not taken: " + slicelens::join(ignored));
  result.note = join_sentences(notes);
  return result;
}

std::string write_transfer_file(const fs::path& path, const TransferToWrite& what) {
  validate(what.transfer);
  const auto format = transfer_format_of(path);
  if (!format || *format == TransferFormat::paraview_xml) {
    throw UsageError(path.string() + ": cannot be written; give a name that ends in .json (ParaView), .vp or "
                                     ".vp.json (3D Slicer) or .1dt (ImageVis3D)");
  }
  std::vector<std::string> lost;
  std::string text;
  const bool display = what.display && says_something(*what.display) &&
                       *format != TransferFormat::slicer_text && *format != TransferFormat::slicer_json;
  switch (*format) {
  case TransferFormat::paraview_json:
    text = paraview_json_text(what);
    break;
  case TransferFormat::slicer_text:
    text = slicer_text(what);
    break;
  case TransferFormat::slicer_json:
    text = slicer_json_text(what);
    break;
  case TransferFormat::table: {
    double deviation = 0;
    text = table_text(what, deviation);
    lost.push_back("the values of its " + std::to_string(what.rows) + " rows, from " +
                   number_text(what.rows_range[0]) + " to " + number_text(what.rows_range[1]));
    if (deviation > 1e-9)
      lost.push_back("what lies between the rows (off by at most " +
                     number_text(std::ceil(deviation * 1e6) / 1e6) + ")");
    break;
  }
  case TransferFormat::paraview_xml:
    break;
  }
  if (what.transfer.unit_distance && *format != TransferFormat::slicer_json)
    lost.push_back("the unit distance " + number_text(*what.transfer.unit_distance));
  if (display)
    lost.emplace_back("light, shading and gradient opacity");
  write_text_atomically(path, text);
  return lost.empty() ? "" : "the format does not hold " + slicelens::join(lost);
}

SlicerDisplay slicer_display(const Scene& scene) {
  SlicerDisplay display;
  display.interpolation = scene.render.filter == Filter::nearest ? 0
                          : scene.render.filter == Filter::cubic ? 2
                                                                 : 1;
  display.shade = scene.render.shading == Shading::diffuse || scene.render.shading == Shading::phong;
  display.ambient = scene.light.ambient;
  display.diffuse = scene.light.diffuse;
  display.specular = scene.render.shading == Shading::diffuse ? 0 : scene.light.specular;
  display.power = scene.light.power;
  return display;
}

} // namespace slicelens
