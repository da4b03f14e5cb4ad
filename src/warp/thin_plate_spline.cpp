#include "warp/thin_plate_spline.h"

#include "core/errors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slicelens {

namespace {

/// Rows of n coefficients and three right-hand sides.
struct System {
  std::size_t n = 0;
  std::vector<double> rows;

  explicit System(std::size_t size) : n(size), rows(size * (size + 3)) {}
  double* row(std::size_t i) { return rows.data() + i * (n + 3); }
};

/// Turns the right-hand sides into the solution, or returns false for a singular system.
bool solve(System& s) {
  std::vector<double*> rows(s.n);
  for (std::size_t i = 0; i < s.n; ++i)
    rows[i] = s.row(i);
  double largest_pivot = 0;
  for (std::size_t k = 0; k < s.n; ++k) {
    const auto pivot =
        std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(k), rows.end(),
                         [k](const double* a, const double* b) { return std::abs(a[k]) < std::abs(b[k]); });
    std::swap(rows[k], *pivot);
    const double* top = rows[k];
    largest_pivot = std::max(largest_pivot, std::abs(top[k]));
    if (!(std::abs(top[k]) > 1e-13 * largest_pivot))
      return false;
    for (std::size_t i = k + 1; i < s.n; ++i) {
      double* row = rows[i];
      const double factor = row[k] / top[k];
      if (factor == 0)
        continue;
      for (std::size_t c = k; c < s.n + 3; ++c)
        row[c] -= factor * top[c];
    }
  }
  std::vector<std::array<double, 3>> solution(s.n);
  for (std::size_t k = s.n; k-- > 0;) {
    for (std::size_t c = 0; c < 3; ++c) {
      double value = rows[k][s.n + c];
      for (std::size_t j = k + 1; j < s.n; ++j)
        value -= rows[k][j] * solution[j][c];
      solution[k][c] = value / rows[k][k];
    }
  }
  for (std::size_t k = 0; k < s.n; ++k)
    std::copy(solution[k].begin(), solution[k].end(), s.row(k) + s.n);
  return true;
}

} // namespace

ThinPlateSpline fit_thin_plate_spline(std::span<const glm::dvec3> at, std::span<const glm::dvec3> values,
                                      double stiffness) {
  const std::size_t n = at.size();
  System system(n + 4);
  for (std::size_t i = 0; i < n; ++i) {
    double* row = system.row(i);
    for (std::size_t j = 0; j < n; ++j)
      row[j] = i == j ? -stiffness : glm::length(at[i] - at[j]);
    for (int c = 0; c < 3; ++c) {
      row[n + static_cast<std::size_t>(c)] = at[i][c];
      system.row(n + static_cast<std::size_t>(c))[i] = at[i][c];
      row[n + 4 + static_cast<std::size_t>(c)] = values[i][c];
    }
    row[n + 3] = 1;
    system.row(n + 3)[i] = 1;
  }
  if (n < 4 || !solve(system)) {
    throw UsageError(
        "a thin-plate spline needs at least 4 points that do not lie in one plane, all different");
  }
  const auto solution = [&](std::size_t k) {
    const double* x = system.row(k) + n + 4;
    return glm::dvec3(x[0], x[1], x[2]);
  };
  ThinPlateSpline spline;
  spline.centers.assign(at.begin(), at.end());
  for (std::size_t i = 0; i < n; ++i)
    spline.weights.push_back(solution(i));
  spline.linear = {solution(n), solution(n + 1), solution(n + 2)};
  spline.constant = solution(n + 3);
  return spline;
}

glm::dvec3 evaluate(const ThinPlateSpline& spline, const glm::dvec3& p) {
  glm::dvec3 sum = spline.linear * p + spline.constant;
  for (std::size_t i = 0; i < spline.centers.size(); ++i)
    sum += glm::length(p - spline.centers[i]) * spline.weights[i];
  return sum;
}

} // namespace slicelens
