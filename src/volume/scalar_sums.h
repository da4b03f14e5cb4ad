// What one pass over scalars adds up. Private to src/volume.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

namespace slicelens {

/// Of the finite ones.
struct ScalarSums {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  double sum = 0;
  std::size_t finite = 0;
};

inline ScalarSums joined(const ScalarSums& a, const ScalarSums& b) {
  return {std::min(a.min, b.min), std::max(a.max, b.max), a.sum + b.sum, a.finite + b.finite};
}

} // namespace slicelens
