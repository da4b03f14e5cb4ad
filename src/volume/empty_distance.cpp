#include "volume/empty_distance.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace slicelens {

namespace {

/// Cells in a row: the first, how many, and the step from one to the next.
struct Row {
  std::size_t first;
  std::size_t count;
  std::size_t step;
};

/// out[i] = min over j of max(|i − j|, in[j]): distances that counted other axes only count this one as well.
void spread(std::uint8_t* cells, const Row& row, std::vector<std::uint8_t>& before) {
  before.resize(row.count);
  for (std::size_t i = 0; i < row.count; ++i)
    before[i] = cells[row.first + i * row.step];
  for (std::size_t i = 0; i < row.count; ++i) {
    std::size_t best = before[i];
    // Farther than the best so far nothing can be nearer.
    for (std::size_t way = 1; way < best; ++way) {
      if (way > i && i + way >= row.count)
        break;
      const std::size_t left = way <= i ? before[i - way] : farthest_distance;
      const std::size_t right = i + way < row.count ? before[i + way] : farthest_distance;
      best = std::min(best, std::max(way, std::min(left, right)));
    }
    cells[row.first + i * row.step] = static_cast<std::uint8_t>(best);
  }
}

/// Each row of one axis.
template <class RowOf>
void spread_all(std::uint8_t* cells, std::size_t rows, const RowOf& row_of) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rows), [&](const auto& range) {
    std::vector<std::uint8_t> before;
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      spread(cells, row_of(i), before);
  });
}

} // namespace

std::vector<std::uint8_t> empty_distances(const std::array<std::size_t, 3>& size,
                                          std::span<const std::uint8_t> holds) {
  std::vector<std::uint8_t> cells(holds.size());
  std::transform(holds.begin(), holds.end(), cells.begin(),
                 [](std::uint8_t held) { return held != 0 ? std::uint8_t{0} : farthest_distance; });
  const auto [nx, ny, nz] = size;
  const std::size_t plane = nx * ny;
  spread_all(cells.data(), ny * nz, [&](std::size_t i) { return Row{i * nx, nx, 1}; });
  spread_all(cells.data(), nx * nz, [&](std::size_t i) { return Row{i / nx * plane + i % nx, ny, nx}; });
  spread_all(cells.data(), plane, [&](std::size_t i) { return Row{i, nz, plane}; });
  return cells;
}

} // namespace slicelens
