#include "warp/multilevel_bspline.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slicelens {

namespace {

/// The four control values on each axis that a point depends on, and their weights.
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
    const double cell = std::min(std::floor(x[axis]), spans - 1);
    const double t = x[axis] - cell;
    support.first[a] = static_cast<std::size_t>(cell);
    support.weights[a] = {(1 - t) * (1 - t) * (1 - t) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
                          (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6};
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

} // namespace slicelens
