// Summaries of repeated measurements, and the order at which an error falls.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace slicelens {

/// First quartile, median and third quartile.
struct Quartiles {
  double first = 0;
  double median = 0;
  double third = 0;
};

/// The middle value, or the mean of the two middle ones. Throws UsageError for no values or a NaN.
double median(const std::vector<double>& values);

/// Quantiles at 1/4, 1/2 and 3/4 by linear interpolation at position p·(n − 1) of the sorted values (type 7
/// of Hyndman and Fan, "Sample Quantiles in Statistical Packages", 1996; NumPy's and R's default). Throws as
/// median does.
Quartiles quartiles(const std::vector<double>& values);

/// √(Σ(v − mean)² / (n − 1)). Throws UsageError for fewer than two values.
double sample_standard_deviation(const std::vector<double>& values);

/// The smallest value. Throws as median does.
double minimum(const std::vector<double>& values);

/// Two of the values with the population's median between them.
struct MedianInterval {
  double low = 0;
  double high = 0;
  double confidence = 0; ///< that is reached: at least what was asked for
};

/// The shortest confidence interval for the median of the form [x_(k), x_(n+1−k)], of the sorted values, that
/// reaches `confidence`: 1 − 2·P(B ≤ k − 1) for B binomial of n and 1/2, whatever the values' distribution
/// (H. A. David and H. N. Nagaraja, "Order Statistics", 2003, §7.1). Nothing when even [x_(1), x_(n)] does
/// not. Throws UsageError unless 0 < confidence < 1, and as median does.
std::optional<MedianInterval> median_interval(const std::vector<double>& values, double confidence = 0.95);

/// Fewest values for which median_interval gives one: the smallest n with 1 − 2^(1−n) ≥ confidence (6 for
/// .95, 8 for .99). Throws UsageError unless 0 < confidence < 1.
std::size_t smallest_repetitions(double confidence = 0.95);

/// How many values make the half-width of median_interval at most `relative_half_width` of the median, judged
/// by those at hand: their number when they suffice; else more, as the width falls by the square root of the
/// number; smallest_repetitions where they give no interval. An estimate: ask again with the new values.
/// Throws UsageError unless relative_half_width > 0 and the median is positive, and as median_interval does.
std::size_t repetitions_needed(const std::vector<double>& values, double relative_half_width,
                               double confidence = 0.95);

/// values[i] / baseline[i], and their quartiles: runs measured in turn share what the machine did meanwhile,
/// which their ratio loses and a ratio of medians keeps.
struct PairedRatios {
  std::vector<double> ratios;
  Quartiles quartiles;
};

/// Throws UsageError unless there are as many values as baselines, at least one, all positive and finite.
PairedRatios paired_ratios(const std::vector<double>& values, const std::vector<double>& baseline);

/// y ≈ factor·x^exponent: the least-squares line through the points (ln x, ln y).
struct PowerFit {
  double exponent = 0;
  double factor = 0;
  /// Of the exponent, √(Σr²/(n − 2) / Σ(ln x − mean)²) of the residuals r; nothing for two points, which
  /// leave none.
  std::optional<double> standard_error;
  /// 1 − Σr² / Σ(ln y − mean)²: 1 where the points lie on the line; nothing when all y are equal.
  std::optional<double> r_squared;
};

/// Throws UsageError unless there are at least two pairs, all positive and finite, with two different x.
PowerFit fitted_power(const std::vector<double>& x, const std::vector<double>& y);

/// The order p of error ≈ C·hᵖ: the exponent of fitted_power. Throws as that does.
double fitted_order(const std::vector<double>& h, const std::vector<double>& errors);

} // namespace slicelens
