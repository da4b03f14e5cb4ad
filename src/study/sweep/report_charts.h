// Which charts follow from a study's results, as plain values.
#pragma once

#include "study/statistics.h"
#include "study/sweep/results.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace slicelens::report {

struct ChartSeries {
  std::string name;               ///< its labels in the chart's `by`; empty for a single line
  std::vector<glm::dvec2> points; ///< by x
  std::vector<std::size_t> rows;  ///< index of each point's row
  std::optional<PowerFit> fit;    ///< where both axes are logarithmic and two x differ
};

struct ChartPanel {
  std::string title; ///< what all its points have in common; empty for a single panel
  std::vector<ChartSeries> series;
};

/// A point that no other one is better than in both.
struct FrontPoint {
  std::size_t row = 0; ///< of StudyResults::rows
  double time = 0;     ///< as shown
  double error = 0;
};

struct ReportChart {
  std::string title;
  std::string x;
  std::string y; ///< with the unit
  bool log_x = false;
  bool log_y = false;
  bool lines = true;           ///< else points alone
  std::vector<std::string> by; ///< columns that a line's name has the labels of
  std::string fitted;          ///< what a fit's exponent is called: "order", "exponent"; empty: none is shown
  std::vector<ChartPanel> panels;
  std::vector<FrontPoint> front;  ///< of quality against time, by time
  std::vector<std::string> notes; ///< what is not in the picture, and why
};

/// How many lines and panels one chart has at most; the notes say what is left out.
inline constexpr std::size_t most_series = 8;
inline constexpr std::size_t most_panels = 6;

/// The study's own, error against render.spacing with the fitted order, time against every varied key of
/// numbers with the fitted exponent, and quality against time with the Pareto front; of these only what has
/// points.
///
/// The error is rmse, else what psnr says of it (10^(−psnr/20), peak 1), else mean_abs, max_abs, flip,
/// 1 − ms_ssim, 1 − ssim. A list of equal numbers ([128, 128]) counts as that number.
std::vector<ReportChart> charts_of(const StudyResults& results);

/// Indices of the points (both smaller is better) that no other point is better than in one and at least as
/// good in the other, by x; of equal points the first.
std::vector<std::size_t> pareto_front(const std::vector<glm::dvec2>& points);

/// As a figure each, drawn by gnuplot. Throws as draw_plot does.
std::string chart_html(const StudyResults& results, const ReportChart& chart, std::size_t number);

} // namespace slicelens::report
