// The Gaussian copy of the reference: the definition of volume/gradient_volume.h in double precision.
#pragma once

#include "render/voxel_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace slicelens {

struct SmoothCopy {
  glm::ivec3 dims{0};
  std::vector<double> values;

  double value(const glm::dvec3& t) const {
    return filtered(Filter::linear, dims, t * glm::dvec3(dims), [&](int i, int j, int k) {
      return values[(static_cast<std::size_t>(k) * static_cast<std::size_t>(dims.y) +
                     static_cast<std::size_t>(j)) *
                        static_cast<std::size_t>(dims.x) +
                    static_cast<std::size_t>(i)];
    });
  }
};

/// One axis: `n` values that `read` gives, as `m` Gaussian means that `write` takes.
template <class Read, class Write>
void smooth_line(int n, int m, double sigma, const Read& read, const Write& write) {
  const double step = static_cast<double>(n) / m;
  const double s = sigma * step;
  for (int i = 0; i < m; ++i) {
    const double x = (i + 0.5) * step - 0.5; // in voxels, centres at whole numbers
    double sum = 0;
    double weights = 0;
    for (int j = static_cast<int>(std::ceil(x - 4 * s)); j <= static_cast<int>(std::floor(x + 4 * s)); ++j) {
      const double weight = std::exp(-(j - x) * (j - x) / (2 * s * s));
      sum += weight * read(std::clamp(j, 0, n - 1));
      weights += weight;
    }
    write(i, sum / weights);
  }
}

/// The copy with m voxels on each axis of the `n` voxels that `voxel(i, j, k)` gives: along k, then j, then
/// i.
template <class Voxel>
SmoothCopy smooth_copy(const glm::ivec3& n, const glm::ivec3& m, double sigma, const Voxel& voxel) {
  const auto at = [](std::vector<double>& values, int width, int height, int i, int j, int k) -> double& {
    return values[(static_cast<std::size_t>(k) * static_cast<std::size_t>(height) +
                   static_cast<std::size_t>(j)) *
                      static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(i)];
  };
  const auto size = [](int a, int b, int c) {
    return static_cast<std::size_t>(a) * static_cast<std::size_t>(b) * static_cast<std::size_t>(c);
  };
  std::vector<double> along_k(size(n.x, n.y, m.z));
  tbb::parallel_for(0, n.y, [&](int j) {
    for (int i = 0; i < n.x; ++i)
      smooth_line(
          n.z, m.z, sigma, [&](int k) { return voxel(i, j, k); },
          [&](int k, double v) { at(along_k, n.x, n.y, i, j, k) = v; });
  });
  std::vector<double> along_j(size(n.x, m.y, m.z));
  tbb::parallel_for(0, m.z, [&](int k) {
    for (int i = 0; i < n.x; ++i)
      smooth_line(
          n.y, m.y, sigma, [&](int j) { return at(along_k, n.x, n.y, i, j, k); },
          [&](int j, double v) { at(along_j, n.x, m.y, i, j, k) = v; });
  });
  SmoothCopy copy;
  copy.dims = m;
  copy.values.resize(size(m.x, m.y, m.z));
  tbb::parallel_for(0, m.z, [&](int k) {
    for (int j = 0; j < m.y; ++j)
      smooth_line(
          n.x, m.x, sigma, [&](int i) { return at(along_j, n.x, m.y, i, j, k); },
          [&](int i, double v) { at(copy.values, m.x, m.y, i, j, k) = v; });
  });
  return copy;
}

} // namespace slicelens
