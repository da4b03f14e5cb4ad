// The transfer function that is used when none is given.
#include "volume/streamed.h"
#include "volume/transfer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace slicelens {

namespace {

constexpr std::size_t kBins = 1024;
constexpr std::size_t kMaxLabels = 64;

struct Samples {
  std::vector<double> values; ///< transfer_samples
  std::set<double> distinct;  ///< at most kMaxLabels + 1 of them
};

Samples sample_values(const Volume& volume) {
  Samples samples;
  samples.values = is_streamed(volume) ? volume.streamed->samples : transfer_samples(volume);
  for (const double value : samples.values) {
    if (samples.distinct.size() > kMaxLabels)
      break;
    samples.distinct.insert(value);
  }
  return samples;
}

/// Value at a fraction of the sorted samples. Reorders them.
double percentile(std::vector<double>& values, double fraction) {
  const auto nth =
      values.begin() + static_cast<std::ptrdiff_t>(fraction * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The threshold that maximises the variance between two classes: Otsu, A Threshold Selection Method from
/// Gray-Level Histograms, IEEE Trans. SMC 9(1), 1979, eq. 14 and 18. Where a range of thresholds does equally
/// well (an empty valley) its middle is taken.
double otsu_threshold(const std::vector<double>& values, double low, double high) {
  std::array<double, kBins> histogram{};
  const double width = (high - low) / kBins;
  for (const double value : values) {
    const double bin = std::clamp((value - low) / width, 0.0, kBins - 1.0);
    histogram[static_cast<std::size_t>(bin)] += 1;
  }
  const double total = static_cast<double>(values.size());
  double mean = 0;
  for (std::size_t i = 0; i < kBins; ++i)
    mean += static_cast<double>(i) * histogram[i] / total;
  double weight = 0;
  double moment = 0;
  double best = -1;
  std::size_t first = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i + 1 < kBins; ++i) {
    weight += histogram[i] / total;
    moment += static_cast<double>(i) * histogram[i] / total;
    if (weight <= 0 || weight >= 1)
      continue;
    const double variance = (mean * weight - moment) * (mean * weight - moment) / (weight * (1 - weight));
    if (variance > best * (1 + 1e-12)) {
      best = variance;
      first = i;
      last = i;
    } else if (variance >= best * (1 - 1e-12)) {
      last = i;
    }
  }
  return low + width * (static_cast<double>(first + last) / 2 + 1);
}

/// Warm and dark to light: how tissue is usually drawn. f in [0,1].
TransferPoint warm_point(double value, double f, double opacity) {
  const TransferFunction palette{
      {{0, .45, .16, .12, 0}, {.3, .80, .48, .36, 0}, {.6, .93, .76, .60, 0}, {1, 1, .97, .90, 0}}, {}, ""};
  const glm::dvec4 rgba = evaluate(palette, f);
  return {value, rgba.r, rgba.g, rgba.b, opacity};
}

TransferFunction label_transfer(const std::set<double>& labels) {
  TransferFunction transfer{{}, std::nullopt, "automatic"};
  const double threshold = *labels.begin() + 0.5; // integers: between the background and the first label
  transfer.points.push_back(warm_point(threshold, 0, 0));
  transfer.points.push_back(warm_point(threshold, 0, 0.5));
  const double last = *labels.rbegin();
  for (const double label : labels) {
    if (label > threshold) {
      const double f = last - threshold > 0.5 ? (label - threshold) / (last - threshold) : 1.0;
      transfer.points.push_back(warm_point(label, f, 0.5));
    }
  }
  return transfer;
}

bool is_integer(ScalarType type) { return type != ScalarType::f32 && type != ScalarType::f64; }

} // namespace

std::size_t transfer_stride(std::size_t voxels) {
  // About a million samples place every percentile below to a thousandth. The stride is odd, so that it does
  // not walk along one column of a power-of-two grid.
  return (voxels >> 20) | 1;
}

std::vector<double> transfer_samples(const Volume& volume) {
  const std::size_t voxels = voxel_count(volume);
  const auto components = static_cast<std::size_t>(volume.components);
  const std::size_t stride = transfer_stride(voxels);
  std::vector<double> samples;
  samples.reserve(voxels / stride + 1);
  for (std::size_t i = 0; i < voxels; i += stride) {
    const double value = scalar_at(volume, i * components);
    if (std::abs(value) <= kMaxTransferValue)
      samples.push_back(value);
  }
  return samples;
}

TransferFunction automatic_transfer(const Volume& volume) {
  Samples samples = sample_values(volume);
  if (samples.distinct.size() < 2) {
    const double value = samples.distinct.empty() ? 0.0 : *samples.distinct.begin();
    return {{warm_point(value, 0.6, 0.02)}, std::nullopt, "automatic"};
  }
  if (is_integer(volume.type) && samples.distinct.size() <= kMaxLabels)
    return label_transfer(samples.distinct);
  // Outliers (metal, padding outside the scanner's field of view) must not stretch the histogram.
  double low = percentile(samples.values, 0.001);
  double high = percentile(samples.values, 0.999);
  if (!(low < high)) { // nearly all samples are equal: what differs is what there is to see
    low = *std::min_element(samples.values.begin(), samples.values.end());
    high = *std::max_element(samples.values.begin(), samples.values.end());
  }
  const double threshold = otsu_threshold(samples.values, low, high);
  const double span = std::max(high - threshold, (high - low) * 1e-3);
  return {{warm_point(threshold, 0, 0), warm_point(threshold + 0.1 * span, 0.2, 0.03),
           warm_point(threshold + 0.35 * span, 0.5, 0.08), warm_point(threshold + 0.7 * span, 0.8, 0.4),
           warm_point(threshold + span, 1, 0.8)},
          std::nullopt,
          "automatic"};
}

} // namespace slicelens
