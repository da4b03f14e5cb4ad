// What docs/papers/cohen_vessels.md proves of Cohen's displays, checked on the maps themselves.
#include "catch.h"
#include "core/errors.h"
#include "study/continuity.h"
#include "volume/phantom.h"
#include "warp/warp.h"

#include <cmath>

using namespace slicelens;
using glm::dmat3;
using glm::dvec3;

namespace {

TextureMap map_in(const BoxSpace& space, const Warp& warp) {
  const WarpMap map = map_of(warp, space, {});
  return [map, space](const dvec3& p) {
    return texture_from_box(space, texture_from_object(map, box_from_texture(space, p)));
  };
}

JacobianMap jacobian_in(const BoxSpace& space, const Warp& warp) {
  const WarpMap map = map_of(warp, space, {});
  return [map, space](const dvec3& p) { return jacobian(map, box_from_texture(space, p)); };
}

LensBox lens(double magnification, const dvec3& inner = dvec3(0.15), const dvec3& outer = dvec3(0.3)) {
  return {dvec3(0.5, 0.45, 0.55), inner, outer, magnification};
}

const BoxSpace kFlat{dvec3(1, 0.8, 0.5), 1};

} // namespace

TEST_CASE("the volume lens jumps by the largest offsets of two axes, the connected lens by none") {
  // The offset (1 − 1/m)(δ − oτ²) is largest where 1 = 2oτ/(o − i): τ = 1/4, δ = 0.1875, (1/2)·0.16875.
  const double offset = 0.5 * (0.1875 - 0.3 / 16);
  const Region box{dvec3(0.15), dvec3(0.9)};
  const Jump cut = largest_jump(map_in({}, VolumeLens{lens(2)}), box, 65, 1e-6);
  // The lines lie 0.75/64 apart, so the largest offset is missed by half of that: its curvature is 2o/(o −
  // i)² = 27 times (1 − 1/m), which makes 27·(0.0059)²/4 = 2.3e-4 for each axis.
  CHECK(cut.size <= std::sqrt(2.0) * offset + 2e-6);
  CHECK(cut.size == Approx(std::sqrt(2.0) * offset).margin(4e-4));
  for (const Warp& warp : std::vector<Warp>{ConnectedLens{lens(2)}, Bifocal{}, Fisheye{}}) {
    CAPTURE(kind_of(warp));
    // No slope of these maps is above 4 (the fisheye's at the faces), so a step of 1e-6 moves by 4e-6.
    CHECK(largest_jump(map_in({}, warp), {}, 33, 1e-6).size < 5e-6);
    CHECK(largest_jump(map_in({}, warp), box, 33, 1e-6).size < 5e-6);
  }
}

TEST_CASE("the connected lens' smallest determinant is m⁻³") {
  for (const double m : {1.0, 1.2, 2.0, 8.0, 100.0}) {
    for (const dvec3& inner : {dvec3(0.15), dvec3(0.01, 0.1, 0.29)}) {
      CAPTURE(m, inner.x);
      const Determinant smallest =
          smallest_determinant(jacobian_in(kFlat, ConnectedLens{lens(m, inner)}), {}, 41, 20000);
      CHECK(smallest.value >= std::pow(m, -3) * (1 - 1e-9));
      CHECK(smallest.value == Approx(std::pow(m, -3)).epsilon(1e-9));
    }
  }
}

TEST_CASE("all principal minors of the connected lens are positive, so it is one to one") {
  const JacobianMap jacobian = jacobian_in(kFlat, ConnectedLens{lens(6)});
  const auto minors = [&](const dvec3& p) {
    const dmat3 j = jacobian(p);
    double smallest = std::min({j[0][0], j[1][1], j[2][2]});
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      smallest = std::min(smallest, j[a][a] * j[b][b] - j[a][b] * j[b][a]);
    }
    return dmat3(dvec3(smallest, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1));
  };
  // Each is at least 1/m for each of its axes.
  CHECK(smallest_determinant(minors, {}, 41, 20000).value >= 1 / 36.0 * (1 - 1e-9));
}

TEST_CASE("the connected lens' Jacobian has no crease where its profile has one") {
  const JacobianMap jacobian = jacobian_in({}, ConnectedLens{lens(3)});
  double largest = 0;
  for (const double y : {0.2, 0.3, 0.45, 0.52, 0.7}) {
    for (const double edge : {0.2, 0.35, 0.65, 0.8}) {
      const dmat3 change = jacobian({edge + 1e-7, y, 0.6}) - jacobian({edge - 1e-7, y, 0.6});
      for (int a = 0; a < 3; ++a)
        largest = std::max(largest, glm::length(change[a]));
    }
  }
  // Second derivatives are at most a few times 1/(o − i)² = 44: 2e-7 of x moves slopes by some 1e-5.
  CHECK(largest < 1e-4);
}

TEST_CASE("minifying connected lenses fold below the limit of their ratio") {
  struct Row {
    double ratio;
    double limit;
  };
  for (const Row& row : {Row{0.25, 0.5240}, Row{0.5, 0.7320}, Row{0.75, 0.8865}}) {
    CAPTURE(row.ratio);
    const auto smallest = [&](double m) {
      const LensBox box{dvec3(0.5), dvec3(0.3 * row.ratio), dvec3(0.3), m};
      return smallest_determinant(jacobian_in({}, ConnectedLens{box}), {dvec3(0.5), dvec3(0.8)}, 81, 0).value;
    };
    CHECK(smallest(row.limit + 0.002) > 0);
    CHECK(smallest(row.limit - 0.002) < 0);
  }
  // A thin border: the profile allows 0.875, the corners 0.8865.
  const auto thin = [](double m) { return ConnectedLens{{dvec3(0.5), dvec3(0.225), dvec3(0.3), m}}; };
  CHECK_THROWS_AS(validate(thin(0.88)), UsageError);
  CHECK_THROWS_AS(validate(thin(0.886)), UsageError);
  CHECK_NOTHROW(validate(thin(0.89)));
  CHECK_NOTHROW(validate(VolumeLens{thin(0.88).box}));
}

TEST_CASE("a rod across a lens is cut by the volume lens and by no other display") {
  // Along x, off the lens' centre in y, three voxels of 48 thick.
  Volume rod;
  rod.dims = {48, 48, 48};
  rod.voxels.resize(48 * 48 * 48);
  for (std::size_t v = 0; v < rod.voxels.size(); ++v) {
    const std::size_t j = v / 48 % 48, k = v / 48 / 48;
    rod.voxels[v] = static_cast<std::byte>(j >= 29 && j < 32 && k >= 23 && k < 26 ? 200 : 0);
  }
  update_statistics(rod);
  const LensBox box{dvec3(0.5), dvec3(0.15), dvec3(0.3), 2.5};
  const auto pieces = [&](const Warp& warp) {
    return connected_components(displayed_mask(rod, map_in({}, warp), 100, {96, 96, 96})).sizes.size();
  };
  CHECK(pieces(VolumeLens{box}) == 3);
  CHECK(pieces(ConnectedLens{box}) == 1);
  CHECK(pieces(Bifocal{}) == 1);
  CHECK(pieces(Fisheye{dvec3(0.5), dvec3(2)}) == 1);
}
