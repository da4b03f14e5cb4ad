// The phantoms made of cells: checkerboard and brick. Their edges are averaged over one voxel in closed form,
// so that they have no stairs and any size shows the same pattern.
#include "volume/phantom_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace slicelens {

namespace {

/// ∫₀ˣ s, s the square wave that is 1 on [0,1) and −1 on [1,2), period 2: a triangle wave.
double square_wave_integral(double x) {
  const double phase = x - 2 * std::floor(x / 2);
  return phase < 1 ? phase : 2 - phase;
}

/// Mean of the square wave s over [x − w/2, x + w/2].
double mean_square_wave(double x, double w) {
  return (square_wave_integral(x + w / 2) - square_wave_integral(x - w / 2)) / w;
}

/// Fraction of [x − w/2, x + w/2] that lies in [a, b].
double coverage(double x, double w, double a, double b) {
  return std::clamp((std::min(b, x + w / 2) - std::max(a, x - w / 2)) / w, 0.0, 1.0);
}

// `brick`: lengths as fractions of the box edge.
constexpr double kBrickLow[3] = {0.12, 0.26, 0.12};
constexpr double kBrickHigh[3] = {0.88, 0.74, 0.88};
constexpr double kBrickPitch[3] = {0.19, 0.12, 0.095}; // 4 × 4 × 8 bricks fill the block
constexpr double kMortar = 0.02;
constexpr double kMortarValue = 0.35;

/// A fixed value in [0.6, 1] for every brick.
double brick_value(std::int64_t a, std::int64_t b, std::int64_t c) {
  std::uint64_t h = static_cast<std::uint64_t>(a * 73856093 ^ b * 19349663 ^ c * 83492791);
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  return 0.6 + 0.4 * static_cast<double>(h >> 40) / static_cast<double>(std::uint64_t{1} << 24);
}

/// The brick along one axis that holds position x, and how much of the voxel is brick, not mortar.
struct BrickCell {
  std::int64_t index = 0;
  double solid = 0;
};

BrickCell brick_cell(double x, double w, double low, double pitch, double shift) {
  const double u = (x - low) / pitch + shift;
  const double index = std::floor(u);
  const double start = low + (index - shift) * pitch;
  return {static_cast<std::int64_t>(index), coverage(x, w, start + kMortar / 2, start + pitch - kMortar / 2)};
}

double brick_at(const glm::dvec3& t, const glm::dvec3& w) {
  double block = 1;
  for (int a = 0; a < 3; ++a)
    block *= coverage(t[a], w[a], kBrickLow[a], kBrickHigh[a]);
  if (block == 0)
    return 0;
  // Running bond: every second course and every second wythe is shifted by half a brick.
  const BrickCell course = brick_cell(t.z, w.z, kBrickLow[2], kBrickPitch[2], 0);
  const BrickCell wythe = brick_cell(t.y, w.y, kBrickLow[1], kBrickPitch[1], 0);
  const double shift = ((course.index + wythe.index) % 2 + 2) % 2 == 1 ? 0.5 : 0.0;
  const BrickCell brick = brick_cell(t.x, w.x, kBrickLow[0], kBrickPitch[0], shift);
  const double solid = course.solid * wythe.solid * brick.solid;
  const double value = brick_value(brick.index, wythe.index, course.index);
  return block * (kMortarValue + (value - kMortarValue) * solid);
}

} // namespace

PhantomRows checkerboard_rows() {
  return [](const PhantomGrid& grid, std::size_t j, std::size_t k, std::span<double> row) {
    const auto wave = [&](std::size_t axis, std::size_t index) {
      return mean_square_wave(8 * grid.texture(axis, index), 8 / static_cast<double>(grid.dims[axis]));
    };
    const double yz = wave(1, j) * wave(2, k);
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = (1 - wave(0, i) * yz) / 2;
  };
}

PhantomRows brick_rows() {
  return [](const PhantomGrid& grid, std::size_t j, std::size_t k, std::span<double> row) {
    const glm::dvec3 width(1.0 / static_cast<double>(grid.dims[0]), 1.0 / static_cast<double>(grid.dims[1]),
                           1.0 / static_cast<double>(grid.dims[2]));
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = brick_at({grid.texture(0, i), grid.texture(1, j), grid.texture(2, k)}, width);
  };
}

} // namespace slicelens
