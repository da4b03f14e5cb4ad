#include "study/metrics.h"

#include "core/errors.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slicelens {

namespace {

constexpr int window_width = 11;
constexpr double window_sigma = 1.5;
constexpr double step_limit = 1.0 / 255 + 1e-6;
constexpr double half_step = 0.5 / 255;

std::string size_text(const Image& image) {
  return std::to_string(image.width) + "×" + std::to_string(image.height);
}

void check_finite(const Image& image, const std::string& which) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (std::isfinite(image.pixels[i]))
      continue;
    const auto width = static_cast<std::size_t>(image.width);
    throw UsageError("the " + which + " picture's value at pixel (" + std::to_string(i / 4 % width) + ", " +
                     std::to_string(i / 4 / width) + "), channel " + "RGBA"[i % 4] +
                     " is not finite; pictures with NaN or infinity cannot be compared");
  }
}

glm::dvec3 composited(const Image& image, int x, int y, const glm::dvec3& background) {
  const glm::dvec3 color(channel(image, x, y, 0), channel(image, x, y, 1), channel(image, x, y, 2));
  return color + (1.0 - channel(image, x, y, 3)) * background;
}

bool has_transparency(const Image& image) {
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
    if (image.pixels[i] < 1)
      return true;
  }
  return false;
}

bool covers(const Image& image, int x, int y, const glm::dvec3& background, bool transparent) {
  const glm::dvec3 color(channel(image, x, y, 0), channel(image, x, y, 1), channel(image, x, y, 2));
  if (transparent)
    return channel(image, x, y, 3) > 0 || color != glm::dvec3(0);
  return glm::any(glm::greaterThan(glm::abs(color - background), glm::dvec3(half_step)));
}

std::optional<double> psnr_of(double squares, double values) {
  if (!(squares > 0))
    return std::nullopt;
  return -10 * std::log10(squares / values);
}

double luma(const glm::dvec3& rgb) { return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b; }

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

/// Wang et al. 2004, eq. 13.
double ssim_of(const Moments& m) {
  constexpr double c1 = 0.01 * 0.01;
  constexpr double c2 = 0.03 * 0.03;
  const double variance_a = m[2] - m[0] * m[0];
  const double variance_b = m[3] - m[1] * m[1];
  const double covariance = m[4] - m[0] * m[1];
  return (2 * m[0] * m[1] + c1) * (2 * covariance + c2) /
         ((m[0] * m[0] + m[1] * m[1] + c1) * (variance_a + variance_b + c2));
}

/// Mean SSIM; the window is separable, so rows are filtered once and kept only as long as a window needs
/// them.
double mean_ssim(const Image& a, const Image& b, const glm::dvec3& background_a,
                 const glm::dvec3& background_b) {
  const std::vector<double> across = window_for(a.width);
  const std::vector<double> down = window_for(a.height);
  const std::size_t positions = static_cast<std::size_t>(a.width) - across.size() + 1;
  std::vector<std::vector<Moments>> rows(down.size(), std::vector<Moments>(positions));
  std::vector<Moments> line(static_cast<std::size_t>(a.width));
  double sum = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const double va = luma(composited(a, x, y, background_a));
      const double vb = luma(composited(b, x, y, background_b));
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
    double row_sum = 0;
    for (std::size_t x = 0; x < positions; ++x) {
      Moments mean{};
      for (std::size_t k = 0; k < down.size(); ++k)
        add(mean, down[k], rows[(last + 1 + k) % down.size()][x]); // the oldest row first
      row_sum += ssim_of(mean);
    }
    sum += row_sum;
  }
  const std::size_t window_rows = static_cast<std::size_t>(a.height) - down.size() + 1;
  return sum / (static_cast<double>(positions) * static_cast<double>(window_rows));
}

} // namespace

Metrics compare_images(const Image& a, const Image& b, const glm::dvec3& background_a,
                       const glm::dvec3& background_b) {
  if (a.width != b.width || a.height != b.height)
    throw UsageError("the pictures are " + size_text(a) + " and " + size_text(b) +
                     "; only pictures of the same size can be compared");
  if (a.width < 1 || a.height < 1)
    throw UsageError("the pictures have no pixels to compare");
  check_finite(a, "first");
  check_finite(b, "second");
  Metrics metrics;
  metrics.width = a.width;
  metrics.height = a.height;
  const bool transparent_a = has_transparency(a);
  const bool transparent_b = has_transparency(b);
  double squares = 0;
  double squares_covered = 0;
  double absolute = 0;
  std::size_t over = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const glm::dvec3 difference =
          glm::abs(composited(a, x, y, background_a) - composited(b, x, y, background_b));
      const double square = glm::dot(difference, difference);
      squares += square;
      for (int c = 0; c < 3; ++c) {
        absolute += difference[c];
        metrics.max_abs = std::max(metrics.max_abs, difference[c]);
        over += difference[c] > step_limit ? 1 : 0;
      }
      if (covers(a, x, y, background_a, transparent_a) || covers(b, x, y, background_b, transparent_b)) {
        squares_covered += square;
        ++metrics.covered_pixels;
      }
    }
  }
  const double values = 3.0 * a.width * a.height;
  metrics.psnr = psnr_of(squares, values);
  metrics.psnr_covered = psnr_of(squares_covered, 3.0 * static_cast<double>(metrics.covered_pixels));
  metrics.rmse = std::sqrt(squares / values);
  metrics.mean_abs = absolute / values;
  metrics.over_1_255 = static_cast<double>(over) / values;
  metrics.ssim = mean_ssim(a, b, background_a, background_b);
  return metrics;
}

std::vector<std::pair<std::string, std::optional<double>>> as_pairs(const Metrics& metrics) {
  return {{"psnr", metrics.psnr},
          {"psnr_covered", metrics.psnr_covered},
          {"ssim", metrics.ssim},
          {"rmse", metrics.rmse},
          {"mean_abs", metrics.mean_abs},
          {"max_abs", metrics.max_abs},
          {"over_1_255", metrics.over_1_255},
          {"width", static_cast<double>(metrics.width)},
          {"height", static_cast<double>(metrics.height)}};
}

} // namespace slicelens
