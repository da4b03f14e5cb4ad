// Structural similarity, at one scale and at five.
#pragma once

#include "study/planes.h"

#include <optional>

namespace slicelens {

/// Mean structural similarity (Wang, Bovik, Sheikh, Simoncelli, "Image Quality Assessment: From Error
/// Visibility to Structural Similarity", IEEE TIP 13(4) 2004, eq. 13) with an 11×11 Gaussian window of σ
/// = 1.5 and population (co)variances, K₁ = .01, K₂ = .03, L = 1, averaged over the positions where the
/// window lies inside (scikit-image: gaussian_weights, use_sample_covariance=False, data_range=1). Along a
/// side below 11 pixels the window has the largest odd width that fits. 1 for equal planes, at least −1.
double ssim(const PixelPlane& a, const PixelPlane& b);

/// Shortest side that multi-scale SSIM is defined for: 16 times the window's 11 pixels, because the fifth
/// scale is a sixteenth of the picture (the rule of the authors' own program).
inline constexpr int smallest_ms_ssim_side = 176;

/// Multi-scale structural similarity (Wang, Simoncelli, Bovik, "Multi-scale Structural Similarity for Image
/// Quality Assessment", Asilomar 2003, eq. 7): ∏ CS_j^β_j · SSIM_5^β_5 over five scales, each half as wide as
/// the one before, with β = .0448, .2856, .3001, .2363, .1333. CS_j is the mean over scale j of contrast
/// times structure (2σ_ab + C₂)/(σ_a² + σ_b² + C₂); the last scale has the luminance term besides. A scale is
/// made by averaging 2×2 pixels, an odd last row or column with itself. A negative mean, which has no real
/// power, counts as 0. Nothing when a side is shorter than smallest_ms_ssim_side.
std::optional<double> ms_ssim(const PixelPlane& a, const PixelPlane& b);

} // namespace slicelens
