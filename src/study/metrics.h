// How far two pictures are apart.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slicelens {

/// Differences of two pictures of the same size. All but `ssim`, `ms_ssim` and `flip` are over the R, G and B
/// values d = a − b of all pixels, in display space with peak 1, each picture put over its background first.
struct Metrics {
  int width = 0;
  int height = 0;
  std::optional<double> psnr;         ///< −10·log10(mean d²) in dB; nothing when the pictures are equal
  std::optional<double> psnr_covered; ///< the same over the covered pixels; nothing when equal there, or none
  double ssim = 1;                    ///< mean structural similarity of the luma (study/ssim.h)
  std::optional<double> ms_ssim;      ///< the same over five scales; nothing with a side below 176 pixels
  double flip = 0;                    ///< mean FLIP error at 67 pixels per degree (study/flip.h), in [0,1]
  double rmse = 0;                    ///< √(mean d²)
  double mean_abs = 0;                ///< mean |d|
  double max_abs = 0;                 ///< largest |d|
  double over_1_255 = 0;              ///< fraction of the values with |d| > 1/255
  std::size_t covered_pixels = 0;     ///< pixels that either picture covers
};

/// Compares `a` over `background_a` with `b` over `background_b` (opaque display-space colours, the ones that
/// the pictures were made with). Values may exceed 1 (X-rays in EXR); sums are in double and in row order.
///
/// Covered: in a picture with any alpha below 1, the pixels with alpha above 0 or light (R, G or B other than
/// 0); in an opaque one, those with R, G or B more than half an 8-bit step (1/510) from its background.
///
/// over_1_255: one step between 8-bit pictures must not count, though k/255 is rounded in floats; so the
/// limit is 1/255 + 10⁻⁶, above the rounding of two floats below 1 and far below the next step.
///
/// SSIM and multi-scale SSIM are of the Rec. 709 luma (.2126 R + .7152 G + .0722 B).
///
/// Throws UsageError naming both sizes when they differ, and naming picture ("first", "second"), pixel and
/// channel for a value that is not finite.
Metrics compare_images(const Image& a, const Image& b, const glm::dvec3& background_a = glm::dvec3(0),
                       const glm::dvec3& background_b = glm::dvec3(0));

/// Names and values as `slicelens compare` gives them: metric_names(), then width and height. Nothing stands
/// for JSON's null.
std::vector<std::pair<std::string, std::optional<double>>> as_pairs(const Metrics& metrics);

/// Fraction of the R, G and B values with |d| > k/255 + 10⁻⁶ (the rule of over_1_255), k ≥ 0. Throws as
/// compare_images does.
double fraction_over(const Image& a, const Image& b, double k, const glm::dvec3& background_a = glm::dvec3(0),
                     const glm::dvec3& background_b = glm::dvec3(0));

/// psnr, psnr_covered, ssim, ms_ssim, flip, rmse, mean_abs, max_abs, over_1_255: the names that measure
/// takes, besides over_K_255 for K from 1 to 254.
const std::vector<std::string>& metric_names();

/// Throws UsageError naming the nearest known name unless measure takes `name`.
void validate_metric(const std::string& name);

/// The metrics of these names, in their order, each as compare_images gives it. Computes no others, so that
/// who does not ask for FLIP does not wait for it. Throws as validate_metric and compare_images do.
std::vector<std::pair<std::string, std::optional<double>>>
measure(const std::vector<std::string>& names, const Image& a, const Image& b,
        const glm::dvec3& background_a = glm::dvec3(0), const glm::dvec3& background_b = glm::dvec3(0));

} // namespace slicelens
