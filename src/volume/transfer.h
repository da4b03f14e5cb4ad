// Transfer functions: colour and opacity as piecewise linear functions of the data value, and the tables that
// float textures are filled from.
#pragma once

#include "volume/volume.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// One knot. `value` is in data units (HU for CT); colour and opacity are in [0,1], colour straight (not
/// associated), in display space.
struct TransferPoint {
  double value = 0;
  double r = 0;
  double g = 0;
  double b = 0;
  double opacity = 0; ///< α per reference length Δ₀ (docs/pipeline.md, opacity correction)
};

/// Piecewise linear through `points`, constant beyond the first and the last one. Colour is interpolated as
/// given, not multiplied by opacity, as with VTK's separate colour and opacity functions. Two points at the
/// same value make a step.
struct TransferFunction {
  std::vector<TransferPoint> points; ///< values non-decreasing, at most two equal ones in a row
  std::optional<double>
      unit_distance; ///< Δ₀ in world units; empty: h, the smallest voxel spacing in the scene
  std::string name;  ///< preset or file it came from; may be empty
};

/// Largest magnitude of a knot's value: what a float can hold.
constexpr double kMaxTransferValue = 1e38;

/// Throws UsageError naming the point's index and value unless there is at least one point, all values are
/// numbers within ±kMaxTransferValue and non-decreasing with at most two equal ones in a row, all colours and
/// opacities lie in [0,1], and unit_distance, where given, is finite and > 0.
void validate(const TransferFunction& transfer);

/// (r, g, b, opacity) at a data value, exact. A step's own value belongs to its right side. A NaN value gives
/// (0,0,0,0): it shows nothing. `transfer` must be valid.
glm::dvec4 evaluate(const TransferFunction& transfer, double value);

/// The function stretched onto another range of values: its own one, from the first point to the last, is
/// mapped linearly onto [level − window/2, level + window/2] (data units; level is the centre, window the
/// width, as in DICOM PS3.3 C.11.2.1.2 and 3D Slicer). What is not given stays the function's own. Opacities
/// keep their reference length. Throws UsageError naming the key where window is not > 0, where the
/// function's points all have one value, so that no width can be given to them (level moves them), and where
/// the points fall together.
TransferFunction windowed(TransferFunction transfer, std::optional<double> window,
                          std::optional<double> level);

/// A transfer function of constant colour and opacity.
TransferFunction constant_transfer(const glm::dvec4& rgba);

/// `below` for values < threshold, `above` from the threshold on: what cuts the `ball` phantom exactly.
TransferFunction step_transfer(double threshold, const glm::dvec4& below, const glm::dvec4& above);

/// Samples of a transfer function for a 1D float texture with linear filtering, clamped to the edge. Texel i
/// of N has its centre at first + (last − first)·i/(N − 1), so a value v is looked up at the texture
/// coordinate ((v − first)/(last − first)·(N − 1) + ½)/N.
struct TransferTable {
  double first = 0;        ///< data value at texel centre 0
  double last = 1;         ///< data value at texel centre N − 1; > first
  std::vector<float> rgba; ///< 4·N values, straight colour
  /// Largest difference of any channel between the linearly filtered table and the exact function, for values
  /// inside the domain, outside of the texel intervals that contain a step.
  double deviation = 0;
  /// Number of steps in (first, last]: each is drawn as a ramp of one texel interval.
  std::size_t steps = 0;
};

constexpr std::size_t kMinTransferTexels = 256;
constexpr std::size_t kMaxTransferTexels = 16384;

/// Number of texels N of a table.
std::size_t texel_count(const TransferTable& table);

/// Value of the linearly filtered table at a data value, as a driver with exact filter weights returns it.
glm::dvec4 evaluate(const TransferTable& table, double value);

/// The table of a valid transfer function for data in [low, high]. Its domain is the part of the knots' span
/// that such data can reach (beyond it the function, and so the clamped table, is constant); low ≥ high: the
/// whole span, and a step on its end moves that end outwards by 1/64. A span of zero length (a single point,
/// a single step) gets a domain of 1/16384 of high − low centred on it, so a lone step is a ramp whose middle
/// lies exactly on the step (an even number of texels).
///
/// `texels` = 0 chooses: a function with steps gets kMaxTransferTexels; else the smallest
/// size from 256 to 1024 that has every knot on a texel centre, if there is one; else the smallest power of
/// two up to kMaxTransferTexels that keeps the deviation below 1e-4, or kMaxTransferTexels. Throws UsageError
/// for an invalid function or a size that is neither 0 nor in [2, kMaxTransferTexels].
TransferTable make_table(const TransferFunction& transfer, std::size_t texels = 0, double low = 0,
                         double high = 0);

/// One entry of the list of presets.
struct PresetInfo {
  std::string name;
  std::string description;
  bool relative = false;   ///< true: stretched over the data's range; false: absolute, in `unit`
  std::string unit = "HU"; ///< of absolute ones
};

/// The presets by the names that 3D Slicer's users know, with this project's own values, and cast-and-steel,
/// grey-ramp, halves, fog and opaque. Ordered as listed to users.
const std::vector<PresetInfo>& presets();

/// The transfer function of a preset. `data_min` and `data_max` (finite) are the range over which relative
/// presets are stretched; absolute ones ignore them. When data_min ≥ data_max (a constant volume) the range
/// [data_min − 1, data_min] is used, so that the constant lies at the visible end. Throws UsageError naming
/// the nearest preset when there is none of that name.
TransferFunction preset(const std::string& name, double data_min = 0, double data_max = 1);

/// A sensible transfer function from the histogram of a volume's component 0, for when none is given:
/// the background class (Otsu 1979) is transparent, the rest rises from translucent warm colours to dense
/// light ones, saturating at the 99.9th percentile. Volumes of integer type with at most 64 different values
/// count as labels: all but the smallest value are shown with opacity ½. A constant volume is uniformly
/// translucent. Deterministic; large volumes are subsampled on a fixed stride.
TransferFunction automatic_transfer(const Volume& volume);

/// The stride above, in voxels, of a volume of so many.
std::size_t transfer_stride(std::size_t voxels);

/// The values of component 0 on that stride that a knot may have, in the voxels' order.
std::vector<double> transfer_samples(const Volume& volume);

} // namespace slicelens
