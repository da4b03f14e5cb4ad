#include "study/statistics.h"

#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace slicelens {

namespace {

std::vector<double> sorted(const std::vector<double>& values) {
  if (values.empty())
    throw UsageError("a median or quartile needs at least one value");
  if (std::any_of(values.begin(), values.end(), [](double v) { return std::isnan(v); }))
    throw UsageError("a median or quartile needs numbers; one of the values is NaN");
  std::vector<double> result = values;
  std::sort(result.begin(), result.end());
  return result;
}

double quantile(const std::vector<double>& ascending, double p) {
  const double position = p * static_cast<double>(ascending.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double share = position - static_cast<double>(below);
  if (share == 0) // also keeps an infinite neighbour out
    return ascending[below];
  return ascending[below] * (1 - share) + ascending[below + 1] * share;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<double> logarithms(const std::vector<double>& values) {
  std::vector<double> result;
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value))
      throw UsageError("a convergence order needs positive, finite sizes and errors");
    result.push_back(std::log(value));
  }
  return result;
}

} // namespace

double median(const std::vector<double>& values) { return quantile(sorted(values), 0.5); }

Quartiles quartiles(const std::vector<double>& values) {
  const std::vector<double> ascending = sorted(values);
  return {quantile(ascending, 0.25), quantile(ascending, 0.5), quantile(ascending, 0.75)};
}

double sample_standard_deviation(const std::vector<double>& values) {
  if (values.size() < 2)
    throw UsageError("a standard deviation needs at least two values");
  const double middle = mean(values);
  double squares = 0;
  for (const double value : values)
    squares += (value - middle) * (value - middle);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

double fitted_order(const std::vector<double>& h, const std::vector<double>& errors) {
  if (h.size() != errors.size() || h.size() < 2)
    throw UsageError("a convergence order needs at least two sizes, and one error for each");
  const std::vector<double> x = logarithms(h);
  const std::vector<double> y = logarithms(errors);
  const double x_mean = mean(x);
  const double y_mean = mean(y);
  double xx = 0;
  double xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
  }
  if (std::all_of(h.begin(), h.end(), [&](double size) { return size == h.front(); }))
    throw UsageError("a convergence order needs at least two different sizes");
  return xy / xx;
}

} // namespace slicelens
