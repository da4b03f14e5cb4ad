#include "volume/cell_ranges.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace slicelens {

float rounded_down(double value) {
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) <= value ? near
                                            : std::nextafter(near, -std::numeric_limits<float>::infinity());
}

float rounded_up(double value) { return -rounded_down(-value); }

namespace {

/// Smallest and largest of `count` scalars.
template <class T>
void include_run(const T* run, std::size_t count, T filler, T& low, T& high) {
  for (std::size_t i = 0; i < count; ++i) {
    T value = run[i];
    if constexpr (std::is_floating_point_v<T>)
      value = std::isfinite(value) ? value : filler;
    low = std::min(low, value);
    high = std::max(high, value);
  }
}

/// First and last voxel of cell `i` with its reach.
std::array<std::size_t, 2> voxels_of(std::size_t i, const CellRanges& cells, std::size_t count) {
  const std::size_t first = i * cells.edge;
  return {first - std::min(first, cells.reach), std::min(first + cells.edge + cells.reach, count) - 1};
}

template <class T>
void fill_cell(const Volume& volume, CellRanges& cells, std::size_t i, std::size_t j, std::size_t k) {
  const T* voxels = reinterpret_cast<const T*>(volume.voxels.data());
  const auto& dims = volume.dims;
  const auto x = voxels_of(i, cells, dims[0]);
  const auto y = voxels_of(j, cells, dims[1]);
  const auto z = voxels_of(k, cells, dims[2]);
  T low = std::numeric_limits<T>::max();
  T high = std::numeric_limits<T>::lowest();
  const T filler = static_cast<T>(volume.min);
  for (std::size_t c = z[0]; c <= z[1]; ++c) {
    for (std::size_t b = y[0]; b <= y[1]; ++b)
      include_run(voxels + (c * dims[1] + b) * dims[0] + x[0], x[1] - x[0] + 1, filler, low, high);
  }
  const std::size_t at = (k * cells.size[1] + j) * cells.size[0] + i;
  cells.smallest[at] = rounded_down(static_cast<double>(low));
  cells.largest[at] = rounded_up(static_cast<double>(high));
}

} // namespace

CellRanges cell_ranges(const Volume& volume, std::size_t reach, std::size_t edge) {
  CellRanges cells;
  cells.edge = edge;
  cells.reach = reach;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cells.size[axis] = (volume.dims[axis] + edge - 1) / edge;
  const std::size_t count = cells.size[0] * cells.size[1] * cells.size[2];
  cells.smallest.resize(count);
  cells.largest.resize(count);
  visit_scalar_type(volume.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    const std::size_t rows = cells.size[1] * cells.size[2];
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows), [&](const auto& range) {
      for (std::size_t row = range.begin(); row < range.end(); ++row) {
        for (std::size_t i = 0; i < cells.size[0]; ++i)
          fill_cell<T>(volume, cells, i, row % cells.size[1], row / cells.size[1]);
      }
    });
  });
  return cells;
}

} // namespace slicelens
