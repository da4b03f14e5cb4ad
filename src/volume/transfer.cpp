#include "volume/transfer.h"

#include "core/errors.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

glm::dvec4 rgba_of(const TransferPoint& p) { return {p.r, p.g, p.b, p.opacity}; }

TransferPoint point_of(double value, const glm::dvec4& rgba) {
  return {value, rgba.r, rgba.g, rgba.b, rgba.a};
}

std::string describe(std::size_t index, double value) {
  return "transfer point " + std::to_string(index) + " (value " + number_text(value) + ")";
}

void check_unit(std::size_t index, double value, const char* name, double number) {
  if (!(number >= 0 && number <= 1)) // also catches NaN
    throw UsageError(describe(index, value) + ": " + name + " is " + number_text(number) +
                     "; it must be in [0,1]");
}

/// Values in (first, last] at which the function jumps.
std::vector<double> steps_inside(const TransferFunction& transfer, double first, double last) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < transfer.points.size(); ++i) {
    const double value = transfer.points[i].value;
    if (value == transfer.points[i - 1].value && value > first && value <= last)
      steps.push_back(value);
  }
  return steps;
}

struct Domain {
  double first = 0;
  double last = 1;
};

/// The narrowest width that float look-ups can still resolve around `value`.
double narrowest_width(double value) { return 2e-6 * std::max(std::abs(value), 1e-30); }

Domain domain_of(const TransferFunction& transfer, double low, double high) {
  const auto& points = transfer.points;
  double first = points.front().value;
  double last = points.back().value;
  double range = last - first;
  // The far side of a step on the span's end needs texels of its own.
  if (range > 0 && points[1].value == first)
    first -= range / 64;
  if (range > 0 && points[points.size() - 2].value == last)
    last += range / 64;
  if (low < high) {
    range = high - low;
    // Data wholly on one side of the knots see a constant: any domain there will do.
    if (last > low && first < high) {
      first = std::max(first, low);
      last = std::min(last, high);
    } else {
      return {low, high};
    }
  }
  const double middle = first / 2 + last / 2;
  const double width = std::max(range > 0 ? range / static_cast<double>(kMaxTransferTexels)
                                          : 1e-6 * std::max(std::abs(middle), 1.0),
                                narrowest_width(middle));
  if (!(last - first >= width)) // a lone step or point, or knots too close for floats
    return {middle - width / 2, middle + width / 2};
  return {first, last};
}

void fill(TransferTable& table, const TransferFunction& transfer, std::size_t texels) {
  table.rgba.resize(4 * texels);
  for (std::size_t i = 0; i < texels; ++i) {
    const double f = static_cast<double>(i) / static_cast<double>(texels - 1);
    // Written so that the last texel is exactly `last`.
    const double value = table.first * (1 - f) + table.last * f;
    const glm::dvec4 rgba = evaluate(transfer, value);
    for (int c = 0; c < 4; ++c)
      table.rgba[4 * i + static_cast<std::size_t>(c)] = static_cast<float>(rgba[c]);
  }
}

/// Both functions are piecewise linear and agree at the texel centres, so the largest difference is at a
/// knot.
double deviation_at_knots(const TransferTable& table, const TransferFunction& transfer,
                          const std::vector<double>& steps) {
  const double interval = (table.last - table.first) / static_cast<double>(texel_count(table) - 1);
  double largest = 0;
  for (const TransferPoint& point : transfer.points) {
    if (point.value < table.first || point.value > table.last)
      continue;
    const double cell = std::floor((point.value - table.first) / interval);
    const bool near_step = std::any_of(steps.begin(), steps.end(), [&](double step) {
      return std::abs(std::floor((step - table.first) / interval) - cell) <= 1;
    });
    if (near_step)
      continue;
    const glm::dvec4 difference = glm::abs(evaluate(table, point.value) - evaluate(transfer, point.value));
    largest = std::max({largest, difference.r, difference.g, difference.b, difference.a});
  }
  return largest;
}

/// True when every knot inside the domain lies on a texel centre of a table of that size.
bool knots_on_centres(const TransferFunction& transfer, const Domain& domain, std::size_t texels) {
  return std::all_of(transfer.points.begin(), transfer.points.end(), [&](const TransferPoint& point) {
    if (point.value <= domain.first || point.value >= domain.last)
      return true;
    const double position =
        (point.value - domain.first) / (domain.last - domain.first) * static_cast<double>(texels - 1);
    return std::abs(position - std::round(position)) < 1e-9 * static_cast<double>(texels);
  });
}

std::size_t automatic_size(const TransferFunction& transfer, const Domain& domain,
                           const std::vector<double>& steps) {
  if (!steps.empty())
    return kMaxTransferTexels;
  for (std::size_t texels = kMinTransferTexels; texels <= 1024; ++texels) {
    if (knots_on_centres(transfer, domain, texels))
      return texels;
  }
  std::size_t texels = kMinTransferTexels;
  for (; texels < kMaxTransferTexels; texels *= 2) {
    TransferTable table{domain.first, domain.last, {}, 0, 0};
    fill(table, transfer, texels);
    if (deviation_at_knots(table, transfer, steps) < 1e-4)
      break;
  }
  return texels;
}

} // namespace

void validate(const TransferFunction& transfer) {
  const auto& points = transfer.points;
  if (points.empty())
    throw UsageError("a transfer function needs at least one point [value, r, g, b, opacity]");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const TransferPoint& p = points[i];
    if (!(std::abs(p.value) <= kMaxTransferValue))
      throw UsageError(describe(i, p.value) + ": the value must be a number of at most 1e38");
    check_unit(i, p.value, "r", p.r);
    check_unit(i, p.value, "g", p.g);
    check_unit(i, p.value, "b", p.b);
    check_unit(i, p.value, "opacity", p.opacity);
    if (i > 0 && p.value < points[i - 1].value)
      throw UsageError(describe(i, p.value) + " comes after value " + number_text(points[i - 1].value) +
                       "; values must not decrease");
    if (i > 1 && p.value == points[i - 2].value)
      throw UsageError(describe(i, p.value) + " is the third at this value; two make a step");
  }
  if (transfer.unit_distance && !(std::isfinite(*transfer.unit_distance) && *transfer.unit_distance > 0))
    throw UsageError("transfer unit_distance is " + number_text(*transfer.unit_distance) +
                     "; it must be greater than 0");
}

glm::dvec4 evaluate(const TransferFunction& transfer, double value) {
  if (std::isnan(value))
    return glm::dvec4(0);
  const auto& points = transfer.points;
  const auto right = std::upper_bound(points.begin(), points.end(), value,
                                      [](double v, const TransferPoint& p) { return v < p.value; });
  if (right == points.begin())
    return rgba_of(points.front());
  if (right == points.end())
    return rgba_of(points.back());
  const TransferPoint& a = *(right - 1);
  const double f = (value - a.value) / (right->value - a.value);
  return rgba_of(a) * (1 - f) + rgba_of(*right) * f;
}

TransferFunction windowed(TransferFunction transfer, std::optional<double> window,
                          std::optional<double> level) {
  if (!window && !level)
    return transfer;
  validate(transfer);
  const double first = transfer.points.front().value;
  const double last = transfer.points.back().value;
  if (window && !(*window > 0))
    throw UsageError("transfer.window is " + number_text(*window) + "; it must be above 0");
  if (window && first == last) {
    throw UsageError("transfer.window: the transfer function has the single value " + number_text(first) +
                     " and no width to change; leave it out, transfer.level moves the value");
  }
  const double width = window.value_or(last - first);
  const double middle = level.value_or(first / 2 + last / 2);
  const double low = middle - width / 2;
  const double high = middle + width / 2;
  double before = first;
  double after = low;
  for (TransferPoint& point : transfer.points) {
    // Rounding must not swap points, so the sum rises with the share and ends where the window does.
    const double share = first < last ? (point.value - first) / (last - first) : 0;
    const double value = share < 1 ? std::min(low + share * width, high) : high;
    if (point.value > before && !(value > after)) {
      throw UsageError("transfer.window " + number_text(width) + " about " + number_text(middle) +
                       " is so narrow that points of the transfer function fall together; make it wider");
    }
    before = point.value;
    after = value;
    point.value = value;
  }
  validate(transfer);
  return transfer;
}

TransferFunction constant_transfer(const glm::dvec4& rgba) {
  return {{point_of(0, rgba)}, std::nullopt, "constant"};
}

TransferFunction step_transfer(double threshold, const glm::dvec4& below, const glm::dvec4& above) {
  return {{point_of(threshold, below), point_of(threshold, above)}, std::nullopt, "step"};
}

std::size_t texel_count(const TransferTable& table) { return table.rgba.size() / 4; }

glm::dvec4 evaluate(const TransferTable& table, double value) {
  const std::size_t count = texel_count(table);
  const double end = static_cast<double>(count - 1);
  const double position = std::clamp((value - table.first) / (table.last - table.first) * end, 0.0, end);
  const std::size_t i = std::min(static_cast<std::size_t>(position), count - 2);
  const double f = position - static_cast<double>(i);
  glm::dvec4 rgba;
  for (int c = 0; c < 4; ++c) {
    const std::size_t at = 4 * i + static_cast<std::size_t>(c);
    rgba[c] = static_cast<double>(table.rgba[at]) * (1 - f) + static_cast<double>(table.rgba[at + 4]) * f;
  }
  return rgba;
}

TransferTable make_table(const TransferFunction& transfer, std::size_t texels, double low, double high) {
  validate(transfer);
  if (texels != 0 && (texels < 2 || texels > kMaxTransferTexels))
    throw UsageError("a transfer table of " + std::to_string(texels) + " texels; it must have 2 to " +
                     std::to_string(kMaxTransferTexels) + ", or 0 for automatic");
  const Domain domain = domain_of(transfer, low, high);
  const std::vector<double> steps = steps_inside(transfer, domain.first, domain.last);
  TransferTable table{domain.first, domain.last, {}, 0, steps.size()};
  fill(table, transfer, texels != 0 ? texels : automatic_size(transfer, domain, steps));
  table.deviation = deviation_at_knots(table, transfer, steps);
  return table;
}

} // namespace slicelens
