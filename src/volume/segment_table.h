// Pre-integrated classification (Engel, Kraus and Ertl 2001): what a segment of a ray shows between its front
// and its back value.
#pragma once

#include "volume/transfer.h"

#include <cstddef>
#include <vector>

namespace slicelens {

/// Texels along each side of the tables that renderers use: 4 MiB of four floats each.
constexpr std::size_t kSegmentTexels = 512;

/// Associated colour and opacity of segments of one length, for a 2D float texture with linear filtering.
/// Texel (i, j) of N×N is the segment whose value goes linearly from that of texel i in front to that of
/// texel j behind; values are looked up at ((v − first)/(last − first)·(N − 1) + ½)/N.
struct SegmentTable {
  std::size_t texels = 0;  ///< N
  double first = 0;        ///< data value at texel centre 0
  double last = 1;         ///< data value at texel centre N − 1; > first
  std::vector<float> rgba; ///< 4·N² values; i runs fastest
};

/// The table for data in [low, high] and segments of `ratio` reference lengths (> 0).
///
/// With the extinction τ(v) = −ln(1 − α(v)) of a reference length, a segment has the opacity
/// 1 − exp(−ratio ∫₀¹ τ(v(s)) ds) and the colour ∫ C dα in front-to-back order, which counts how it hides
/// itself. The integral of τ over a linear piece of α is taken in closed form. The order of colours is kept
/// down to an eighth of the distance between texels; what lies within that counts as mixed in proportion to
/// its extinction, which errs by less than half of the segment's own share there times the change of colour.
/// An opacity of 1 counts as 1 − 1e-30. Computed in double on all cores. Throws UsageError for an invalid
/// function, a ratio that is not positive and finite, or fewer than 2 texels.
SegmentTable make_segment_table(const TransferFunction& transfer, double low, double high, double ratio,
                                std::size_t texels = kSegmentTexels);

/// The bilinearly filtered table, clamped to its edges.
glm::dvec4 evaluate(const SegmentTable& table, double front, double back);

} // namespace slicelens
