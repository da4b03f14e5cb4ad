#include "study/ssim.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slicelens {

namespace {

constexpr int window_width = 11;
constexpr double window_sigma = 1.5;

/// The Gaussian's weights over the largest odd number of pixels up to 11 that fits `side`; their sum is 1.
std::vector<double> window_for(int side) {
  const int width = std::min(window_width, side % 2 == 1 ? side : side - 1);
  std::vector<double> weights(static_cast<std::size_t>(std::max(width, 1)));
  const double middle = static_cast<double>(weights.size() - 1) / 2;
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double offset = static_cast<double>(i) - middle;
    weights[i] = std::exp(-offset * offset / (2 * window_sigma * window_sigma));
    sum += weights[i];
  }
  for (double& weight : weights)
    weight /= sum;
  return weights;
}

/// Weighted means of a, b, a², b² and a·b.
using Moments = std::array<double, 5>;

void add(Moments& sum, double weight, const Moments& value) {
  for (std::size_t m = 0; m < sum.size(); ++m)
    sum[m] += weight * value[m];
}

/// Luminance, and contrast times structure: Wang et al. 2004, eq. 6, and eq. 9 and 10 with C₃ = C₂/2.
struct Similarity {
  double luminance = 0;
  double contrast_structure = 0;
};

Similarity similarity(const Moments& m) {
  constexpr double c1 = 0.01 * 0.01;
  constexpr double c2 = 0.03 * 0.03;
  const double variance_a = m[2] - m[0] * m[0];
  const double variance_b = m[3] - m[1] * m[1];
  const double covariance = m[4] - m[0] * m[1];
  return {(2 * m[0] * m[1] + c1) / (m[0] * m[0] + m[1] * m[1] + c1),
          (2 * covariance + c2) / (variance_a + variance_b + c2)};
}

/// Means over all positions of the window.
struct Means {
  double ssim = 0;
  double contrast_structure = 0;
};

/// The window is separable, so rows are filtered once and kept only as long as a window needs them.
Means means_of(const PixelPlane& a, const PixelPlane& b) {
  const std::vector<double> across = window_for(a.width);
  const std::vector<double> down = window_for(a.height);
  const std::size_t positions = static_cast<std::size_t>(a.width) - across.size() + 1;
  std::vector<std::vector<Moments>> rows(down.size(), std::vector<Moments>(positions));
  std::vector<Moments> line(static_cast<std::size_t>(a.width));
  Means sum;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double va = a.at(x, y);
      const double vb = b.at(x, y);
      line[static_cast<std::size_t>(x)] = {va, vb, va * va, vb * vb, va * vb};
    }
    const auto last = static_cast<std::size_t>(y);
    for (std::size_t x = 0; x < positions; ++x) {
      Moments& mean = rows[last % down.size()][x];
      mean = {};
      for (std::size_t k = 0; k < across.size(); ++k)
        add(mean, across[k], line[x + k]);
    }
    if (last + 1 < down.size())
      continue;
    Means row;
    for (std::size_t x = 0; x < positions; ++x) {
      Moments mean{};
      for (std::size_t k = 0; k < down.size(); ++k)
        add(mean, down[k], rows[(last + 1 + k) % down.size()][x]); // the oldest row first
      const Similarity here = similarity(mean);
      row.ssim += here.luminance * here.contrast_structure;
      row.contrast_structure += here.contrast_structure;
    }
    sum.ssim += row.ssim;
    sum.contrast_structure += row.contrast_structure;
  }
  const std::size_t window_rows = static_cast<std::size_t>(a.height) - down.size() + 1;
  const double count = static_cast<double>(positions) * static_cast<double>(window_rows);
  return {sum.ssim / count, sum.contrast_structure / count};
}

PixelPlane halved(const PixelPlane& plane) {
  PixelPlane half = make_plane((plane.width + 1) / 2, (plane.height + 1) / 2);
  for (int y = 0; y < half.height; ++y) {
    const int below = std::min(2 * y + 1, plane.height - 1);
    for (int x = 0; x < half.width; ++x) {
      const int right = std::min(2 * x + 1, plane.width - 1);
      half.at(x, y) = (plane.at(2 * x, 2 * y) + plane.at(right, 2 * y) + plane.at(2 * x, below) +
                       plane.at(right, below)) /
                      4;
    }
  }
  return half;
}

} // namespace

double ssim(const PixelPlane& a, const PixelPlane& b) { return means_of(a, b).ssim; }

std::optional<double> ms_ssim(const PixelPlane& a, const PixelPlane& b) {
  constexpr std::array<double, 5> weights = {0.0448, 0.2856, 0.3001, 0.2363, 0.1333};
  if (std::min(a.width, a.height) < smallest_ms_ssim_side)
    return std::nullopt;
  PixelPlane scaled_a = a;
  PixelPlane scaled_b = b;
  double product = 1;
  for (std::size_t scale = 0; scale < weights.size(); ++scale) {
    if (scale > 0) {
      scaled_a = halved(scaled_a);
      scaled_b = halved(scaled_b);
    }
    const Means means = means_of(scaled_a, scaled_b);
    const double factor = scale + 1 < weights.size() ? means.contrast_structure : means.ssim;
    product *= std::pow(std::max(factor, 0.0), weights[scale]);
  }
  return product;
}

} // namespace slicelens
