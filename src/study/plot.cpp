#include "study/plot.h"

#include "core/errors.h"
#include "core/text.h"
#include "study/gnuplot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numeric>

namespace slicelens {

namespace {

constexpr int smallest_side = 200;
constexpr int largest_side = 8192;

// Room around the frames for titles, labels and numbers, in pixels.
constexpr double page_title = 34;
constexpr double row_gap = 8;
constexpr double panel_title = 24;
constexpr double marker_label = 18;
constexpr double axis_numbers = 26;
constexpr double axis_label = 20;
constexpr double left_of_frame = 86;
constexpr double right_of_frame = 22;
constexpr double smallest_frame = 24; // a side of it

std::string color(std::uint32_t rgb) {
  char text[16];
  std::snprintf(text, sizeof text, "'#%06x'", rgb & 0xffffffU);
  return text;
}

bool visible(double value, const PlotAxis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

bool visible(const glm::dvec2& point, const PlotPanel& panel) {
  return visible(point.x, panel.x) && visible(point.y, panel.y);
}

bool visible(const PlotSeries& series, const PlotPanel& panel) {
  for (const glm::dvec2& point : series.points) {
    if (visible(point, panel))
      return true;
  }
  return false;
}

bool has_marker_labels(const PlotPanel& panel) {
  return std::any_of(panel.markers.begin(), panel.markers.end(),
                     [](const PlotMarker& marker) { return !marker.label.empty(); });
}

void check_range(const PlotAxis& axis, const PlotPanel& panel) {
  if (axis.range && !(visible(axis.range->first, axis) && visible(axis.range->second, axis) &&
                      axis.range->first < axis.range->second)) {
    throw UsageError("plot '" + panel.title + "': the range " + number_text(axis.range->first) + " to " +
                     number_text(axis.range->second) + " of '" + axis.label +
                     "' is no range; low must be below high, and both positive on a logarithmic axis");
  }
}

/// Places that are not points of a curve must all be there.
void check_place(double x, const PlotPanel& panel, const char* what) {
  if (!visible(x, panel.x))
    throw UsageError("plot '" + panel.title + "': " + what + " at " + number_text(x) +
                     "; it must be finite (and positive on a logarithmic axis)");
}

void check(const PlotPanel& panel) {
  for (const PlotMarker& marker : panel.markers)
    check_place(marker.x, panel, "a marker");
  for (const PlotRegion& region : panel.regions) {
    check_place(region.low, panel, "a region");
    check_place(region.high, panel, "a region");
  }
  check_range(panel.x, panel);
  check_range(panel.y, panel);
  bool any = !panel.boxes.empty();
  for (const PlotSeries& series : panel.series)
    any = any || visible(series, panel);
  if (!any)
    throw UsageError("plot '" + panel.title +
                     "': no point can be seen; one must be finite (and positive on "
                     "a logarithmic axis)");
}

/// Pixels above and below the frames of a row: as much as the fullest of its panels needs.
struct RowSpace {
  double above = row_gap;
  double below = axis_numbers;
};

RowSpace row_space(const PlotPage& page, std::size_t row) {
  const std::size_t columns = static_cast<std::size_t>(page.columns);
  RowSpace space;
  for (std::size_t i = row * columns; i < std::min((row + 1) * columns, page.panels.size()); ++i) {
    const PlotPanel& panel = page.panels[i];
    space.above = std::max(space.above, row_gap + (panel.title.empty() ? 0 : panel_title) +
                                            (has_marker_labels(panel) ? marker_label : 0));
    space.below = std::max(space.below, axis_numbers + (panel.x.label.empty() ? 0 : axis_label));
  }
  return space;
}

/// Height that the frames of all rows share.
double frame_height(const PlotPage& page) {
  double height = page.height - (page.title.empty() ? 0 : page_title);
  for (std::size_t row = 0; row < page.row_heights.size(); ++row)
    height -= row_space(page, row).above + row_space(page, row).below;
  return height;
}

void check_room(const PlotPage& page) {
  const double sum = std::accumulate(page.row_heights.begin(), page.row_heights.end(), 0.0);
  const double lowest = *std::min_element(page.row_heights.begin(), page.row_heights.end());
  const double missing = smallest_frame * sum / lowest - frame_height(page);
  const double width = page.columns * (left_of_frame + right_of_frame + smallest_frame);
  if (missing > 0 || page.width < width)
    throw UsageError("plot size " + std::to_string(page.width) + "x" + std::to_string(page.height) +
                     ": too small for its panels; give at least " + number_text(std::ceil(width)) + "x" +
                     number_text(std::ceil(page.height + std::max(missing, 0.0))));
}

void check(const PlotPage& page) {
  for (const int side : {page.width, page.height}) {
    if (side < smallest_side || side > largest_side)
      throw UsageError("plot size " + std::to_string(page.width) + "x" + std::to_string(page.height) +
                       ": each side must be from " + std::to_string(smallest_side) + " to " +
                       std::to_string(largest_side) + " pixels");
  }
  for (const double height : page.row_heights) {
    if (!(height > 0) || !std::isfinite(height))
      throw UsageError("plot row height " + number_text(height) + ": must be positive");
  }
  const std::size_t places = page.row_heights.size() * static_cast<std::size_t>(std::max(page.columns, 0));
  if (page.panels.empty() || page.panels.size() > places)
    throw UsageError("plot of " + std::to_string(page.panels.size()) + " panels: must be from 1 to the " +
                     std::to_string(places) + " places of the page");
  check_room(page);
  for (const PlotPanel& panel : page.panels)
    check(panel);
}

std::string block_name(std::size_t panel, const std::string& part) {
  return "$p" + std::to_string(panel) + "_" + part;
}

/// The panel's numbers as named data; a line without numbers interrupts a curve.
std::string data_blocks(const PlotPanel& panel, std::size_t index) {
  std::string text;
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    if (!visible(panel.series[i], panel))
      continue;
    text += block_name(index, std::to_string(i)) + " << END\n";
    for (const glm::dvec2& point : panel.series[i].points)
      text += visible(point, panel) ? number_text(point.x) + " " + number_text(point.y) + "\n" : "\n";
    text += "END\n";
  }
  if (!panel.boxes.empty()) {
    text += block_name(index, "boxes") + " << END\n";
    for (const PlotBox& box : panel.boxes) {
      const glm::dvec2 middle = (box.low + box.high) / 2.0;
      for (const double value : {middle.x, middle.y, box.low.x, box.high.x, box.low.y, box.high.y})
        text += number_text(value) + " ";
      text += std::to_string(box.rgb & 0xffffffU) + "\n";
    }
    text += "END\n";
  }
  return text;
}

std::string axis_commands(const char* name, const PlotAxis& axis) {
  const std::string letter = name;
  std::string text;
  if (axis.logarithmic)
    text += "set logscale " + letter + " 10\nset format " + letter + " '%g'\n";
  if (axis.range)
    text += "set " + letter + "range [" + number_text(axis.range->first) + ":" +
            number_text(axis.range->second) + "]\n";
  if (!axis.ticks.empty()) {
    std::vector<std::string> ticks;
    for (const auto& [at, label] : axis.ticks)
      ticks.push_back(gnuplot_text(label) + " " + number_text(at));
    text += "set " + letter + "tics (" + join(ticks) + ")\n";
  }
  return text;
}

std::string key_commands(KeyPlace place) {
  static const char* const places[] = {"off", "top left Left reverse", "top right",
                                       "bottom left Left reverse", "bottom right"};
  if (place == KeyPlace::none)
    return "set key off\n";
  return std::string("set key ") + places[static_cast<int>(place)] +
         " samplen 2 box linecolor rgb '#cccccc' linewidth 1\n";
}

std::string series_clause(const PlotSeries& series, const std::string& block) {
  static const char* const dashes[] = {"", "1", "2", "3"};
  static const char* const points[] = {"", "7", "2", "6", "4", "8"}; // gnuplot's numbers of the symbols
  const bool lines = series.line != LineStyle::none;
  const bool symbols = series.point != PointStyle::none;
  std::string text = block + " using 1:2 with " +
                     (lines && symbols ? "linespoints"
                      : symbols        ? "points"
                                       : "lines") +
                     " linecolor rgb " + color(series.rgb) + " linewidth " + number_text(series.width);
  if (lines)
    text += std::string(" dashtype ") + dashes[static_cast<int>(series.line)];
  if (symbols)
    text += std::string(" pointtype ") + points[static_cast<int>(series.point)] + " pointsize 0.8";
  return text + (series.name.empty() ? " notitle" : " title " + gnuplot_text(series.name));
}

std::string plot_command(const PlotPanel& panel, std::size_t index) {
  std::vector<std::string> clauses;
  if (!panel.boxes.empty())
    clauses.push_back(
        block_name(index, "boxes") +
        " using 1:2:3:4:5:6:7 with boxxyerror linecolor rgb variable fillstyle solid 1 noborder "
        "notitle");
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    if (visible(panel.series[i], panel))
      clauses.push_back(series_clause(panel.series[i], block_name(index, std::to_string(i))));
  }
  return "plot " + join(clauses, ", ") + "\n";
}

/// A panel's frame in pixels from the page's top left corner. Every frame of a column and of a row has the
/// same edges, whatever the length of its numbers.
struct Frame {
  double left = 0, right = 0, top = 0, bottom = 0;
};

Frame frame_of(const PlotPage& page, std::size_t index) {
  const std::size_t columns = static_cast<std::size_t>(page.columns);
  const std::size_t row = index / columns;
  const double unit =
      frame_height(page) / std::accumulate(page.row_heights.begin(), page.row_heights.end(), 0.0);
  Frame frame;
  frame.top = (page.title.empty() ? 0 : page_title) + row_space(page, row).above;
  for (std::size_t r = 0; r < row; ++r)
    frame.top += row_space(page, r).above + unit * page.row_heights[r] + row_space(page, r).below;
  frame.bottom = frame.top + unit * page.row_heights[row];
  const double width = static_cast<double>(page.width) / page.columns;
  frame.left = width * static_cast<double>(index % columns) + left_of_frame;
  frame.right = width * static_cast<double>(index % columns + 1) - right_of_frame;
  return frame;
}

std::string screen_x(const PlotPage& page, double x) { return "screen " + number_text(x / page.width); }
std::string screen_y(const PlotPage& page, double y) { return "screen " + number_text(1 - y / page.height); }

std::string frame_commands(const PlotPage& page, const Frame& frame) {
  return "set lmargin at " + screen_x(page, frame.left) + "\nset rmargin at " + screen_x(page, frame.right) +
         "\nset tmargin at " + screen_y(page, frame.top) + "\nset bmargin at " +
         screen_y(page, frame.bottom) + "\n";
}

/// A text centred at a pixel. gnuplot's own titles and axis labels stand as many of the terminal's characters
/// away as their neighbours need, and would overlap between panels.
std::string text_command(const PlotPage& page, const std::string& text, double x, double y,
                         const std::string& look = "") {
  if (text.empty())
    return "";
  return "set label " + gnuplot_text(text) + " at " + screen_x(page, x) + ", " + screen_y(page, y) +
         " center" + look + "\n";
}

std::string text_commands(const PlotPage& page, std::size_t index, const Frame& frame) {
  const PlotPanel& panel = page.panels[index];
  const double middle = (frame.left + frame.right) / 2;
  const std::size_t row = index / static_cast<std::size_t>(page.columns);
  const double title =
      frame.top - row_space(page, row).above + row_gap + panel_title / 2; // one line for a row
  return text_command(page, index == 0 ? page.title : "", page.width / 2.0, 0.6 * page_title, " font ',17'") +
         text_command(page, panel.title, middle, title) +
         text_command(page, panel.x.label, middle, frame.bottom + axis_numbers + axis_label / 2) +
         text_command(page, panel.y.label, frame.left - left_of_frame + axis_label / 2,
                      (frame.top + frame.bottom) / 2, " rotate by 90");
}

std::string marker_commands(const PlotPage& page, const PlotMarker& marker, const Frame& frame) {
  const std::string x = "first " + number_text(marker.x);
  std::string text = "set arrow from " + x + ", graph 0 to " + x +
                     ", graph 1 nohead linecolor rgb '#8a6d1d' linewidth 1 dashtype 3 front\n";
  if (marker.label.empty())
    return text;
  const char* const place = marker.side == PlotMarker::Side::left    ? " right offset character 0.3,0"
                            : marker.side == PlotMarker::Side::right ? " left offset character -0.3,0"
                                                                     : " center";
  return text + "set label " + gnuplot_text(marker.label) + " at " + x + ", " +
         screen_y(page, frame.top - marker_label / 2) + place + " font ',12' textcolor rgb '#6d5514'\n";
}

std::string panel_commands(const PlotPage& page, std::size_t index) {
  const PlotPanel& panel = page.panels[index];
  const Frame frame = frame_of(page, index);
  std::string text = "reset\n" + frame_commands(page, frame) + text_commands(page, index, frame) +
                     "set border linecolor rgb '#555555'\nset tics nomirror\n";
  if (panel.grid)
    text += "set grid linetype 1 linecolor rgb '#dddddd' linewidth 1\n";
  text += axis_commands("x", panel.x) + axis_commands("y", panel.y) + key_commands(panel.key);
  for (const PlotRegion& region : panel.regions)
    text += "set object rectangle from first " + number_text(region.low) + ", graph 0 to first " +
            number_text(region.high) + ", graph 1 behind fillcolor rgb " + color(region.rgb) +
            " fillstyle solid 1 noborder\n";
  for (const PlotMarker& marker : panel.markers)
    text += marker_commands(page, marker, frame);
  return text + plot_command(panel, index);
}

} // namespace

PlotFormat plot_format(const std::string& path) {
  const std::string extension = lower(std::filesystem::path(path).extension().string());
  if (extension == ".svg")
    return PlotFormat::svg;
  if (extension == ".png")
    return PlotFormat::png;
  throw UsageError(path + ": plots are written as .svg or .png");
}

std::string gnuplot_text(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'')
      result += '\'';
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
  }
  return result + "'";
}

std::string plot_script(const PlotPage& page, PlotFormat format) {
  check(page);
  std::string text = "set encoding utf8\nset terminal ";
  // Sizes of letters are pixels in an SVG, and points of 4/3 pixels in a PNG.
  text += format == PlotFormat::svg ? "svg" : "pngcairo fontscale 0.75";
  text += " noenhanced size " + std::to_string(page.width) + "," + std::to_string(page.height) +
          " font 'sans-serif,13' background rgb 'white'\n";
  for (std::size_t i = 0; i < page.panels.size(); ++i)
    text += data_blocks(page.panels[i], i);
  text += "set multiplot\n";
  for (std::size_t i = 0; i < page.panels.size(); ++i)
    text += panel_commands(page, i);
  return text + "unset multiplot\n";
}

std::string draw_plot(const PlotPage& page, PlotFormat format) {
  return run_gnuplot(plot_script(page, format));
}

} // namespace slicelens
