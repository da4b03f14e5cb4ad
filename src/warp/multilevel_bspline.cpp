#include "warp/multilevel_bspline.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace slicelens {

namespace {

/// The four control values on one axis that a coordinate depends on, and their weights.
struct AxisSupport {
  std::size_t first = 0;
  std::array<double, 4> weights{};
};

/// `x` ∈ [0, spans], counted in spans.
AxisSupport axis_support(double x, double spans) {
  const double cell = std::min(std::floor(x), spans - 1);
  const double t = x - cell;
  return {static_cast<std::size_t>(cell),
          {(1 - t) * (1 - t) * (1 - t) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
           (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6}};
}

/// The same on each axis, of a point.
struct Support {
  std::array<std::size_t, 3> first{};
  std::array<std::array<double, 4>, 3> weights{};

  double weight(std::size_t i, std::size_t j, std::size_t k) const {
    return weights[0][i] * weights[1][j] * weights[2][k];
  }
};

Support support_of(const MultilevelBSpline& spline, std::size_t level, const glm::dvec3& p) {
  const double spans = std::ldexp(1, static_cast<int>(level));
  const glm::dvec3 x = glm::clamp((p - spline.low) / (spline.high - spline.low), 0.0, 1.0) * spans;
  Support support;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    const AxisSupport own = axis_support(x[axis], spans);
    support.first[a] = own.first;
    support.weights[a] = own.weights;
  }
  return support;
}

std::size_t nodes_of(std::size_t level) { return (std::size_t{1} << level) + 3; }

/// Calls visit(index, weight) for the 64 control values.
template <class Visit>
void visit_controls(const Support& support, std::size_t n, const Visit& visit) {
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t row = ((support.first[2] + k) * n + support.first[1] + j) * n + support.first[0];
      for (std::size_t i = 0; i < 4; ++i)
        visit(row + i, support.weight(i, j, k));
    }
  }
}

glm::dvec3 evaluate_level(const MultilevelBSpline& spline, std::size_t level, const glm::dvec3& p) {
  const Support support = support_of(spline, level, p);
  const std::vector<glm::dvec3>& controls = spline.levels[level];
  glm::dvec3 sum(0);
  visit_controls(support, nodes_of(level),
                 [&](std::size_t index, double weight) { sum += weight * controls[index]; });
  return sum;
}

/// One level of Lee, Wolberg and Shin 1997 (equations 3 to 5): each point alone would set its controls to
/// w·value/Σw²; a control takes the mean of what its points ask for, weighted by w².
std::vector<glm::dvec3> fit_level(const MultilevelBSpline& spline, std::size_t level,
                                  std::span<const glm::dvec3> at, const std::vector<glm::dvec3>& values) {
  const std::size_t n = nodes_of(level);
  std::vector<glm::dvec3> sums(n * n * n, glm::dvec3(0));
  std::vector<double> weights(n * n * n, 0);
  for (std::size_t p = 0; p < at.size(); ++p) {
    const Support support = support_of(spline, level, at[p]);
    double squares = 0;
    visit_controls(support, n, [&](std::size_t, double w) { squares += w * w; });
    visit_controls(support, n, [&](std::size_t index, double w) {
      sums[index] += w * w * (w / squares) * values[p];
      weights[index] += w * w;
    });
  }
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (weights[i] > 0)
      sums[i] /= weights[i];
  }
  return sums;
}

} // namespace

MultilevelBSpline fit_multilevel_bspline(std::span<const glm::dvec3> at, std::span<const glm::dvec3> values,
                                         const glm::dvec3& low, const glm::dvec3& high, std::size_t levels) {
  MultilevelBSpline spline{low, high, {}};
  std::vector<glm::dvec3> left(values.begin(), values.end());
  for (std::size_t level = 0; level < levels; ++level) {
    spline.levels.push_back(fit_level(spline, level, at, left));
    for (std::size_t p = 0; p < at.size(); ++p)
      left[p] -= evaluate_level(spline, level, at[p]);
  }
  return spline;
}

glm::dvec3 evaluate(const MultilevelBSpline& spline, const glm::dvec3& p) {
  glm::dvec3 sum(0);
  for (std::size_t level = 0; level < spline.levels.size(); ++level)
    sum += evaluate_level(spline, level, p);
  return sum;
}

namespace {

/// Of the nodes of a grid on one axis.
std::vector<AxisSupport> node_supports(const MultilevelBSpline& spline, std::size_t level, int axis,
                                       std::size_t count, double low, double high) {
  const double spans = std::ldexp(1, static_cast<int>(level));
  std::vector<AxisSupport> supports;
  for (std::size_t i = 0; i < count; ++i) {
    const double p = low + static_cast<double>(i) / static_cast<double>(count - 1) * (high - low);
    const double x = (p - spline.low[axis]) / (spline.high[axis] - spline.low[axis]);
    supports.push_back(axis_support(std::clamp(x, 0.0, 1.0) * spans, spans));
  }
  return supports;
}

/// Σ weights · rows of `length` values that lie one after another from row `first` on, added to `out`.
void add_rows(const glm::dvec3* rows, const AxisSupport& support, std::size_t length, glm::dvec3* out) {
  const glm::dvec3* row = rows + support.first * length;
  for (std::size_t i = 0; i < length; ++i) {
    out[i] += support.weights[0] * row[i] + support.weights[1] * row[length + i] +
              support.weights[2] * row[2 * length + i] + support.weights[3] * row[3 * length + i];
  }
}

/// One level on all nodes: along x and y in each plane of control values, then along z between the planes.
void add_level(const MultilevelBSpline& spline, std::size_t level, const std::array<std::size_t, 3>& size,
               const std::array<std::vector<AxisSupport>, 3>& supports, std::vector<glm::dvec3>& sums) {
  const std::size_t n = nodes_of(level);
  const std::size_t plane_size = size[0] * size[1];
  const std::vector<glm::dvec3>& controls = spline.levels[level];
  const std::size_t first = supports[2].front().first;
  const std::size_t last = supports[2].back().first + 4;
  std::vector<glm::dvec3> planes(n * plane_size, glm::dvec3(0));
  tbb::parallel_for(first, last, [&](std::size_t c) {
    std::vector<glm::dvec3> rows(n * size[0], glm::dvec3(0));
    for (std::size_t b = 0; b < n; ++b) {
      for (std::size_t i = 0; i < size[0]; ++i)
        add_rows(controls.data() + (c * n + b) * n, supports[0][i], 1, &rows[b * size[0] + i]);
    }
    for (std::size_t j = 0; j < size[1]; ++j)
      add_rows(rows.data(), supports[1][j], size[0], &planes[c * plane_size + j * size[0]]);
  });
  tbb::parallel_for(std::size_t{0}, size[2], [&](std::size_t k) {
    add_rows(planes.data(), supports[2][k], plane_size, &sums[k * plane_size]);
  });
}

} // namespace

std::vector<glm::dvec3> evaluate_on_grid(const MultilevelBSpline& spline,
                                         const std::array<std::size_t, 3>& size, const glm::dvec3& low,
                                         const glm::dvec3& high) {
  std::vector<glm::dvec3> sums(size[0] * size[1] * size[2], glm::dvec3(0));
  for (std::size_t level = 0; level < spline.levels.size(); ++level) {
    std::array<std::vector<AxisSupport>, 3> supports;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      supports[a] = node_supports(spline, level, axis, size[a], low[axis], high[axis]);
    }
    add_level(spline, level, size, supports, sums);
  }
  return sums;
}

} // namespace slicelens
