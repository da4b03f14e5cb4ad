#include "warp/warp_grid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

struct Sum {
  double largest = 0;
  double squares = 0;
  std::size_t count = 0;
};

bool in_data(const BoxSpace& space, const glm::dvec3& u) {
  return glm::all(glm::greaterThanEqual(u, glm::dvec3(0))) && glm::all(glm::lessThanEqual(u, space.size));
}

} // namespace

MapGrid make_map_grid(const std::vector<WarpMap>& maps, const std::array<std::size_t, 3>& size,
                      const glm::dvec3& low, const glm::dvec3& high) {
  return make_map_grid([&](const glm::dvec3& p) { return texture_from_object(maps, p); }, size, low, high);
}

MapGridError map_grid_error(const MapGrid& grid, const std::vector<WarpMap>& maps, const BoxSpace& space,
                            const glm::dvec3& voxels) {
  constexpr std::size_t n = 96; // the same points for every size of the grid
  const GridMap sampled{std::shared_ptr<const MapGrid>(std::shared_ptr<const MapGrid>(), &grid)};
  const auto add_plane = [&](const tbb::blocked_range<std::size_t>& planes, Sum sum) {
    for (std::size_t point = planes.begin() * n * n; point < planes.end() * n * n; ++point) {
      const glm::dvec3 at(static_cast<double>(point % n), static_cast<double>(point / n % n),
                          static_cast<double>(point / n / n));
      const glm::dvec3 p = grid.low + (at + 0.5) / static_cast<double>(n) * (grid.high - grid.low);
      const glm::dvec3 exact = texture_from_object(maps, p);
      const glm::dvec3 held = texture_from_object(sampled, p);
      if (!in_data(space, exact) && !in_data(space, held))
        continue;
      const double error = glm::length((held - exact) / space.size * voxels);
      sum.largest = std::max(sum.largest, error);
      sum.squares += error * error;
      ++sum.count;
    }
    return sum;
  };
  const Sum total = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, n, 4), Sum{}, add_plane, [](const Sum& a, const Sum& b) {
        return Sum{std::max(a.largest, b.largest), a.squares + b.squares, a.count + b.count};
      });
  return {total.largest, total.count > 0 ? std::sqrt(total.squares / static_cast<double>(total.count)) : 0};
}

} // namespace slicelens
