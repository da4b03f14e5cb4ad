// Pages of line charts as plain values, drawn by gnuplot.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slicelens {

enum class LineStyle { none, solid, dashed, dotted };
enum class PointStyle { none, dot, cross, circle, square, triangle };
enum class KeyPlace { none, top_left, top_right, bottom_left, bottom_right };

/// Points joined in their order. A point that is not finite, or not positive on a logarithmic axis, is left
/// out and interrupts the line.
struct PlotSeries {
  std::string name; ///< in the key; empty: not listed
  std::vector<glm::dvec2> points;
  std::uint32_t rgb = 0x1f5fa8; ///< 0xRRGGBB
  LineStyle line = LineStyle::solid;
  double width = 2; ///< pixels
  PointStyle point = PointStyle::none;
};

/// A vertical line at x through the whole panel.
struct PlotMarker {
  enum class Side { left, center, right };
  double x = 0;
  std::string label;        ///< above the frame
  Side side = Side::center; ///< of the line, where the label stands
};

/// A shaded range of x behind everything else.
struct PlotRegion {
  double low = 0;
  double high = 1;
  std::uint32_t rgb = 0xf3eed9;
};

/// A filled rectangle, corners in axis coordinates. Later ones cover earlier ones.
struct PlotBox {
  glm::dvec2 low{0};
  glm::dvec2 high{1};
  std::uint32_t rgb = 0;
};

struct PlotAxis {
  std::string label;
  std::optional<std::pair<double, double>> range;    ///< low, high; else from the points
  bool logarithmic = false;                          ///< base 10
  std::vector<std::pair<double, std::string>> ticks; ///< in place of numbers, where there are any
};

struct PlotPanel {
  std::string title;
  PlotAxis x;
  PlotAxis y;
  std::vector<PlotRegion> regions;
  std::vector<PlotBox> boxes;
  std::vector<PlotMarker> markers;
  std::vector<PlotSeries> series; ///< the first is drawn first
  KeyPlace key = KeyPlace::none;
  bool grid = true;
};

/// Panels in a grid, row by row from the top left.
struct PlotPage {
  std::string title;
  int width = 1200; ///< pixels, 200 to 8192
  int height = 900;
  std::vector<double> row_heights = {1}; ///< relative; one for each row
  int columns = 1;
  std::vector<PlotPanel> panels; ///< at most rows · columns
};

enum class PlotFormat { svg, png };

/// By the extension of `path` (case does not matter). Throws UsageError naming .svg and .png for another one.
PlotFormat plot_format(const std::string& path);

/// gnuplot's commands for the page, data included. All texts are plain: nothing in them is a command or
/// markup; control characters become blanks. Throws UsageError for a page that cannot be drawn: a size out of
/// range, more panels than places, a row height that is not positive, a panel in which nothing can be seen, a
/// marker or region that is not finite.
std::string plot_script(const PlotPage& page, PlotFormat format);

/// The bytes of the picture; the same page and fonts give the same bytes. Throws as plot_script and
/// run_gnuplot do.
std::string draw_plot(const PlotPage& page, PlotFormat format);

/// Text as a gnuplot string in single quotes, where only the quote itself is special.
std::string gnuplot_text(const std::string& text);

} // namespace slicelens
