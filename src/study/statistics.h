// Summaries of repeated measurements, and the order at which an error falls.
#pragma once

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

/// The order p of error ≈ C·hᵖ: the slope of the least-squares line through (log h, log error). Throws
/// UsageError unless there are at least two pairs, all positive and finite, with two different h.
double fitted_order(const std::vector<double>& h, const std::vector<double>& errors);

} // namespace slicelens
