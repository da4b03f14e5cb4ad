#include "volume/scan.h"

#include "volume/scalar_sums.h"
#include "volume/transfer.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <type_traits>

namespace slicelens {

namespace {

/// Bytes of rows that one thread reads at once, if a plane has more.
constexpr std::size_t unit_bytes = std::size_t{4} << 20;

/// First and last cell whose filters read voxel `i`.
std::size_t first_cell(std::size_t i) { return i < scan_reach ? 0 : (i - scan_reach) / cell_edge; }
std::size_t last_cell(std::size_t i, std::size_t cells) {
  return std::min((i + scan_reach) / cell_edge, cells - 1);
}

template <class T>
bool is_number(T value) {
  if constexpr (std::is_floating_point_v<T>)
    return std::isfinite(value);
  else
    return true;
}

template <class T>
bool all_numbers(const T* row, std::size_t count) {
  if constexpr (std::is_floating_point_v<T>) {
    T sum = 0; // x·0 is 0 for numbers and NaN for the rest
    for (std::size_t i = 0; i < count; ++i)
      sum += row[i] * T{0};
    return sum == 0;
  }
  return true;
}

template <class T>
void add_row(const T* row, std::size_t count, ScalarSums& sums) {
  T low = std::numeric_limits<T>::max();
  T high = std::numeric_limits<T>::lowest();
  std::size_t finite = 0;
  // ScalarSums of up to 32 bits are exact in 64, and quicker than in double.
  std::conditional_t<std::is_integral_v<T> && sizeof(T) <= 4, std::int64_t, double> sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool number = is_number(row[i]);
    finite += number ? 1 : 0;
    low = number ? std::min(low, row[i]) : low;
    high = number ? std::max(high, row[i]) : high;
    sum += number ? static_cast<decltype(sum)>(row[i]) : 0;
  }
  if (finite > 0) {
    sums.min = std::min(sums.min, static_cast<double>(low));
    sums.max = std::max(sums.max, static_cast<double>(high));
  }
  sums.sum += static_cast<double>(sum);
  sums.finite += finite;
}

/// Extremes of the numbers of a few rows, column by column, or of the voxels around each cell.
template <class T>
struct Extremes {
  std::vector<T> low;
  std::vector<T> high;
  std::vector<std::uint8_t> missing; ///< whether there is a value that is no number; floats only

  void reset(std::size_t count) {
    low.assign(count, std::numeric_limits<T>::max());
    high.assign(count, std::numeric_limits<T>::lowest());
    missing.assign(std::is_floating_point_v<T> ? count : 0, 0);
  }
};

template <class T>
void include_row(const T* row, std::size_t count, bool numbers, Extremes<T>& columns) {
  T* const low = columns.low.data();
  T* const high = columns.high.data();
  if (numbers) {
    for (std::size_t i = 0; i < count; ++i) {
      low[i] = std::min(low[i], row[i]);
      high[i] = std::max(high[i], row[i]);
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (is_number(row[i])) {
      low[i] = std::min(low[i], row[i]);
      high[i] = std::max(high[i], row[i]);
    } else {
      columns.missing[i] = 1;
    }
  }
}

/// A scan of voxels of type T while it goes on.
template <class T>
class Scanner {
public:
  Scanner(const VoxelStream& stream, const Volume& volume, const Progress& progress)
      : stream_(stream), dims_(volume.dims), progress_(progress) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      cells_[axis] = (dims_[axis] + cell_edge - 1) / cell_edge;
    around_.reset(cells_[0] * cells_[1] * cells_[2]);
    layers_ = std::make_unique<std::mutex[]>(cells_[2]);
    const bool planes = stream.grain()[1] >= dims_[1];
    rows_ = planes ? dims_[1] : std::clamp<std::size_t>(unit_bytes / (dims_[0] * sizeof(T)), 1, dims_[1]);
    units_in_plane_ = (dims_[1] + rows_ - 1) / rows_;
    sums_.resize(units_in_plane_ * dims_[2]);
    stride_ = transfer_stride(voxel_count(volume));
    samples_.resize((voxel_count(volume) + stride_ - 1) / stride_);
  }

  /// Takes pieces until there are none left.
  void work() {
    std::vector<T> voxels;
    Extremes<T> columns;
    try {
      for (std::size_t unit = next_++; unit < sums_.size() && !failed_; unit = next_++) {
        scan_unit(unit, voxels, columns);
        const std::lock_guard lock(said_);
        report_progress(progress_, "scan", static_cast<double>(++done_) / static_cast<double>(sums_.size()));
      }
    } catch (...) {
      failed_ = true; // the others need not go on
      throw;
    }
  }

  VoxelScan result() {
    VoxelScan scan;
    ScalarSums all;
    for (const ScalarSums& one : sums_) // in the file's order, so that the mean is always the same
      all = joined(all, one);
    scan.non_finite = dims_[0] * dims_[1] * dims_[2] - all.finite;
    if (all.finite > 0) {
      scan.min = all.min;
      scan.max = all.max;
      scan.mean = all.sum / static_cast<double>(all.finite);
    }
    fill_cells(scan);
    for (const double value : samples_) {
      if (std::abs(value) <= kMaxTransferValue)
        scan.samples.push_back(value);
    }
    return scan;
  }

private:
  void scan_unit(std::size_t unit, std::vector<T>& voxels, Extremes<T>& columns) {
    const std::size_t k = unit / units_in_plane_;
    const std::size_t first = unit % units_in_plane_ * rows_;
    const std::size_t rows = std::min(rows_, dims_[1] - first);
    const std::size_t nx = dims_[0];
    voxels.resize(nx * rows);
    stream_.read({{0, first, k}, {nx, rows, 1}}, std::as_writable_bytes(std::span(voxels)));
    for (std::size_t j = 0; j < rows; ++j)
      add_row(voxels.data() + j * nx, nx, sums_[unit]);
    take_samples(voxels, (k * dims_[1] + first) * nx);
    for (std::size_t cell = first_cell(first); cell <= last_cell(first + rows - 1, cells_[1]); ++cell) {
      const std::size_t low = cell * cell_edge - std::min(cell * cell_edge, scan_reach);
      const std::size_t high = std::min((cell + 1) * cell_edge + scan_reach, dims_[1]);
      columns.reset(nx);
      for (std::size_t j = std::max(low, first); j < std::min(high, first + rows); ++j) {
        const T* const row = voxels.data() + (j - first) * nx;
        include_row(row, nx, all_numbers(row, nx), columns);
      }
      merge(columns, cell, k);
    }
  }

  void take_samples(const std::vector<T>& voxels, std::size_t begin) {
    for (std::size_t i = (begin + stride_ - 1) / stride_ * stride_; i < begin + voxels.size(); i += stride_)
      samples_[i / stride_] = static_cast<double>(voxels[i - begin]);
  }

  /// Columns of rows around the cells of row `j`, in plane `k`, into these cells.
  void merge(const Extremes<T>& columns, std::size_t j, std::size_t k) {
    for (std::size_t layer = first_cell(k); layer <= last_cell(k, cells_[2]); ++layer) {
      const std::lock_guard lock(layers_[layer]);
      const std::size_t row = (layer * cells_[1] + j) * cells_[0];
      for (std::size_t i = 0; i < cells_[0]; ++i) {
        const std::size_t begin = i * cell_edge - std::min(i * cell_edge, scan_reach);
        const std::size_t end = std::min((i + 1) * cell_edge + scan_reach, dims_[0]);
        T& low = around_.low[row + i];
        T& high = around_.high[row + i];
        for (std::size_t x = begin; x < end; ++x) {
          low = std::min(low, columns.low[x]);
          high = std::max(high, columns.high[x]);
          if constexpr (std::is_floating_point_v<T>)
            around_.missing[row + i] |= columns.missing[x];
        }
      }
    }
  }

  void fill_cells(VoxelScan& scan) {
    scan.cells.size = cells_;
    scan.cells.reach = scan_reach;
    const T filler = static_cast<T>(scan.min);
    for (std::size_t i = 0; i < around_.low.size(); ++i) {
      T low = around_.low[i];
      T high = around_.high[i];
      if (!around_.missing.empty() && around_.missing[i] != 0) {
        low = std::min(low, filler);
        high = std::max(high, filler);
      }
      scan.cells.smallest.push_back(rounded_down(static_cast<double>(low)));
      scan.cells.largest.push_back(rounded_up(static_cast<double>(high)));
    }
  }

  const VoxelStream& stream_;
  std::array<std::size_t, 3> dims_;
  const Progress& progress_;
  std::array<std::size_t, 3> cells_{};
  Extremes<T> around_; ///< of every cell
  std::unique_ptr<std::mutex[]> layers_;
  std::size_t rows_ = 1; ///< that are read at once
  std::size_t units_in_plane_ = 1;
  std::vector<ScalarSums> sums_; ///< of every unit: rows of one plane
  std::size_t stride_ = 1;
  std::vector<double> samples_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex said_;
  std::size_t done_ = 0;
};

} // namespace

VoxelScan scan_voxels(const VoxelStream& stream, const Volume& volume, int threads,
                      const Progress& progress) {
  return visit_scalar_type(volume.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    Scanner<T> scanner(stream, volume, progress);
    const int workers = threads > 0 ? threads : tbb::this_task_arena::max_concurrency();
    if (workers == 1)
      scanner.work();
    else
      tbb::parallel_for(0, workers, [&](int) { scanner.work(); });
    return scanner.result();
  });
}

VoxelScan scan_of(const Volume& volume) {
  if (is_streamed(volume)) {
    return {volume.min,
            volume.max,
            volume.mean,
            volume.non_finite,
            volume.streamed->cells,
            volume.streamed->samples};
  }
  return {volume.min,
          volume.max,
          volume.mean,
          volume.non_finite,
          cell_ranges(volume, scan_reach),
          transfer_samples(volume)};
}

void set_statistics(Volume& volume, const VoxelScan& scan) {
  volume.min = scan.min;
  volume.max = scan.max;
  volume.mean = scan.mean;
  volume.non_finite = scan.non_finite;
}

} // namespace slicelens
