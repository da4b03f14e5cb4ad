// The smallest and largest values around each cell, against all voxels one by one.
#include "catch.h"
#include "volume/cell_ranges.h"

#include <cstring>
#include <limits>
#include <random>

using namespace slicelens;

namespace {

template <class T>
Volume random_volume(ScalarType type, const std::array<std::size_t, 3>& dims, double low, double high) {
  Volume volume;
  volume.dims = dims;
  volume.type = type;
  volume.voxels.resize(voxel_bytes(volume));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(low, high);
  for (std::size_t i = 0; i < voxel_count(volume); ++i) {
    const T v = static_cast<T>(value(random));
    std::memcpy(volume.voxels.data() + i * sizeof(T), &v, sizeof(T));
  }
  update_statistics(volume);
  return volume;
}

/// Whether voxel `x` may be read for a point of cell `c`: its centre lies at most `reach` voxels beyond the
/// cell's own, 8c to 8c + 7.
bool near_cell(std::size_t x, std::size_t c, std::size_t reach) {
  const auto d = static_cast<long>(x) - 8 * static_cast<long>(c);
  return d >= -static_cast<long>(reach) && d <= 7 + static_cast<long>(reach);
}

void check_ranges(const Volume& volume, std::size_t reach) {
  const CellRanges cells = cell_ranges(volume, reach);
  std::size_t at = 0;
  for (std::size_t k = 0; k < cells.size[2]; ++k) {
    for (std::size_t j = 0; j < cells.size[1]; ++j) {
      for (std::size_t i = 0; i < cells.size[0]; ++i, ++at) {
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        for (std::size_t v = 0; v < voxel_count(volume); ++v) {
          const std::size_t x = v % volume.dims[0];
          const std::size_t y = v / volume.dims[0] % volume.dims[1];
          const std::size_t z = v / volume.dims[0] / volume.dims[1];
          if (near_cell(x, i, reach) && near_cell(y, j, reach) && near_cell(z, k, reach)) {
            low = std::min(low, scalar_at(volume, v));
            high = std::max(high, scalar_at(volume, v));
          }
        }
        // Rounded to floats, and outwards.
        CHECK(static_cast<double>(cells.smallest[at]) <= low);
        CHECK(static_cast<double>(cells.largest[at]) >= high);
        CHECK(static_cast<double>(cells.smallest[at]) == Approx(low).epsilon(1e-6));
        CHECK(static_cast<double>(cells.largest[at]) == Approx(high).epsilon(1e-6));
      }
    }
  }
}

} // namespace

TEST_CASE("cells have the range of their voxels and those beside them") {
  const Volume bytes = random_volume<std::uint8_t>(ScalarType::u8, {17, 8, 9}, 0, 255);
  CHECK(cell_ranges(bytes, 1).size == std::array<std::size_t, 3>{3, 1, 2});
  check_ranges(bytes, 1);
  check_ranges(bytes, 2);
  check_ranges(random_volume<std::int16_t>(ScalarType::i16, {9, 16, 23}, -2000, 3000), 1);
  check_ranges(random_volume<double>(ScalarType::f64, {10, 3, 8}, -1e-3, 1e5), 2);
  check_ranges(random_volume<float>(ScalarType::f32, {1, 1, 1}, 5, 6), 1);
}

TEST_CASE("large whole numbers are rounded outwards, so that no value is lost") {
  Volume volume = random_volume<std::uint32_t>(ScalarType::u32, {2, 1, 1}, 16777216, 16777216);
  const std::uint32_t odd = 16777217; // between two floats
  std::memcpy(volume.voxels.data(), &odd, sizeof(odd));
  std::memcpy(volume.voxels.data() + sizeof(odd), &odd, sizeof(odd));
  update_statistics(volume);
  const CellRanges cells = cell_ranges(volume, 1);
  CHECK(cells.smallest[0] == 16777216.0F);
  CHECK(cells.largest[0] == 16777218.0F);
}

TEST_CASE("what is no number counts as the smallest value") {
  Volume volume = random_volume<float>(ScalarType::f32, {16, 8, 8}, 3, 4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(volume.voxels.data(), &nan, sizeof(nan));
  update_statistics(volume);
  const CellRanges cells = cell_ranges(volume, 1);
  CHECK(static_cast<double>(cells.smallest[0]) == Approx(volume.min));
  CHECK(cells.largest[0] <= 4);
}
