// The report's charts as figures: gnuplot draws, HTML names the lines.
#include "core/errors.h"
#include "study/plot.h"
#include "study/sweep/report_charts.h"
#include "study/sweep/report_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace slicelens::report {

namespace {

constexpr int single_width = 576, single_height = 346; // of a chart with one panel
constexpr int pair_width = 1140, pair_height = 320;    // of two panels side by side
constexpr std::size_t most_charts = 40;
constexpr std::size_t most_bytes = std::size_t{4} << 20; ///< of charts
constexpr std::size_t most_front_rows = 20;

// Dark enough on white, and different in lightness as well as in hue.
constexpr std::array<std::uint32_t, most_series> colors = {0x1f5fa8, 0xc8501e, 0x2a7d3b, 0x7b3fa0,
                                                           0x9a7400, 0x0b7f83, 0x4d4d4d, 0xb8195e};
constexpr std::array<PointStyle, 5> shapes = {PointStyle::dot, PointStyle::square, PointStyle::triangle,
                                              PointStyle::circle, PointStyle::cross};

std::string hex(std::uint32_t rgb) {
  char text[16];
  std::snprintf(text, sizeof text, "#%06x", rgb);
  return text;
}

/// A line and its symbol, for the list of lines.
std::string swatch(std::size_t series, bool line) {
  const std::string color = hex(colors[series % colors.size()]);
  static const std::array<const char*, 5> marks = {
      "<circle cx=\"14\" cy=\"6\" r=\"3.5\" fill=\"COLOR\" stroke=\"none\"/>",
      "<rect x=\"10.5\" y=\"2.5\" width=\"7\" height=\"7\" fill=\"none\"/>",
      "<path d=\"M14 1.5 L18 9 L10 9 Z\" fill=\"none\"/>",
      "<circle cx=\"14\" cy=\"6\" r=\"3.5\" fill=\"none\"/>",
      "<path d=\"M10.5 2.5 L17.5 9.5 M10.5 9.5 L17.5 2.5\" fill=\"none\"/>"};
  std::string mark = marks[series % marks.size()];
  if (const std::size_t at = mark.find("COLOR"); at != std::string::npos)
    mark.replace(at, 5, color);
  return "<svg class=\"swatch\" width=\"28\" height=\"12\" viewBox=\"0 0 28 12\" aria-hidden=\"true\"><g "
         "stroke=\"" +
         color + "\" stroke-width=\"1.6\">" + (line ? "<path d=\"M1 6 H27\"/>" : "") + mark + "</g></svg>";
}

/// Least and largest of what is seen, with room around.
std::pair<double, double> range_of(const ReportChart& chart, int axis) {
  const bool log = axis == 0 ? chart.log_x : chart.log_y;
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const ChartPanel& panel : chart.panels) {
    for (const ChartSeries& series : panel.series) {
      for (const glm::dvec2& point : series.points) {
        if ((chart.log_x && point.x <= 0) || (chart.log_y && point.y <= 0))
          continue;
        low = std::min(low, point[axis]);
        high = std::max(high, point[axis]);
      }
    }
  }
  if (low > high)
    return {1, 10};
  if (log) {
    const double room = std::max(std::pow(high / low, 0.06), 1.12);
    return {low / room, high * room};
  }
  if (axis == 1 && low > 0 && low < high / 2) // a time is seen beside nothing
    low = 0;
  const double room = high > low ? 0.06 * (high - low) : std::max(std::abs(high) * 0.1, 1e-9);
  return {low == 0 && axis == 1 ? 0 : low - room, high + room};
}

/// "0.05", "10⁻⁵", "2·10⁶"
std::string tick_label(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  const double size = std::abs(value);
  if (size == 0 || (size >= 0.999e-4 && size < 1e5))
    return text;
  const int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  std::snprintf(text, sizeof text, "%.6g", value / std::pow(10.0, exponent));
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string power = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent)))
    power += digits[digit - '0'];
  return std::string(text) == "1" ? power : std::string(text) + "·" + power;
}

/// 1, 2 and 5 in every decade where few decades are seen, 1 and 3 where some more are, else the decades.
std::vector<std::pair<double, std::string>> log_ticks(double low, double high) {
  const double decades = std::log10(high / low);
  std::vector<double> steps = decades <= 2.6 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
  if (decades > 2.6 && decades <= 4)
    steps = {1, 3};
  if (decades < 0.7)
    steps = {1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 7, 8, 9};
  std::vector<std::pair<double, std::string>> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::floor(std::log10(high)));
  const int every = decades > 8 ? 2 : 1;
  for (int e = first; e <= last; e += every) {
    for (const double step : steps) {
      const double value = step * std::pow(10.0, e);
      if (value >= low && value <= high)
        ticks.emplace_back(value, tick_label(value));
    }
  }
  return ticks;
}

/// The x values themselves where they are few and far enough apart.
std::vector<std::pair<double, std::string>> x_ticks(const ReportChart& chart,
                                                    std::pair<double, double> range) {
  std::vector<double> values;
  for (const ChartPanel& panel : chart.panels) {
    for (const ChartSeries& series : panel.series) {
      for (const glm::dvec2& point : series.points)
        values.push_back(point.x);
    }
  }
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  const auto place = [&](double x) {
    return chart.log_x ? std::log(x / range.first) / std::log(range.second / range.first)
                       : (x - range.first) / (range.second - range.first);
  };
  std::vector<std::pair<double, std::string>> ticks;
  double last = -1;
  for (const double x : values) {
    if (chart.log_x && x <= 0)
      continue;
    if (last >= 0 && place(x) - last < 0.075)
      return chart.log_x ? log_ticks(range.first, range.second) : decltype(ticks){};
    last = place(x);
    ticks.emplace_back(x, tick_label(x));
  }
  return ticks;
}

PlotSeries plot_series(const ReportChart& chart, const ChartSeries& series, std::size_t index) {
  PlotSeries plot;
  plot.points = series.points;
  plot.rgb = colors[index % colors.size()];
  plot.line = chart.lines ? LineStyle::solid : LineStyle::none;
  plot.width = 1.6;
  plot.point = shapes[index % shapes.size()];
  return plot;
}

PlotPanel plot_panel(const ReportChart& chart, const ChartPanel& panel) {
  PlotPanel plot;
  plot.title = panel.title;
  plot.x.label = chart.x;
  plot.y.label = chart.y;
  plot.x.logarithmic = chart.log_x;
  plot.y.logarithmic = chart.log_y;
  plot.x.range = range_of(chart, 0);
  plot.y.range = range_of(chart, 1);
  plot.x.ticks =
      chart.lines ? x_ticks(chart, *plot.x.range) : log_ticks(plot.x.range->first, plot.x.range->second);
  if (chart.log_y)
    plot.y.ticks = log_ticks(plot.y.range->first, plot.y.range->second);
  if (!chart.front.empty()) {
    PlotSeries front;
    front.rgb = 0x222222;
    front.line = LineStyle::dashed;
    front.width = 1.4;
    for (const FrontPoint& point : chart.front)
      front.points.push_back({point.time, point.error});
    plot.series.push_back(front);
  }
  for (std::size_t i = 0; i < panel.series.size(); ++i)
    plot.series.push_back(plot_series(chart, panel.series[i], i));
  return plot;
}

PlotPage plot_page(const ReportChart& chart) {
  PlotPage page;
  const bool single = chart.panels.size() == 1;
  page.columns = single ? 1 : 2;
  page.row_heights.assign((chart.panels.size() + 1) / 2, 1.0);
  page.width = single ? single_width : pair_width;
  page.height = single ? single_height : pair_height * static_cast<int>(page.row_heights.size());
  for (const ChartPanel& panel : chart.panels)
    page.panels.push_back(plot_panel(chart, panel));
  return page;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Several of gnuplot's pictures in one page: their names must differ, and those of groups would be shown.
std::string inline_svg(std::string svg, const std::string& title, std::size_t number, int width, int height) {
  const std::size_t body = svg.find("</desc>");
  svg = body == std::string::npos ? "" : svg.substr(body + 7);
  const std::string prefix = "c" + std::to_string(number) + "-";
  for (const char* quote : {"\"", "'"}) {
    replace_all(svg, std::string("id=") + quote, std::string("id=") + quote + prefix);
    replace_all(svg, std::string("href=") + quote + "#", std::string("href=") + quote + "#" + prefix);
  }
  replace_all(svg, "url(#", "url(#" + prefix);
  for (std::size_t at = svg.find("<title>"); at != std::string::npos; at = svg.find("<title>", at)) {
    const std::size_t end = svg.find("</title>", at);
    if (end == std::string::npos)
      break;
    svg.erase(at, end + 8 - at);
  }
  return "<svg class=\"chart\" role=\"img\" aria-label=\"" + escaped(title) + "\" viewBox=\"0 0 " +
         std::to_string(width) + " " + std::to_string(height) +
         "\" style=\"max-width: " + std::to_string(width) + "px\">" + svg;
}

std::string decimals(double value, int count) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", count, std::abs(value));
  const bool zero = std::string(text).find_first_not_of("0.") == std::string::npos;
  return (value < 0 && !zero ? "−" : "") + std::string(text);
}

/// Exponent, R² and how many points they follow from.
std::string fit_cells(const ChartSeries& series) {
  const auto seen = std::count_if(series.points.begin(), series.points.end(),
                                  [](const glm::dvec2& point) { return point.x > 0 && point.y > 0; });
  std::string exponent = "–";
  std::string r_squared = "–";
  if (series.fit) {
    exponent = decimals(series.fit->exponent, 2);
    if (series.fit->standard_error)
      exponent += " ± " + decimals(*series.fit->standard_error, 2);
    if (series.fit->standard_error && series.fit->r_squared) // two points are always on a line
      r_squared = decimals(*series.fit->r_squared, 4);
  }
  return element("td", exponent, "class=\"number\"") + element("td", r_squared, "class=\"number\"") +
         element("td", std::to_string(seen), "class=\"number\"");
}

/// The lines with their fits; for several panels one list for each.
std::string lines_html(const ReportChart& chart) {
  const bool fits = !chart.fitted.empty() && chart.log_x && chart.log_y;
  const bool one = chart.panels.size() == 1 && chart.panels.front().series.size() == 1;
  if (one && !fits && chart.panels.front().series.front().name.empty())
    return "";
  std::string rows;
  for (const ChartPanel& panel : chart.panels) {
    if (!panel.title.empty() && fits)
      rows += "<tr><th colspan=\"4\" class=\"panel\"><code>" + escaped(panel.title) + "</code></th></tr>\n";
    for (std::size_t i = 0; i < panel.series.size(); ++i) {
      const ChartSeries& series = panel.series[i];
      const std::string name = series.name.empty() ? "all rows" : "<code>" + escaped(series.name) + "</code>";
      rows +=
          "<tr>" + element("td", swatch(i, chart.lines) + name) + (fits ? fit_cells(series) : "") + "</tr>\n";
    }
    if (!fits) // the lines of all panels have the same names
      break;
  }
  std::string by;
  for (const std::string& column : chart.by)
    by += (by.empty() ? "" : ", ") + code(column);
  std::string head = "<th>" + (by.empty() ? "line" : by) + "</th>";
  if (fits)
    head += "<th class=\"number\">" + escaped(chart.fitted) +
            "</th><th class=\"number\">R²</th><th class=\"number\">points</th>";
  head = "<thead><tr>" + head + "</tr></thead>";
  return "<table class=\"lines\">" + head + "<tbody>\n" + rows + "</tbody></table>\n";
}

std::string front_html(const StudyResults& results, const ReportChart& chart) {
  if (chart.front.empty())
    return "";
  std::string head = "<th class=\"number\">#</th>";
  for (const Label& label : results.rows[chart.front.front().row].combination.labels)
    head += element("th", code(label.first));
  head += element("th", escaped(chart.x), "class=\"number\"") +
          element("th", escaped(chart.y), "class=\"number\"");
  std::string rows;
  for (std::size_t i = 0; i < std::min(chart.front.size(), most_front_rows); ++i) {
    const FrontPoint& point = chart.front[i];
    const Row& row = results.rows[point.row];
    const std::string index = std::to_string(row.combination.index);
    rows += "<tr>" + element("td", element("a", index, "href=\"#row-" + index + "\""), "class=\"number\"");
    for (const Label& label : row.combination.labels)
      rows += element("td", "<code>" + escaped(label.second) + "</code>");
    rows += element("td", number_html(point.time), "class=\"number\"") +
            element("td", number_html(point.error), "class=\"number\"") + "</tr>\n";
  }
  std::string html =
      "<p>On the front (dashed): nothing measured is both faster and nearer to the reference.</p>\n"
      "<table class=\"lines\"><thead><tr>" +
      head + "</tr></thead><tbody>\n" + rows + "</tbody></table>\n";
  if (chart.front.size() > most_front_rows)
    html += "<p>The first " + std::to_string(most_front_rows) + " of " + std::to_string(chart.front.size()) +
            ".</p>\n";
  return html;
}

} // namespace

std::string chart_html(const StudyResults& results, const ReportChart& chart, std::size_t number) {
  std::string html = element("h3", escaped(chart.title)) + "\n";
  if (!chart.panels.empty()) {
    const PlotPage page = plot_page(chart);
    html += inline_svg(draw_plot(page, PlotFormat::svg), chart.title, number, page.width, page.height) +
            "\n<figcaption>" + lines_html(chart) + front_html(results, chart) + "</figcaption>\n";
  }
  for (const std::string& note : chart.notes)
    html += element("p", escaped(note), "class=\"note\"") + "\n";
  const bool wide_front = !chart.front.empty() && results.rows.front().combination.labels.size() > 4;
  return element("figure", html,
                 chart.panels.size() > 1 || wide_front ? "class=\"plot whole\"" : "class=\"plot\"") +
         "\n";
}

std::string charts_html(const StudyResults& results) {
  const std::vector<ReportChart> charts = charts_of(results);
  if (charts.empty())
    return "<p>No chart: no key of numbers was varied of which there are times or errors.</p>\n";
  std::string html;
  std::string notes;
  for (std::size_t i = 0; i < std::min(charts.size(), most_charts); ++i) {
    try {
      const std::string one = chart_html(results, charts[i], i);
      if (html.size() + one.size() > most_bytes)
        notes +=
            element("p", escaped(charts[i].title) + " has too many points for this page.", "class=\"note\"") +
            "\n";
      else
        html += one;
    } catch (const FileError& error) { // gnuplot is missing or failed, for all alike
      return element("p", "The charts are missing: " + escaped(error.what()), "class=\"notice\"") + "\n";
    } catch (const UsageError& error) { // a chart in which nothing can be seen
      notes +=
          element("p", escaped(charts[i].title + " is not drawn: " + error.what()), "class=\"note\"") + "\n";
    }
  }
  if (charts.size() > most_charts)
    notes += "<p class=\"note\">The first " + std::to_string(most_charts) + " of " +
             std::to_string(charts.size()) + " charts.</p>\n";
  return "<p>Points are medians. A fitted order or exponent is the slope of the least-squares line through "
         "the "
         "logarithms, with its standard error; a small error says that the points lie on a line, not that "
         "the line "
         "goes on.</p>\n<div class=\"plots\">\n" +
         html + "</div>\n" + notes;
}

} // namespace slicelens::report
