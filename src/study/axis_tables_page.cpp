#include "study/axis_tables_page.h"

#include "core/errors.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace slicelens {

namespace {

using Texels = std::vector<glm::vec4>;

constexpr const char* axis_names = "xyz";
constexpr int offset = 0, mask = 1, attenuation = 2, highlight = 3; // channels R, G, B, A

double texel_center(std::size_t j, std::size_t count) {
  return (static_cast<double>(j) + 0.5) / static_cast<double>(count);
}

/// What a linear filter with clamped ends reads: straight lines between the texels, level outside them.
std::vector<glm::dvec2> filtered(const Texels& texels, int channel) {
  std::vector<glm::dvec2> points = {{0, texels.front()[channel]}};
  for (std::size_t j = 0; j < texels.size(); ++j)
    points.push_back({texel_center(j, texels.size()), texels[j][channel]});
  points.push_back({1, texels.back()[channel]});
  return points;
}

/// What a nearest fetch reads: each texel over its own width.
std::vector<glm::dvec2> steps(const Texels& texels, int channel) {
  std::vector<glm::dvec2> points;
  const double count = static_cast<double>(texels.size());
  for (std::size_t j = 0; j < texels.size(); ++j) {
    const double value = texels[j][channel];
    points.push_back({static_cast<double>(j) / count, value});
    points.push_back({static_cast<double>(j + 1) / count, value});
  }
  return points;
}

PlotSeries curve(std::vector<glm::dvec2> points, std::uint32_t rgb) {
  PlotSeries series;
  series.points = std::move(points);
  series.rgb = rgb;
  return series;
}

/// Filtered or in steps, as the renderer reads the channel.
std::vector<glm::dvec2> read(const Texels& texels, int channel, AxisFilter filter) {
  return filter == AxisFilter::linear ? filtered(texels, channel) : steps(texels, channel);
}

/// A panel over the displayed coordinate with the focus marked; with names of the marks where `named`.
PlotPanel panel(std::size_t axis, const std::optional<AxisRanges>& focus, bool named, PlotSeries series) {
  PlotPanel result;
  result.x.range = std::pair{0.0, 1.0};
  result.y.range = std::pair{-0.05, 1.05};
  result.series = {std::move(series)};
  if (!focus)
    return result;
  const std::string letter(1, axis_names[axis]);
  const auto name = [&](const char* text) { return named ? letter + text : std::string(); };
  const double low = (*focus)[axis].x;
  const double high = (*focus)[axis].y;
  if (low < high) {
    result.regions = {{low, high}};
    result.markers = {{low, name("'_min"), PlotMarker::Side::left},
                      {high, name("'_max"), PlotMarker::Side::right}};
  }
  const bool room = low == high || high - low > 0.15; // between the two other names
  result.markers.push_back({(low + high) / 2, room ? name("_f") : "", PlotMarker::Side::center});
  return result;
}

PlotPanel mapping_panel(std::size_t axis, const Texels& texels, const std::optional<AxisRanges>& focus,
                        AxisFilter filter) {
  const std::string letter(1, axis_names[axis]);
  PlotSeries map = curve(read(texels, offset, filter), 0xb02a2a);
  for (glm::dvec2& point : map.points)
    point.y += point.x;
  map.name = letter + " + offset";
  PlotPanel result = panel(axis, focus, true, map);
  result.title = letter + " axis";
  PlotSeries identity = curve({{0, 0}, {1, 1}}, 0x777777);
  identity.name = "identity";
  identity.width = 1;
  identity.line = LineStyle::dashed;
  result.series.insert(result.series.begin(), identity);
  result.key = KeyPlace::top_left;
  for (const glm::dvec2& point : map.points) { // a map that leaves the volume is shown in full
    if (!std::isfinite(point.y))
      continue;
    result.y.range->first = std::min(result.y.range->first, point.y - 0.05);
    result.y.range->second = std::max(result.y.range->second, point.y + 0.05);
  }
  return result;
}

PlotPanel mask_panel(std::size_t axis, const AxisTables& tables, const std::optional<AxisRanges>& focus,
                     AxisFilter filter) {
  // A mask that is tested is the nearest texel's under either filter.
  const AxisFilter mask_filter = tables.mask == AxisMask::test ? AxisFilter::nearest : filter;
  PlotPanel result = panel(axis, focus, false, curve(read(tables.texels[axis], mask, mask_filter), 0x2a7d3b));
  result.y.range = std::pair{-0.15, 1.15};
  result.y.ticks = {{0, "0"}, {1, "1"}};
  return result;
}

/// Of attenuation or highlight. Its region is named where it is not the mapping's, which has its names in
/// the first row.
PlotPanel effect_panel(std::size_t axis, PlotSeries series, const std::optional<AxisRanges>& own,
                       const std::optional<AxisRanges>& mapping) {
  return panel(axis, own ? own : mapping, own && own != mapping, std::move(series));
}

std::uint32_t packed(const glm::dvec3& color) {
  std::uint32_t rgb = 0;
  for (int c = 0; c < 3; ++c) {
    const double part = std::isnan(color[c]) ? 0 : std::clamp(color[c], 0.0, 1.0);
    rgb = rgb << 8 | static_cast<std::uint32_t>(std::lround(255 * part));
  }
  return rgb;
}

std::uint32_t texel_color(const glm::vec4& texel, int channel, double largest_offset) {
  if (channel != offset)
    return packed(glm::dvec3(texel[channel]));
  return diverging_color(largest_offset > 0 ? texel.x / largest_offset : 0);
}

/// Texels of one colour become one box. Each but the last reaches further, under the next ones, by a texel or
/// some pixels, so that no seam of background shows between them.
void add_strip(std::vector<PlotBox>& boxes, const Texels& texels, int channel, double largest_offset) {
  const double top = 4 - channel;
  const auto color = [&](std::size_t j) { return texel_color(texels[j], channel, largest_offset); };
  for (std::size_t j = 0, next = 0; j < texels.size(); j = next) {
    next = j + 1;
    while (next < texels.size() && color(next) == color(j))
      ++next;
    const std::size_t further = std::max<std::size_t>(1, texels.size() / 100);
    const double end = static_cast<double>(std::min(next + further, texels.size()));
    boxes.push_back({{static_cast<double>(j), top - 0.92}, {end, top - 0.08}, color(j)});
  }
}

PlotPanel texel_panel(std::size_t axis, const Texels& texels) {
  PlotPanel result;
  double largest = 0;
  for (const glm::vec4& texel : texels)
    if (std::isfinite(texel.x))
      largest = std::max(largest, std::abs(static_cast<double>(texel.x)));
  char text[64];
  std::snprintf(text, sizeof text, "%c texture, |offset| up to %.3g", axis_names[axis], largest);
  result.title = text;
  result.x.label = "texel";
  result.x.range = std::pair{0.0, static_cast<double>(texels.size())};
  result.y.range = std::pair{0.0, 4.0};
  result.y.ticks = {{3.5, "offset"}, {2.5, "mask"}, {1.5, "attenuation"}, {0.5, "highlight"}};
  result.grid = false;
  result.regions = {{0, static_cast<double>(texels.size()), 0xe4e4e4}}; // white texels must be seen
  for (const int channel : {offset, mask, attenuation, highlight})
    add_strip(result.boxes, texels, channel, largest);
  return result;
}

} // namespace

std::uint32_t diverging_color(double value) {
  const double t = std::clamp(value, -1.0, 1.0);
  const glm::dvec3 end = t < 0 ? glm::dvec3(0.13, 0.36, 0.70) : glm::dvec3(0.72, 0.12, 0.15);
  return packed(glm::mix(glm::dvec3(1), end, std::abs(t)));
}

PlotPage axis_tables_page(const std::string& title, const AxisTables& tables, const AxisTableMarks& marks,
                          AxisFilter filter) {
  PlotPage page;
  page.title = title;
  page.width = 1200;
  page.height = 1200;
  page.columns = 3;
  page.row_heights = {5, 1.2, 3, 3, 1.8};
  page.panels.resize(15);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Texels& texels = tables.texels[axis];
    if (texels.empty())
      throw UsageError(std::string("axis tables: there are no texels along ") + axis_names[axis]);
    const auto effect = [&](int channel, std::uint32_t rgb, const std::optional<AxisRanges>& own) {
      return effect_panel(axis, curve(read(texels, channel, filter), rgb), own, marks.mapping);
    };
    page.panels[axis] = mapping_panel(axis, texels, marks.mapping, filter);
    page.panels[axis + 3] = mask_panel(axis, tables, marks.mapping, filter);
    page.panels[axis + 6] = effect(attenuation, 0x1f5fa8, marks.attenuation);
    page.panels[axis + 9] = effect(highlight, 0x444444, marks.highlight);
    page.panels[axis + 9].x.label = std::string("displayed ") + axis_names[axis];
    page.panels[axis + 12] = texel_panel(axis, texels);
  }
  const char* const rows[] = {"data coordinate (R)",
                              tables.mask == AxisMask::test ? "mask (G)" : "weight (G)", "attenuation (B)",
                              "highlight (A)"};
  for (std::size_t row = 0; row < 4; ++row)
    page.panels[3 * row].y.label = rows[row];
  return page;
}

PlotPage axis_tables_page(const std::string& title, const PreparedScene& prepared) {
  const FocusEffects& effects = prepared.effects;
  AxisTableMarks marks;
  marks.mapping = focus_region(prepared.scene.warp);
  if (has_attenuation(effects))
    marks.attenuation = ranges_of(effects.attenuation_low, effects.attenuation_high);
  if (has_highlight(effects))
    marks.highlight = ranges_of(effects.highlight_low, effects.highlight_high);
  return axis_tables_page(title, axis_tables_of(prepared), marks, prepared.scene.render.axis_filter);
}

} // namespace slicelens
