#include "study/components.h"

#include "core/errors.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

namespace slicelens {

namespace {

/// Voxels first … last − 1 of a row, all in the object.
struct Run {
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t label = 0;
};

using Row = std::vector<Run>;

/// Union-find by size with path halving; a label's size is that of its set at the root.
struct Labels {
  std::vector<std::size_t> parent;
  std::vector<std::size_t> size;

  std::size_t add(std::size_t voxels) {
    parent.push_back(parent.size());
    size.push_back(voxels);
    return parent.size() - 1;
  }

  std::size_t root(std::size_t label) {
    while (parent[label] != label) {
      parent[label] = parent[parent[label]];
      label = parent[label];
    }
    return label;
  }

  void join(std::size_t a, std::size_t b) {
    a = root(a);
    b = root(b);
    if (a == b)
      return;
    if (size[a] < size[b])
      std::swap(a, b);
    parent[b] = a;
    size[a] += size[b];
  }
};

void find_runs(const std::uint8_t* voxels, std::size_t nx, Labels& labels, Row& row) {
  row.clear();
  for (std::size_t i = 0; i < nx;) {
    if (voxels[i] == 0) {
      ++i;
      continue;
    }
    const std::size_t first = i;
    while (i < nx && voxels[i] != 0)
      ++i;
    row.push_back({first, i, labels.add(i - first)});
  }
}

/// Joins the runs of two neighbouring rows that overlap (`reach` 0), or touch at a corner at least (1).
void join_rows(const Row& a, const Row& b, std::size_t reach, Labels& labels) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (a[i].first < b[j].last + reach && b[j].first < a[i].last + reach)
      labels.join(a[i].label, b[j].label);
    // Between two runs of a row lies at least one voxel, so the next run of the other row begins beyond the
    // reach of the one that ends first.
    if (a[i].last < b[j].last)
      ++i;
    else
      ++j;
  }
}

void check(const VoxelMask& mask) {
  const auto& n = mask.dims;
  const std::size_t count = checked_product(checked_product(n[0], n[1], "mask"), n[2], "mask");
  if (count == 0 || mask.voxels.size() != count)
    throw UsageError("mask of " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
                     std::to_string(n[2]) + " voxels holds " + std::to_string(mask.voxels.size()) +
                     "; every size must be at least 1 and their product must fit");
}

/// Labels all runs, rows in memory order; `see(number of the row's first voxel, row)` gets each row once.
template <class See>
Labels labels_of(const VoxelMask& mask, Connectivity connectivity, const See& see) {
  check(mask);
  const auto [nx, ny, nz] = mask.dims;
  const bool corners = connectivity == Connectivity::corners;
  const std::size_t reach = corners ? 1 : 0;
  Labels labels;
  std::vector<Row> before(ny);
  std::vector<Row> plane(ny);
  for (std::size_t k = 0; k < nz; ++k) {
    std::swap(before, plane);
    for (std::size_t j = 0; j < ny; ++j) {
      const std::size_t start = (k * ny + j) * nx;
      find_runs(mask.voxels.data() + start, nx, labels, plane[j]);
      see(start, plane[j]);
      if (j > 0)
        join_rows(plane[j - 1], plane[j], reach, labels);
      if (k == 0)
        continue;
      join_rows(before[j], plane[j], reach, labels);
      if (corners && j > 0)
        join_rows(before[j - 1], plane[j], reach, labels);
      if (corners && j + 1 < ny)
        join_rows(before[j + 1], plane[j], reach, labels);
    }
  }
  return labels;
}

} // namespace

Components connected_components(const VoxelMask& mask, Connectivity connectivity) {
  Labels labels = labels_of(mask, connectivity, [](std::size_t, const Row&) {});
  Components result;
  for (std::size_t label = 0; label < labels.parent.size(); ++label) {
    if (labels.parent[label] == label)
      result.sizes.push_back(labels.size[label]);
  }
  std::sort(result.sizes.begin(), result.sizes.end(), std::greater<>());
  return result;
}

VoxelMask largest_component(const VoxelMask& mask, Connectivity connectivity) {
  std::vector<std::pair<std::size_t, Run>> runs; // with the number of their row's first voxel
  Labels labels = labels_of(mask, connectivity, [&](std::size_t start, const Row& row) {
    for (const Run& run : row)
      runs.push_back({start, run});
  });
  VoxelMask result{mask.dims, std::vector<std::uint8_t>(mask.voxels.size(), 0)};
  if (runs.empty())
    return result;
  // Labels are given in memory order, so the first of the largest is the first whose set is so large.
  std::size_t largest = labels.root(0);
  for (std::size_t label = 0; label < labels.parent.size(); ++label) {
    if (labels.size[labels.root(label)] > labels.size[largest])
      largest = labels.root(label);
  }
  for (const auto& [start, run] : runs) {
    if (labels.root(run.label) == largest)
      std::fill_n(result.voxels.begin() + static_cast<std::ptrdiff_t>(start + run.first),
                  run.last - run.first, std::uint8_t{1});
  }
  return result;
}

ComponentCount count_components(const Components& components, std::size_t smallest) {
  ComponentCount count;
  for (const std::size_t size : components.sizes) {
    if (size >= smallest) {
      ++count.large;
    } else {
      ++count.tiny;
      count.tiny_voxels += size;
    }
  }
  return count;
}

std::size_t voxel_count(const Components& components) {
  return std::accumulate(components.sizes.begin(), components.sizes.end(), std::size_t{0});
}

} // namespace slicelens
