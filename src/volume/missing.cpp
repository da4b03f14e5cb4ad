#include "volume/missing.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace slicelens {

std::optional<double> empty_value(const TransferFunction& transfer, double low, double high) {
  const std::vector<TransferPoint>& points = transfer.points;
  const double span = high > low ? high - low : 1;
  std::vector<double> candidates = {low, high, points.front().value - span, points.back().value + span};
  for (std::size_t k = 0; k < points.size(); ++k) {
    candidates.push_back(points[k].value);
    if (k > 0)
      candidates.push_back(0.5 * (points[k - 1].value + points[k].value)); // between steps
  }
  std::sort(candidates.begin(), candidates.end());
  const auto distance = [&](double value) { return std::max({low - value, value - high, 0.0}); };
  std::optional<double> best;
  for (const double value : candidates) {
    if (evaluate(transfer, value).a == 0 && (!best || distance(value) < distance(*best)))
      best = value;
  }
  return best;
}

void fill_non_finite(Volume& volume, double value) {
  visit_scalar_type(volume.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    if constexpr (std::is_floating_point_v<T>) {
      T* const scalars = reinterpret_cast<T*>(volume.voxels.data());
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, volume.voxels.size() / sizeof(T), std::size_t{1} << 16),
          [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
              if (!std::isfinite(scalars[i]))
                scalars[i] = static_cast<T>(value);
            }
          });
    }
  });
  if (volume.non_finite > 0) {
    volume.min = std::min(volume.min, value);
    volume.max = std::max(volume.max, value);
  }
  volume.non_finite = 0;
}

} // namespace slicelens
