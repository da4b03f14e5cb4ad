// Chessboard distances against the definition, cell by cell.
#include "catch.h"
#include "volume/empty_distance.h"

#include <algorithm>
#include <cstdlib>
#include <random>

using namespace slicelens;

namespace {

std::vector<std::uint8_t> by_definition(const std::array<std::size_t, 3>& size,
                                        const std::vector<std::uint8_t>& holds) {
  const auto at = [&](std::size_t i) {
    return std::array<int, 3>{static_cast<int>(i % size[0]), static_cast<int>(i / size[0] % size[1]),
                              static_cast<int>(i / size[0] / size[1])};
  };
  std::vector<std::uint8_t> result;
  for (std::size_t i = 0; i < holds.size(); ++i) {
    int nearest = farthest_distance;
    for (std::size_t j = 0; j < holds.size(); ++j) {
      if (holds[j] == 0)
        continue;
      const auto a = at(i);
      const auto b = at(j);
      nearest =
          std::min(nearest, std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])}));
    }
    result.push_back(static_cast<std::uint8_t>(nearest));
  }
  return result;
}

} // namespace

TEST_CASE("distances to the nearest cell that holds something are those of the definition") {
  std::mt19937 random(7);
  for (const auto& size : {std::array<std::size_t, 3>{1, 1, 1}, {9, 7, 5}, {40, 1, 3}, {2, 33, 6}}) {
    for (const double share : {0.0, 0.004, 0.05, 1.0}) {
      std::vector<std::uint8_t> holds(size[0] * size[1] * size[2]);
      for (std::uint8_t& cell : holds)
        cell = std::uniform_real_distribution<>(0, 1)(random) < share ? 1 : 0;
      CHECK(empty_distances(size, holds) == by_definition(size, holds));
    }
  }
}
