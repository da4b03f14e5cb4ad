#include "catch.h"
#include "core/errors.h"
#include "study/continuity.h"
#include "volume/phantom.h"

#include <cmath>
#include <limits>

using namespace slicelens;
using glm::dmat3;
using glm::dvec3;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// float64 volume of f(i,j,k).
template <class F>
Volume volume_of(std::size_t nx, std::size_t ny, std::size_t nz, F f) {
  Volume volume;
  volume.dims = {nx, ny, nz};
  volume.type = ScalarType::f64;
  volume.voxels.resize(nx * ny * nz * sizeof(double));
  auto* scalars = reinterpret_cast<double*>(volume.voxels.data());
  for (std::size_t v = 0; v < nx * ny * nz; ++v)
    scalars[v] = f(v % nx, v / nx % ny, v / nx / ny);
  update_statistics(volume);
  return volume;
}

/// A torn map: a constant shift along y beyond x = 0.513.
dvec3 torn(const dvec3& p) { return p + dvec3(0, p.x > 0.513 ? 0.07 : 0, 0); }

} // namespace

TEST_CASE("trilinear samples are exact for trilinear functions and clamped to the outer centres") {
  const auto f = [](double x, double y, double z) { return 1 + 2 * x - 3 * y + z + x * y * z; };
  const Volume volume = volume_of(4, 5, 3, [&](std::size_t i, std::size_t j, std::size_t k) {
    return f(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
  });
  const auto at = [&](double x, double y, double z) {
    return trilinear(volume, (dvec3(x, y, z) + 0.5) / dvec3(4, 5, 3));
  };
  CHECK(at(1, 2, 1) == Approx(f(1, 2, 1)));
  CHECK(at(0.25, 3.5, 1.75) == Approx(f(0.25, 3.5, 1.75)));
  CHECK(at(-0.5, 4.5, 2.5) == Approx(f(0, 4, 2)));
  CHECK(at(3, 4, 2) == Approx(f(3, 4, 2)));
  const Volume one = volume_of(1, 1, 1, [](auto...) { return 7.0; });
  CHECK(trilinear(one, dvec3(0.9, 0.1, 1)) == 7);
}

TEST_CASE("trilinear samples take component 0 of any scalar type") {
  Volume volume;
  volume.dims = {2, 1, 1};
  volume.type = ScalarType::u8;
  volume.components = 3;
  for (const int v : {10, 99, 99, 20, 99, 99})
    volume.voxels.push_back(static_cast<std::byte>(v));
  CHECK(trilinear(volume, dvec3(0.25, 0.5, 0.5)) == 10);
  CHECK(trilinear(volume, dvec3(0.5, 0.5, 0.5)) == Approx(15));
}

TEST_CASE("the undeformed mask on the volume's own grid is the threshold of its voxels") {
  const Volume volume = volume_of(
      5, 4, 3, [](std::size_t i, std::size_t j, std::size_t k) { return double(i + 10 * j + 100 * k); });
  // 112 itself belongs to the object; a trilinear sum at a voxel's centre may round by an ulp, hence the 1e-9
  const VoxelMask mask = displayed_mask(volume, undeformed(), 112 - 1e-9, volume.dims);
  REQUIRE(mask.voxels.size() == 60);
  for (std::size_t v = 0; v < 60; ++v)
    CHECK(int(mask.voxels[v]) == (scalar_at(volume, v) >= 112 ? 1 : 0));
}

TEST_CASE("a mask shows what lies at u(p), and nothing where u leaves the volume") {
  const Volume slab = volume_of(10, 1, 1, [](std::size_t i, auto...) { return i == 7 ? 1.0 : 0.0; });
  const auto shift = [](double by) { return [by](const dvec3& p) { return p + dvec3(by, 0, 0); }; };
  const VoxelMask moved = displayed_mask(slab, shift(0.3), 0.6, {10, 1, 1});
  // u(p) = p + 3 voxels: voxel 7 is seen at 4
  CHECK(moved.voxels == std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 0});
  const Volume full = volume_of(10, 1, 1, [](auto...) { return 1.0; });
  CHECK(displayed_mask(full, shift(0.3), 0.6, {10, 1, 1}).voxels ==
        std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 1, 0, 0, 0});
  CHECK(displayed_mask(full, shift(kNan), 0.6, {4, 1, 1}).voxels == std::vector<std::uint8_t>(4, 0));
  const Volume nan = volume_of(2, 2, 2, [](auto...) { return kNan; });
  CHECK(displayed_mask(nan, undeformed(), 0, {2, 2, 2}).voxels == std::vector<std::uint8_t>(8, 0));
}

TEST_CASE("a ball is one component at any resolution, a torn one two") {
  const Volume ball = make_phantom("ball", {32, 32, 32});
  for (const std::size_t n : {32, 48}) {
    const Components whole = connected_components(displayed_mask(ball, undeformed(), 0, {n, n, n}));
    REQUIRE(whole.sizes.size() == 1);
    // (4/3)π·0.4³ of the box; the surface is off by less than 0.02 of a radius at 32 voxels
    const double expected = 4.18879 * 0.064 * std::pow(static_cast<double>(n), 3);
    CHECK(static_cast<double>(whole.sizes[0]) == Approx(expected).epsilon(0.03));
  }
  // the ball twice, half as large: u = fract(2p) in x jumps back at 1/2
  const TextureMap twice = [](const dvec3& p) { return dvec3(p.x < 0.5 ? 2 * p.x : 2 * p.x - 1, p.y, p.z); };
  CHECK(connected_components(displayed_mask(ball, twice, 0, {48, 48, 48})).sizes.size() == 2);
}

TEST_CASE("the largest jump falls with the step for a continuous map") {
  // ∂u/∂x = 3x², at most 3 at x = 1: |Δu| ≤ 3·step and nearly that
  const TextureMap cubic = [](const dvec3& p) { return dvec3(p.x * p.x * p.x, p.y, p.z); };
  for (const double step : {1e-3, 1e-4, 1e-5}) {
    const Jump jump = largest_jump(cubic, {}, 9, step);
    CHECK(jump.step <= step);
    CHECK(jump.step > step / 2);
    CHECK(jump.axis == 0);
    CHECK(jump.at.x == Approx(1 - jump.step));
    CHECK(jump.size == Approx(3 * jump.step).epsilon(4 * step));
  }
}

TEST_CASE("a tear is found wherever it lies and keeps its size") {
  for (const double step : {1e-3, 1e-4, 1e-5}) {
    const Jump jump = largest_jump(torn, {}, 9, step);
    // the shift, and the step across it at a right angle
    CHECK(jump.size == Approx(std::hypot(0.07, jump.step)).epsilon(1e-9));
    CHECK(jump.axis == 0);
    CHECK(jump.at.x <= 0.513);
    CHECK(jump.at.x + jump.step > 0.513);
  }
  // not in the other half
  CHECK(largest_jump(torn, {dvec3(0), dvec3(0.5, 1, 1)}, 9, 1e-4).size == Approx(1e-4).epsilon(0.5));
  // an oblique tear is crossed by some axis
  const TextureMap oblique = [](const dvec3& p) { return p + dvec3(0, 0, p.y + p.z > 0.9 ? 0.2 : 0); };
  CHECK(largest_jump(oblique, {}, 6, 1e-5).size == Approx(0.2).margin(2e-5));
}

TEST_CASE("the smallest determinant of a scaling, a fold and one place in the volume") {
  const JacobianMap scaling = [](const dvec3&) {
    return dmat3(dvec3(0.5, 0, 0), dvec3(0, 0.25, 0), dvec3(0, 0, 2));
  };
  CHECK(smallest_determinant(scaling, {}, 5, 100).value == Approx(0.25));
  // u_x = x − x²·0.75: slope 1 − 1.5x, down to −0.5 at the far face
  const JacobianMap fold = [](const dvec3& p) {
    return dmat3(dvec3(1 - 1.5 * p.x, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1));
  };
  const Determinant folded = smallest_determinant(fold, {}, 5, 0);
  CHECK(folded.value == Approx(-0.5));
  CHECK(folded.at.x == 1);
  // found by random points alone: between the grid's
  const JacobianMap spot = [](const dvec3& p) {
    return dmat3(p.x > 0.05 && p.x < 0.45 && p.y < 0.45 && p.y > 0.05 ? -1.0 : 1.0);
  };
  CHECK(smallest_determinant(spot, {}, 3, 0).value == 1);
  CHECK(smallest_determinant(spot, {}, 3, 200).value == -1);
  const JacobianMap broken = [](const dvec3& p) { return dmat3(p.y == 0.5 ? kNan : 1.0); };
  CHECK(std::isnan(smallest_determinant(broken, {}, 3, 50).value));
}

TEST_CASE("what crosses a face continues, unless the map is torn there") {
  // A rod along x, a square of 0.2 by 0.2 about the axis, through a box's two x faces.
  const Volume rod = volume_of(4, 200, 200, [](auto, std::size_t j, std::size_t k) {
    return j >= 80 && j < 120 && k >= 80 && k < 120 ? 1.0 : 0.0;
  });
  const Region box{dvec3(0.3), dvec3(0.7)};
  const Crossing whole = face_crossing(rod, undeformed(), 0.5, box, 100, 1e-6);
  // half the face's edge on each axis: a quarter of 100² points, twice
  CHECK(whole.inside == 5000);
  CHECK(whole.outside == 5000);
  CHECK(whole.continued() == 1);
  // Inside the box the rod is moved by 12 of the 50 columns of points it covers.
  const TextureMap shifted = [](const dvec3& p) {
    return glm::all(glm::lessThan(glm::abs(p - 0.5), dvec3(0.2))) ? p + dvec3(0, 0.048, 0) : p;
  };
  const Crossing torn_rod = face_crossing(rod, shifted, 0.5, box, 100, 1e-6);
  CHECK(torn_rod.inside == 5000);
  CHECK(torn_rod.outside == 5000);
  CHECK(torn_rod.continued() == Approx(38.0 / 62));
  CHECK(face_crossing(rod, undeformed(), 2, box, 10, 1e-6).continued() == 1);
  CHECK(face_crossing(rod, undeformed(), 0.5, {dvec3(-1), dvec3(2)}, 10, 1e-6).inside == 0);
}

TEST_CASE("continuity refuses what it cannot measure") {
  const Volume one = volume_of(1, 1, 1, [](auto...) { return 1.0; });
  CHECK_THROWS_AS(displayed_mask(one, undeformed(), kNan, {2, 2, 2}), UsageError);
  CHECK_THROWS_AS(displayed_mask(one, undeformed(), 0, {2, 0, 2}), UsageError);
  const std::size_t huge = std::numeric_limits<std::size_t>::max() / 2;
  CHECK_THROWS_AS(displayed_mask(one, undeformed(), 0, {huge, huge, 2}), LimitError);
  CHECK_THROWS_AS(displayed_mask(one, undeformed(), 0, {huge, 1, 1}), LimitError);
  CHECK_THROWS_AS(largest_jump(undeformed(), {}, 1, 1e-3), UsageError);
  CHECK_THROWS_AS(largest_jump(undeformed(), {}, 3, 0), UsageError);
  CHECK_THROWS_AS(largest_jump(undeformed(), {}, 3, kNan), UsageError);
  CHECK_THROWS_AS(largest_jump(undeformed(), {dvec3(1), dvec3(0)}, 3, 1e-3), UsageError);
  const JacobianMap unit = [](const dvec3&) { return dmat3(1); };
  CHECK_THROWS_AS(smallest_determinant(unit, {dvec3(kNan), dvec3(1)}, 3, 1), UsageError);
}
