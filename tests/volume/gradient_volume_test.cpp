// The Gaussian copy and the central differences of a volume, against sums written out here.
#include "catch.h"
#include "core/errors.h"
#include "volume/gradient_volume.h"

#include <cmath>
#include <cstring>
#include <limits>

using namespace slicelens;

namespace {

template <class Function>
Volume floats(const std::array<std::size_t, 3>& dims, const Function& f) {
  Volume volume;
  volume.dims = dims;
  volume.type = ScalarType::f32;
  volume.spacing = {1, 2, 3};
  volume.origin = {5, 6, 7};
  for (std::size_t k = 0; k < dims[2]; ++k) {
    for (std::size_t j = 0; j < dims[1]; ++j) {
      for (std::size_t i = 0; i < dims[0]; ++i) {
        const auto value =
            static_cast<float>(f(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)));
        const auto bytes = std::as_bytes(std::span(&value, 1));
        volume.voxels.insert(volume.voxels.end(), bytes.begin(), bytes.end());
      }
    }
  }
  update_statistics(volume);
  return volume;
}

} // namespace

TEST_CASE("a copy has one voxel for so many, rounded up") {
  CHECK(reduced_dims({5, 4, 1}, 1) == std::array<std::size_t, 3>{5, 4, 1});
  CHECK(reduced_dims({5, 4, 1}, 2) == std::array<std::size_t, 3>{3, 2, 1});
  CHECK(reduced_dims({9, 8, 1}, 4) == std::array<std::size_t, 3>{3, 2, 1});
}

TEST_CASE("one voxel becomes a Gaussian of four standard deviations") {
  const Volume copy =
      gaussian_copy(floats({21, 1, 1}, [](int i, int, int) { return i == 10 ? 1 : 0; }), 1, 1);
  double sum = 0;
  for (int d = -4; d <= 4; ++d)
    sum += std::exp(-0.5 * d * d);
  for (int i = 0; i < 21; ++i) {
    const int d = i - 10;
    const double expected = std::abs(d) <= 4 ? std::exp(-0.5 * d * d) / sum : 0;
    CHECK(value_at(copy, static_cast<std::size_t>(i), 0, 0) == Approx(expected).margin(1e-7));
  }
}

TEST_CASE("coarser copies keep the box, and lines where no tap is beyond the edge") {
  const Volume volume = floats({20, 7, 1}, [](int i, int, int) { return 3 * i + 100; });
  const Volume copy = gaussian_copy(volume, 4, 0.5); // s = 2 voxels, eight to either side
  REQUIRE(copy.dims == std::array<std::size_t, 3>{5, 2, 1});
  CHECK(value_at(copy, 2, 0, 0) == Approx(3 * 9.5)); // centre at 10 voxels; less the smallest value, 100
  const glm::dmat4 a = box_of(volume).world_from_texture;
  const glm::dmat4 b = box_of(copy).world_from_texture;
  for (int c = 0; c < 4; ++c)
    CHECK(glm::length(a[c] - b[c]) < 1e-12);
}

TEST_CASE("three passes are the sum over the neighbourhood, the edge's voxels beyond the edge") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto f = [&](int i, int j, int k) {
    return i == 1 && j == 1 && k == 1 ? nan : static_cast<float>((7 * i + 13 * j + 5 * k * k) % 11 - 4);
  };
  const Volume volume = floats({6, 5, 4}, f);
  const Volume copy = gaussian_copy(volume, 2, 0.6);
  REQUIRE(copy.dims == std::array<std::size_t, 3>{3, 3, 2});
  const auto voxel = [&](int i, int j, int k) {
    const float value = f(std::clamp(i, 0, 5), std::clamp(j, 0, 4), std::clamp(k, 0, 3));
    return std::isnan(value) ? 0.0 : static_cast<double>(value) - volume.min;
  };
  const glm::dvec3 step(2, 5.0 / 3, 2);
  for (int z = 0; z < 2; ++z) {
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) {
        double sum = 0;
        double weights = 0;
        const glm::dvec3 c = (glm::dvec3(x, y, z) + 0.5) * step;
        for (int k = -9; k < 14; ++k) {
          for (int j = -9; j < 14; ++j) {
            for (int i = -9; i < 15; ++i) {
              const glm::dvec3 d = (glm::dvec3(i, j, k) + 0.5 - c) / (0.6 * step);
              if (glm::any(glm::greaterThan(glm::abs(d), glm::dvec3(4))))
                continue;
              const double weight = std::exp(-0.5 * glm::dot(d, d));
              sum += weight * voxel(i, j, k);
              weights += weight;
            }
          }
        }
        // Floats of up to 10: three passes of 1e-7.
        CHECK(value_at(copy, static_cast<std::size_t>(x), static_cast<std::size_t>(y),
                       static_cast<std::size_t>(z)) == Approx(sum / weights).margin(1e-5));
      }
    }
  }
}

TEST_CASE("central differences as shares of the range, one-sided at the edges") {
  const auto f = [](int i, int j, int k) { return i * i + 2 * j - k; };
  const Volume volume = floats({4, 3, 3}, f); // from −2 to 13
  std::vector<float> out(3 * 12 * 2);
  central_differences(volume, 1, 3, out);
  const auto at = [&](int i, int j, int k) {
    const float* v = out.data() + 3 * (((k - 1) * 3 + j) * 4 + i);
    return 15.0 * glm::dvec3(v[0], v[1], v[2]);
  };
  CHECK(glm::length(at(1, 1, 1) - glm::dvec3(4, 4, -2)) < 1e-5);
  CHECK(glm::length(at(0, 0, 2) - glm::dvec3(1, 2, -1)) < 1e-5);
  CHECK(glm::length(at(3, 2, 2) - glm::dvec3(5, 2, -1)) < 1e-5);
  std::vector<float> flat(3 * 8, 1.0F);
  central_differences(floats({2, 2, 2}, [](int, int, int) { return 7; }), 0, 2, flat);
  CHECK(std::all_of(flat.begin(), flat.end(), [](float v) { return v == 0; }));
}

TEST_CASE("several components have no smooth copy") {
  Volume volume = floats({2, 2, 2}, [](int, int, int) { return 0; });
  volume.components = 2;
  CHECK_THROWS_AS(gaussian_copy(volume, 1, 1), UsageError);
}
