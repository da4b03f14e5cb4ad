#include "study/sweep/report_charts.h"

#include "core/text.h"
#include "study/sweep/report_parts.h"
#include "study/sweep/report_split.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace slicelens::report {

namespace {

struct Quantity {
  std::string name;
  std::function<std::optional<double>(const Row&)> of; ///< as shown
};

std::optional<PowerFit> fit_of(const std::vector<glm::dvec2>& points) {
  std::vector<double> x, y;
  for (const glm::dvec2& point : points) {
    if (point.x > 0 && point.y > 0) {
      x.push_back(point.x);
      y.push_back(point.y);
    }
  }
  if (x.size() < 2 || std::all_of(x.begin(), x.end(), [&](double one) { return one == x.front(); }))
    return std::nullopt;
  return fitted_power(x, y);
}

std::size_t invisible_points(const ReportChart& chart) {
  std::size_t count = 0;
  for (const ChartPanel& panel : chart.panels) {
    for (const ChartSeries& series : panel.series)
      count += static_cast<std::size_t>(
          std::count_if(series.points.begin(), series.points.end(), [&](const glm::dvec2& p) {
            return (chart.log_x && p.x <= 0) || (chart.log_y && p.y <= 0);
          }));
  }
  return count;
}

void fill_panels(ReportChart& chart, const Split& split, const Quantity& x, const Quantity& y) {
  // Every panel names its lines alike, so that a colour means the same in all.
  const std::vector<Names> lines = tuples(split.rows, split.series);
  chart.by = split.series;
  for (const Names& place : tuples(split.rows, split.panels)) {
    ChartPanel panel;
    panel.title = tuple_text(split.panels, place);
    for (const Names& line : lines) {
      ChartSeries series;
      series.name = join(line);
      Rows own;
      for (const Row* row : split.rows) {
        if (labels_of(*row, split.panels) == place && labels_of(*row, split.series) == line)
          own.push_back(row);
      }
      std::stable_sort(own.begin(), own.end(),
                       [&](const Row* a, const Row* b) { return *x.of(*a) < *x.of(*b); });
      for (const Row* row : own) {
        series.points.push_back({*x.of(*row), *y.of(*row)});
        series.rows.push_back(row->combination.index);
      }
      if (chart.log_x && chart.log_y && !chart.fitted.empty())
        series.fit = fit_of(series.points);
      panel.series.push_back(std::move(series));
    }
    chart.panels.push_back(std::move(panel));
  }
  chart.notes.insert(chart.notes.end(), split.notes.begin(), split.notes.end());
  if (const std::size_t count = invisible_points(chart))
    chart.notes.push_back(std::to_string(count) + (count == 1 ? " point is" : " points are") +
                          " 0, which a logarithmic axis does not show.");
}

Rows rows_with(const StudyResults& results, const Quantity& x, const Quantity& y) {
  Rows rows;
  for (const Row& row : results.rows) {
    const auto a = row.status == RowStatus::failed ? std::nullopt : x.of(row);
    const auto b = a ? y.of(row) : std::nullopt;
    if (b && std::isfinite(*a) && std::isfinite(*b))
      rows.push_back(&row);
  }
  return rows;
}

bool can_be_logarithmic(const Rows& rows, const Quantity& quantity) {
  return std::any_of(rows.begin(), rows.end(), [&](const Row* row) { return *quantity.of(*row) > 0; }) &&
         std::all_of(rows.begin(), rows.end(), [&](const Row* row) { return *quantity.of(*row) >= 0; });
}

bool all_positive(const Rows& rows, const Quantity& quantity) {
  return std::all_of(rows.begin(), rows.end(), [&](const Row* row) { return *quantity.of(*row) > 0; });
}

bool varies(const Rows& rows, const Quantity& quantity) {
  return std::any_of(rows.begin(), rows.end(),
                     [&](const Row* row) { return *quantity.of(*row) != *quantity.of(*rows.front()); });
}

/// Any column of the results, times and bytes in the unit that suits them.
Quantity column_quantity(const StudyResults& results, const std::string& column) {
  const Names varied = varied_columns(results);
  if (contains(varied, column))
    return {column, [&results, column](const Row& row) { return axis_number(results, row, column); }};
  const Unit unit = unit_of(results, column);
  return {column + (unit.name.empty() ? "" : ", " + unit.name), [&results, column, unit](const Row& row) {
            const auto number = number_in(results, row, column);
            return number ? std::optional<double>(*number * unit.scale) : std::nullopt;
          }};
}

/// What errors are read from; nothing without such a metric.
std::optional<Quantity> error_quantity(const StudyResults& results) {
  const auto from = [&results](const std::string& column, const std::function<double(double)>& f) {
    return [&results, column, f](const Row& row) -> std::optional<double> {
      const auto value = number_in(results, row, column);
      return value ? std::optional<double>(f(*value)) : std::nullopt;
    };
  };
  const auto same = [](double value) { return value; };
  const auto below_1 = [](double value) { return 1 - value; };
  const auto of_psnr = [](double value) { return std::pow(10.0, -value / 20); };
  const std::vector<std::tuple<const char*, const char*, std::function<double(double)>>> all = {
      {"rmse", "rmse", same},         {"psnr", "rmse (of psnr)", of_psnr},
      {"mean_abs", "mean_abs", same}, {"max_abs", "max_abs", same},
      {"flip", "flip", same},         {"ms_ssim", "1 − ms_ssim", below_1},
      {"ssim", "1 − ssim", below_1}};
  for (const auto& [metric, name, f] : all) {
    if (contains(results.study.metrics, metric))
      return Quantity{name, from(metric, f)};
  }
  return std::nullopt;
}

bool is_angle(const std::string& column) {
  for (const char* end : {"azimuth", "elevation", "roll", "angle"}) {
    if (column.ends_with(end))
      return true;
  }
  return false;
}

void add_error_chart(const StudyResults& results, std::vector<ReportChart>& charts) {
  const auto error = error_quantity(results);
  const Quantity spacing = column_quantity(results, "render.spacing");
  if (!error || !contains(varied_columns(results), "render.spacing"))
    return;
  const Rows rows = rows_with(results, spacing, *error);
  if (rows.empty() || !varies(rows, spacing) || !can_be_logarithmic(rows, *error) ||
      !all_positive(rows, spacing))
    return;
  ReportChart chart;
  chart.title = "Error against spacing";
  chart.x = "render.spacing";
  chart.y = error->name;
  chart.log_x = chart.log_y = true;
  chart.fitted = "order";
  fill_panels(chart, split_of(rows, other_columns(results, rows, "render.spacing"), {}), spacing, *error);
  charts.push_back(std::move(chart));
}

void add_time_charts(const StudyResults& results, std::vector<ReportChart>& charts) {
  const Quantity time = column_quantity(results, "draw_s");
  for (const std::string& column : varied_columns(results)) {
    const Quantity x = column_quantity(results, column);
    const Rows rows = rows_with(results, x, time);
    // A key is one of numbers when it is so in every row, not where some of its labels happen to be.
    const bool numbers = std::all_of(results.rows.begin(), results.rows.end(),
                                     [&](const Row& row) { return x.of(row).has_value(); });
    if (!numbers || rows.empty() || !varies(rows, x))
      continue;
    ReportChart chart;
    chart.title = "Time against " + column;
    chart.x = x.name;
    chart.y = time.name;
    chart.log_x = chart.log_y = all_positive(rows, x) && all_positive(rows, time) && !is_angle(column);
    chart.fitted = "exponent";
    fill_panels(chart, split_of(rows, other_columns(results, rows, column), {}), x, time);
    charts.push_back(std::move(chart));
  }
}

void add_front_chart(const StudyResults& results, std::vector<ReportChart>& charts) {
  const auto error = error_quantity(results);
  const Quantity time = column_quantity(results, "draw_s");
  if (!error)
    return;
  const Rows rows = rows_with(results, time, *error);
  if (rows.size() < 3 || !can_be_logarithmic(rows, *error) || !all_positive(rows, time))
    return;
  ReportChart chart;
  chart.title = "Quality against time";
  chart.x = time.name;
  chart.y = error->name;
  chart.log_x = chart.log_y = true;
  chart.lines = false;
  Split split;
  split.rows = rows;
  for (const std::string& column : texts_first(results, varied_columns(results))) {
    Names more = split.series;
    more.push_back(column);
    if (tuples(rows, more).size() <= most_series && tuples(rows, {column}).size() > 1)
      split.series = more;
  }
  fill_panels(chart, split, time, *error);
  std::vector<glm::dvec2> points;
  for (const Row* row : rows)
    points.push_back({*time.of(*row), *error->of(*row)});
  for (const std::size_t i : pareto_front(points)) {
    const auto row = static_cast<std::size_t>(rows[i] - results.rows.data());
    chart.front.push_back({row, points[i].x, points[i].y});
  }
  charts.push_back(std::move(chart));
}

/// Along a varied column everything else that varies makes lines and panels. What was measured, such as
/// fragments, has no values to hold the rest at: all points of a line are one line.
Names columns_beside(const StudyResults& results, const Rows& rows, const StudyChart& wanted) {
  for (const SweepAxis& axis : results.study.axes) {
    for (const Label& label : axis.values.front().labels) {
      if (label.first == wanted.x)
        return other_columns(results, rows, wanted.x);
    }
  }
  return wanted.by;
}

void add_study_charts(const StudyResults& results, std::vector<ReportChart>& charts) {
  for (const StudyChart& wanted : results.study.charts) {
    const Quantity x = column_quantity(results, wanted.x);
    const Quantity y = column_quantity(results, wanted.y);
    const Rows rows = rows_with(results, x, y);
    ReportChart chart;
    chart.title = wanted.title.empty() ? wanted.y + " against " + wanted.x : wanted.title;
    chart.x = x.name;
    chart.y = y.name;
    if (rows.empty() || !varies(rows, x)) {
      chart.notes = {"No chart: fewer than two combinations differ in " + wanted.x + " and have " + wanted.y +
                     "."};
      charts.push_back(std::move(chart));
      continue;
    }
    chart.log_x = wanted.logarithmic && can_be_logarithmic(rows, x);
    chart.log_y = wanted.logarithmic && can_be_logarithmic(rows, y);
    chart.fitted = "exponent";
    fill_panels(chart, split_of(rows, columns_beside(results, rows, wanted), wanted.by), x, y);
    charts.push_back(std::move(chart));
  }
}

} // namespace

std::vector<std::size_t> pareto_front(const std::vector<glm::dvec2>& points) {
  std::vector<std::size_t> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    if (front.empty() || points[i].y < points[front.back()].y)
      front.push_back(i);
  }
  return front;
}

std::vector<ReportChart> charts_of(const StudyResults& results) {
  std::vector<ReportChart> charts;
  add_study_charts(results, charts);
  add_error_chart(results, charts);
  add_time_charts(results, charts);
  add_front_chart(results, charts);
  return charts;
}

} // namespace slicelens::report
