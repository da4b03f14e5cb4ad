#include "catch.h"
#include "core/errors.h"
#include "study/components.h"

#include <cmath>
#include <limits>
#include <numbers>

using namespace slicelens;

namespace {

VoxelMask filled(std::size_t nx, std::size_t ny, std::size_t nz, std::uint8_t value) {
  return {{nx, ny, nz}, std::vector<std::uint8_t>(nx * ny * nz, value)};
}

void set(VoxelMask& mask, std::size_t i, std::size_t j, std::size_t k) {
  mask.voxels[(k * mask.dims[1] + j) * mask.dims[0] + i] = 1;
}

void set_cube(VoxelMask& mask, std::size_t low, std::size_t high) {
  for (std::size_t k = low; k < high; ++k)
    for (std::size_t j = low; j < high; ++j)
      for (std::size_t i = low; i < high; ++i)
        set(mask, i, j, k);
}

using Sizes = std::vector<std::size_t>;

Sizes sizes(const VoxelMask& mask, Connectivity connectivity) {
  return connected_components(mask, connectivity).sizes;
}

/// The same by flooding from every voxel not yet seen, neighbours looked up one by one.
Sizes flooded(const VoxelMask& mask, bool corners) {
  const auto n = mask.dims;
  std::vector<std::uint8_t> left = mask.voxels;
  Sizes result;
  for (std::size_t seed = 0; seed < left.size(); ++seed) {
    if (left[seed] == 0)
      continue;
    std::size_t size = 0;
    Sizes stack{seed};
    left[seed] = 0;
    while (!stack.empty()) {
      const std::size_t v = stack.back();
      stack.pop_back();
      ++size;
      const std::size_t i = v % n[0], j = v / n[0] % n[1], k = v / n[0] / n[1];
      for (std::size_t d = 0; d < 27; ++d) {
        // Coordinates + 1, so that they stay unsigned: 0 and n + 1 lie outside.
        const std::size_t x = i + d % 3, y = j + d / 3 % 3, z = k + d / 9;
        const int apart = (d % 3 != 1) + (d / 3 % 3 != 1) + (d / 9 != 1);
        if (x < 1 || x > n[0] || y < 1 || y > n[1] || z < 1 || z > n[2] || (!corners && apart > 1))
          continue;
        const std::size_t w = ((z - 1) * n[1] + y - 1) * n[0] + x - 1;
        if (left[w] != 0) {
          left[w] = 0;
          stack.push_back(w);
        }
      }
    }
    result.push_back(size);
  }
  std::sort(result.rbegin(), result.rend());
  return result;
}

} // namespace

TEST_CASE("components of empty, full and one-voxel volumes") {
  for (const Connectivity c : {Connectivity::faces, Connectivity::corners}) {
    CHECK(sizes(filled(5, 4, 3, 0), c).empty());
    CHECK(sizes(filled(5, 4, 3, 1), c) == Sizes{60});
    CHECK(sizes(filled(1, 1, 1, 0), c).empty());
    CHECK(sizes(filled(1, 1, 1, 255), c) == Sizes{1});
    CHECK(sizes(filled(1, 1, 9, 1), c) == Sizes{9});
  }
}

TEST_CASE("cubes that touch at a corner or an edge are one with 26 neighbours and two with 6") {
  VoxelMask mask = filled(8, 8, 8, 0);
  set_cube(mask, 1, 4);
  set_cube(mask, 4, 6);
  CHECK(sizes(mask, Connectivity::corners) == Sizes{35});
  CHECK(sizes(mask, Connectivity::faces) == Sizes{27, 8});
  // every one of the 26 neighbours, alone with the middle
  for (std::size_t d = 0; d < 27; ++d) {
    if (d == 13)
      continue;
    VoxelMask pair = filled(3, 3, 3, 0);
    set(pair, 1, 1, 1);
    set(pair, d % 3, d / 3 % 3, d / 9);
    const bool face = d == 4 || d == 10 || d == 12 || d == 14 || d == 16 || d == 22;
    CAPTURE(d);
    CHECK(sizes(pair, Connectivity::corners) == Sizes{2});
    CHECK(sizes(pair, Connectivity::faces) == (face ? Sizes{2} : Sizes{1, 1}));
  }
}

TEST_CASE("a gap of one voxel separates") {
  VoxelMask mask = filled(5, 1, 1, 1);
  mask.voxels[2] = 0;
  CHECK(sizes(mask, Connectivity::corners) == Sizes{2, 2});
  VoxelMask planes = filled(3, 3, 3, 1);
  for (std::size_t v = 9; v < 18; ++v)
    planes.voxels[v] = 0;
  CHECK(sizes(planes, Connectivity::corners) == Sizes{9, 9});
}

TEST_CASE("the end of a row, a plane and the volume is no neighbour of the next one's start") {
  VoxelMask row = filled(4, 4, 4, 0);
  set(row, 3, 0, 0);
  set(row, 0, 1, 0); // next in memory
  CHECK(sizes(row, Connectivity::corners) == Sizes{1, 1});
  VoxelMask plane = filled(4, 4, 4, 0);
  set(plane, 3, 3, 0);
  set(plane, 0, 0, 1); // next in memory
  CHECK(sizes(plane, Connectivity::corners) == Sizes{1, 1});
  VoxelMask opposite = filled(4, 4, 4, 0);
  set(opposite, 0, 0, 0);
  set(opposite, 3, 0, 0);
  set(opposite, 0, 3, 0);
  set(opposite, 0, 0, 3);
  CHECK(sizes(opposite, Connectivity::corners) == Sizes{1, 1, 1, 1});
}

TEST_CASE("a helix is one piece, two strands of it are two") {
  VoxelMask mask = filled(40, 40, 60, 0);
  const auto strand = [&](double phase, double from) {
    // Steps of 0.01 rad · 15 voxels = 0.15 voxel, so that no voxel of the curve is skipped.
    for (double t = from; t < 6 * std::numbers::pi; t += 0.01)
      set(mask, static_cast<std::size_t>(20 + 15 * std::cos(t + phase)),
          static_cast<std::size_t>(20 + 15 * std::sin(t + phase)), static_cast<std::size_t>(3 * t));
  };
  strand(0, 0);
  CHECK(sizes(mask, Connectivity::corners).size() == 1);
  strand(std::numbers::pi, 0);
  const Sizes two = sizes(mask, Connectivity::corners);
  CHECK(two.size() == 2);
  CHECK(two == flooded(mask, true));
}

TEST_CASE("a spiral in a plane is joined late: labels that met at its end only") {
  // U-shaped teeth: many runs get labels of their own that one row at the bottom joins.
  VoxelMask comb = filled(63, 20, 1, 0);
  for (std::size_t i = 0; i < 63; i += 2)
    for (std::size_t j = 0; j < 20; ++j)
      set(comb, i, j, 0);
  CHECK(sizes(comb, Connectivity::corners) == Sizes(32, 20));
  for (std::size_t i = 0; i < 63; ++i)
    set(comb, i, 19, 0);
  CHECK(sizes(comb, Connectivity::faces) == Sizes{32 * 20 + 31});
}

TEST_CASE("a checkerboard falls apart with 6 neighbours and holds with 26") {
  VoxelMask mask = filled(7, 6, 5, 0);
  for (std::size_t v = 0; v < mask.voxels.size(); ++v)
    mask.voxels[v] = (v % 7 + v / 7 % 6 + v / 42) % 2 == 0 ? 1 : 0;
  CHECK(sizes(mask, Connectivity::faces) == Sizes(105, 1));
  CHECK(sizes(mask, Connectivity::corners) == Sizes{105});
}

TEST_CASE("components agree with flooding on random masks") {
  std::uint64_t state = 7;
  for (const std::uint64_t percent : {4, 10, 25, 31, 60}) {
    VoxelMask mask = filled(23, 17, 19, 0);
    for (std::uint8_t& v : mask.voxels) {
      state = state * 6364136223846793005ULL + 1442695040888963407ULL;
      v = (state >> 33) % 100 < percent ? 1 : 0;
    }
    CAPTURE(percent);
    CHECK(sizes(mask, Connectivity::corners) == flooded(mask, true));
    CHECK(sizes(mask, Connectivity::faces) == flooded(mask, false));
  }
}

TEST_CASE("the largest component alone") {
  VoxelMask mask = filled(8, 8, 8, 0);
  set_cube(mask, 1, 4);
  set_cube(mask, 4, 6);
  VoxelMask cube = filled(8, 8, 8, 0);
  set_cube(cube, 1, 4);
  CHECK(largest_component(mask, Connectivity::faces).voxels == cube.voxels);
  CHECK(largest_component(mask, Connectivity::corners).voxels == mask.voxels);
  VoxelMask equal = filled(5, 1, 1, 1);
  equal.voxels[2] = 0;
  CHECK(largest_component(equal).voxels == std::vector<std::uint8_t>{1, 1, 0, 0, 0});
  CHECK(largest_component(filled(2, 2, 2, 0)).voxels == std::vector<std::uint8_t>(8, 0));
  CHECK(largest_component(filled(2, 2, 2, 9)).voxels == std::vector<std::uint8_t>(8, 1));
}

TEST_CASE("tiny components are counted apart") {
  const ComponentCount count = count_components({{100, 8, 7, 7, 1}}, 8);
  CHECK(count.large == 2);
  CHECK(count.tiny == 3);
  CHECK(count.tiny_voxels == 15);
  CHECK(voxel_count(Components{{100, 8, 7, 7, 1}}) == 123);
  CHECK(count_components({}, 8).large == 0);
}

TEST_CASE("masks whose size is wrong are refused") {
  CHECK_THROWS_AS(connected_components({{2, 2, 2}, std::vector<std::uint8_t>(7)}), UsageError);
  CHECK_THROWS_AS(connected_components({{0, 2, 2}, {}}), UsageError);
  // the product of these overflows to 0
  const std::size_t half = std::size_t{1} << (std::numeric_limits<std::size_t>::digits / 2);
  CHECK_THROWS_AS(connected_components({{half, half, 2}, {}}), LimitError);
}
