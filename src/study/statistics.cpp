#include "study/statistics.h"

#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>
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
      throw UsageError("a fitted exponent or order needs positive, finite sizes and values");
    result.push_back(std::log(value));
  }
  return result;
}

/// P(B = k) for B binomial of n and 1/2. Exact products while 2⁻ⁿ is a double, logarithms beyond.
double binomial_half(std::size_t n, std::size_t k) {
  const auto real = [](std::size_t value) { return static_cast<double>(value); };
  if (n > 1000) {
    return std::exp(std::lgamma(real(n + 1)) - std::lgamma(real(k + 1)) - std::lgamma(real(n - k + 1)) -
                    real(n) * std::numbers::ln2);
  }
  double choices = 1;
  for (std::size_t i = 1; i <= k; ++i)
    choices = choices * real(n - k + i) / real(i);
  return std::ldexp(choices, -static_cast<int>(n));
}

void check_confidence(double confidence) {
  if (!(confidence > 0 && confidence < 1))
    throw UsageError("a confidence must lie between 0 and 1");
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

double minimum(const std::vector<double>& values) { return sorted(values).front(); }

std::optional<MedianInterval> median_interval(const std::vector<double>& values, double confidence) {
  check_confidence(confidence);
  const std::vector<double> ascending = sorted(values);
  const std::size_t n = ascending.size();
  std::optional<MedianInterval> interval;
  double below = 0; // P(B ≤ k − 1)
  for (std::size_t k = 1; 2 * k <= n; ++k) {
    below += binomial_half(n, k - 1);
    if (1 - 2 * below < confidence)
      break;
    interval = {ascending[k - 1], ascending[n - k], 1 - 2 * below};
  }
  return interval;
}

std::size_t smallest_repetitions(double confidence) {
  check_confidence(confidence);
  std::size_t n = 2;
  while (1 - std::exp2(1 - static_cast<double>(n)) < confidence)
    ++n;
  return n;
}

std::size_t repetitions_needed(const std::vector<double>& values, double relative_half_width,
                               double confidence) {
  if (!(relative_half_width > 0))
    throw UsageError("the half-width that is asked for must be above 0");
  const auto interval = median_interval(values, confidence);
  const double middle = median(values);
  if (!(middle > 0))
    throw UsageError("a relative half-width needs a positive median");
  if (!interval)
    return smallest_repetitions(confidence);
  const double share = (interval->high - interval->low) / 2 / middle / relative_half_width;
  if (share <= 1)
    return values.size();
  return static_cast<std::size_t>(std::ceil(static_cast<double>(values.size()) * share * share));
}

PairedRatios paired_ratios(const std::vector<double>& values, const std::vector<double>& baseline) {
  if (values.size() != baseline.size() || values.empty())
    throw UsageError("ratios need one baseline for each value, and at least one");
  PairedRatios result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (const double value : {values[i], baseline[i]}) {
      if (!(value > 0) || !std::isfinite(value))
        throw UsageError("ratios need positive, finite values and baselines");
    }
    result.ratios.push_back(values[i] / baseline[i]);
  }
  result.quartiles = quartiles(result.ratios);
  return result;
}

PowerFit fitted_power(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size() || x.size() < 2)
    throw UsageError("a fitted exponent or order needs at least two sizes, and one value for each");
  const std::vector<double> log_x = logarithms(x);
  const std::vector<double> log_y = logarithms(y);
  const auto all_equal = [](const std::vector<double>& v) {
    return std::all_of(v.begin(), v.end(), [&](double value) { return value == v.front(); });
  };
  if (all_equal(x))
    throw UsageError("a fitted exponent or order needs at least two different sizes");
  const double x_mean = mean(log_x);
  const double y_mean = mean(log_y);
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (log_x[i] - x_mean) * (log_x[i] - x_mean);
    xy += (log_x[i] - x_mean) * (log_y[i] - y_mean);
    yy += (log_y[i] - y_mean) * (log_y[i] - y_mean);
  }
  PowerFit fit;
  fit.exponent = xy / xx;
  fit.factor = std::exp(y_mean - fit.exponent * x_mean);
  double squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = log_y[i] - y_mean - fit.exponent * (log_x[i] - x_mean);
    squares += residual * residual;
  }
  if (x.size() > 2)
    fit.standard_error = std::sqrt(squares / static_cast<double>(x.size() - 2) / xx);
  if (!all_equal(y))
    fit.r_squared = 1 - squares / yy;
  return fit;
}

double fitted_order(const std::vector<double>& h, const std::vector<double>& errors) {
  return fitted_power(h, errors).exponent;
}

} // namespace slicelens
