#include "study/metrics.h"

#include "core/errors.h"
#include "core/text.h"
#include "study/flip.h"
#include "study/planes.h"
#include "study/ssim.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

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

double step_limit(double k) { return k / 255 + 1e-6; }

void check_comparable(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    throw UsageError("the pictures are " + size_text(a) + " and " + size_text(b) +
                     "; only pictures of the same size can be compared");
  if (a.width < 1 || a.height < 1)
    throw UsageError("the pictures have no pixels to compare");
  check_finite(a, "first");
  check_finite(b, "second");
}

/// Everything but the similarities and FLIP, which are left as they are.
void measure_differences(Metrics& metrics, const Image& a, const Image& b, const glm::dvec3& background_a,
                         const glm::dvec3& background_b) {
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
          glm::abs(color_over(a, x, y, background_a) - color_over(b, x, y, background_b));
      const double square = glm::dot(difference, difference);
      squares += square;
      for (int c = 0; c < 3; ++c) {
        absolute += difference[c];
        metrics.max_abs = std::max(metrics.max_abs, difference[c]);
        over += difference[c] > step_limit(1) ? 1 : 0;
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
}

/// K of "over_K_255", 1 to 254 without leading zeros.
std::optional<int> steps_of(const std::string& name) {
  for (int k = 1; k <= 254; ++k) {
    if (name == "over_" + std::to_string(k) + "_255")
      return k;
  }
  return std::nullopt;
}

} // namespace

Metrics compare_images(const Image& a, const Image& b, const glm::dvec3& background_a,
                       const glm::dvec3& background_b) {
  check_comparable(a, b);
  Metrics metrics;
  measure_differences(metrics, a, b, background_a, background_b);
  const PixelPlane luma_a = luma_plane(a, background_a);
  const PixelPlane luma_b = luma_plane(b, background_b);
  metrics.ssim = ssim(luma_a, luma_b);
  metrics.ms_ssim = ms_ssim(luma_a, luma_b);
  metrics.flip = mean_of(flip_errors(a, b, background_a, background_b));
  return metrics;
}

std::vector<std::pair<std::string, std::optional<double>>> as_pairs(const Metrics& metrics) {
  return {{"psnr", metrics.psnr},
          {"psnr_covered", metrics.psnr_covered},
          {"ssim", metrics.ssim},
          {"ms_ssim", metrics.ms_ssim},
          {"flip", metrics.flip},
          {"rmse", metrics.rmse},
          {"mean_abs", metrics.mean_abs},
          {"max_abs", metrics.max_abs},
          {"over_1_255", metrics.over_1_255},
          {"width", static_cast<double>(metrics.width)},
          {"height", static_cast<double>(metrics.height)}};
}

double fraction_over(const Image& a, const Image& b, double k, const glm::dvec3& background_a,
                     const glm::dvec3& background_b) {
  check_comparable(a, b);
  const double limit = step_limit(k);
  std::size_t over = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const glm::dvec3 difference =
          glm::abs(color_over(a, x, y, background_a) - color_over(b, x, y, background_b));
      for (int c = 0; c < 3; ++c)
        over += difference[c] > limit ? 1 : 0;
    }
  }
  return static_cast<double>(over) / (3.0 * a.width * a.height);
}

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, value] : as_pairs({})) {
      if (name != "width" && name != "height")
        all.push_back(name);
    }
    return all;
  }();
  return names;
}

void validate_metric(const std::string& name) {
  const std::vector<std::string>& known = metric_names();
  if (std::find(known.begin(), known.end(), name) != known.end() || steps_of(name))
    return;
  const auto nearest = nearest_word(name, known);
  throw UsageError("there is no metric '" + name + "'; " +
                   (nearest ? "did you mean " + *nearest + "?"
                            : "known: " + join(known) + " (and over_K_255 for K from 1 to 254)"));
}

std::vector<std::pair<std::string, std::optional<double>>> measure(const std::vector<std::string>& names,
                                                                   const Image& a, const Image& b,
                                                                   const glm::dvec3& background_a,
                                                                   const glm::dvec3& background_b) {
  std::for_each(names.begin(), names.end(), validate_metric);
  check_comparable(a, b);
  std::optional<Metrics> differences;
  std::optional<std::pair<PixelPlane, PixelPlane>> lumas;
  std::vector<std::pair<std::string, std::optional<double>>> measured;
  for (const std::string& name : names) {
    if (name == "flip") {
      measured.emplace_back(name, mean_of(flip_errors(a, b, background_a, background_b)));
    } else if (name == "ssim" || name == "ms_ssim") {
      if (!lumas)
        lumas = {luma_plane(a, background_a), luma_plane(b, background_b)};
      const auto& [la, lb] = *lumas;
      measured.emplace_back(name, name == "ssim" ? ssim(la, lb) : ms_ssim(la, lb));
    } else if (const auto k = steps_of(name)) {
      measured.emplace_back(name, fraction_over(a, b, *k, background_a, background_b));
    } else {
      if (!differences)
        measure_differences(differences.emplace(), a, b, background_a, background_b);
      for (const auto& pair : as_pairs(*differences)) {
        if (pair.first == name)
          measured.push_back(pair);
      }
    }
  }
  return measured;
}

} // namespace slicelens
