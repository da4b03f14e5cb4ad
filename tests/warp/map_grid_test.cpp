// Maps on grids: where they are exact, how fast they become so, what happens at faces and outside.
#include "catch.h"
#include "core/errors.h"
#include "warp/warp_grid.h"
#include "warp_cases.h"

using namespace slicelens;
using lens_cases::random_in;

namespace {

glm::dvec3 random_vector(double reach) {
  return {random_in(-reach, reach), random_in(-reach, reach), random_in(-reach, reach)};
}

GridMap held(MapGrid grid) { return {std::make_shared<const MapGrid>(std::move(grid))}; }

/// A bend of three sines, C∞, with slopes below .25.
glm::dvec3 waves(const glm::dvec3& p) {
  return p + 0.03 * glm::dvec3(std::sin(6 * p.y), std::sin(5 * p.z + 1), std::sin(7 * p.x + 2));
}

/// Largest |u_grid − u_exact| at 20³ points of the unit box, off the nodes.
double largest_error(const GridMap& map, const PointMap& exact) {
  double largest = 0;
  for (int i = 0; i < 8000; ++i) {
    const glm::dvec3 p = (glm::dvec3(i % 20, i / 20 % 20, i / 400) + 0.37) / 20.0;
    largest = std::max(largest, glm::length(texture_from_object(map, p) - exact(p)));
  }
  return largest;
}

} // namespace

TEST_CASE("a grid of a linear map is the map, between and at its nodes") {
  CHECK(rc::check([] {
    const glm::dmat3 a(random_vector(1), random_vector(1), random_vector(1));
    const glm::dvec3 b = random_vector(1);
    const glm::dvec3 low = random_vector(1);
    const glm::dvec3 high = low + glm::dvec3(random_in(0.2, 2), random_in(0.2, 2), random_in(0.2, 2));
    const std::array<std::size_t, 3> size = {static_cast<std::size_t>(*rc::gen::inRange(2, 9)),
                                             static_cast<std::size_t>(*rc::gen::inRange(2, 9)),
                                             static_cast<std::size_t>(*rc::gen::inRange(2, 9))};
    const GridMap map = held(make_map_grid([&](const glm::dvec3& p) { return a * p + b; }, size, low, high));
    for (int i = 0; i < 10; ++i) {
      const glm::dvec3 t(random_in(0, 1), random_in(0, 1), random_in(0, 1));
      const glm::dvec3 p = low + t * (high - low);
      // Floats of displacements of at most 8.
      RC_ASSERT(glm::length(texture_from_object(map, p) - (a * p + b)) < 1e-6);
      const glm::dmat3 j = jacobian(map, p);
      for (int c = 0; c < 3; ++c)
        RC_ASSERT(glm::length(j[c] - a[c]) < 1e-4); // the same over cells of 1/40 and more
    }
  }));
}

TEST_CASE("points worked by hand in shaders/warp/grid.glsl") {
  const GridMap map = held(make_map_grid([](const glm::dvec3& p) { return p + glm::dvec3(0.1 * p.x, 0, 0); },
                                         {2, 2, 2}, {0, 0, 0}, {1, 1, 1}));
  const auto near = [](const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b) < 1e-8; };
  CHECK(near(texture_from_object(map, {0.5, 0.2, 0.7}), {0.55, 0.2, 0.7}));
  CHECK(std::abs(jacobian(map, {0.5, 0.2, 0.7})[0].x - 1.1) < 1e-8);
  CHECK(near(texture_from_object(map, {2, 0.5, 0.5}), {2.1, 0.5, 0.5}));
  CHECK(jacobian(map, {2, 0.5, 0.5}) == glm::dmat3(1));
  CHECK(texture_from_object(map, {-1, 0.5, 0.5}) == glm::dvec3(-1, 0.5, 0.5));
  CHECK(near(texture_from_object(map, {1, 0, 0}), {1.1, 0, 0}));
  CHECK(near(texture_from_object(map, {0.25, 0, 0}), {0.275, 0, 0}));
}

TEST_CASE("the error of a grid of a smooth map falls with the square of its cells") {
  double before = 0;
  for (const std::size_t cells : {8, 16, 32, 64}) {
    const std::size_t n = cells + 1;
    const double error = largest_error(held(make_map_grid(waves, {n, n, n}, {0, 0, 0}, {1, 1, 1})), waves);
    // Trilinear: at most h²/8 of each second derivative, 0.03·(36 + 25 + 49) in all.
    CHECK(error <= 0.03 * 110 / 8 / static_cast<double>(cells * cells));
    if (before > 0) {
      INFO(cells << " cells: " << error << " after " << before);
      CHECK(before / error > 3.4);
      CHECK(before / error < 4.6);
    }
    before = error;
  }
}

TEST_CASE("a grid's forward map undoes it, in it and outside") {
  const GridMap map = held(make_map_grid(waves, {12, 9, 17}, {-0.1, 0, 0.1}, {1, 1.2, 0.9}));
  CHECK(rc::check([&] {
    const glm::dvec3 p = glm::dvec3(0.5) + random_vector(0.8);
    RC_ASSERT(glm::length(object_from_texture(map, texture_from_object(map, p)) - p) < 1e-10);
  }));
  CHECK(smallest_determinant(*map.grid) > 0.5);
  const GridMap folded =
      held(make_map_grid([](const glm::dvec3& p) { return glm::dvec3(std::abs(p.x - 0.5), p.y, p.z); },
                         {9, 9, 9}, {0, 0, 0}, {1, 1, 1}));
  CHECK(smallest_determinant(*folded.grid) < -0.9);
}

TEST_CASE("the error of a grid in voxels is that of its map") {
  // The list [fisheye] against its own grid: the exact map by the formula, at points of the test's own.
  const BoxSpace space{{1, 0.5, 0.75}, 1};
  const std::vector<WarpMap> maps = {map_of(Warp(Fisheye{glm::dvec3(0.5), glm::dvec3(2)}), space, {})};
  const glm::dvec3 voxels(100, 50, 75);
  double before = 0;
  for (const std::size_t n : {17, 33, 65}) {
    const MapGrid grid = make_map_grid(maps, {n, n, n}, glm::dvec3(0), space.size);
    const MapGridError error = map_grid_error(grid, maps, space, voxels);
    CHECK(error.rms < error.largest);
    const GridMap map = held(grid);
    double largest = 0;
    for (int i = 0; i < 200; ++i) {
      const glm::dvec3 p((i + 0.5) / 200, 0.2, 0.3);
      largest = std::max(largest,
                         glm::length((texture_from_object(map, p) - texture_from_object(maps, p)) * 100.0));
    }
    CHECK(error.largest >= 0.9 * largest);
    if (before > 0)
      CHECK(before / error.rms > 3.2); // 4 but for the crease at the focal point
    before = error.rms;
  }
  CHECK(map_grid_error(make_map_grid(std::vector<WarpMap>{}, {2, 2, 2}, glm::dvec3(0), space.size), {}, space,
                       voxels)
            .largest < 1e-12);
}

TEST_CASE("bounds of what a map shows") {
  glm::dvec3 low(-2);
  glm::dvec3 high(3);
  // u = 2(p − ½): the unit box is shown within [½, 1] on every axis.
  tighten_bounds([](const glm::dvec3& p) { return 2.0 * (p - 0.5); }, glm::dvec3(1), low, high);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(low[axis] <= 0.5);
    CHECK(low[axis] >= 0.5 - 5.0 / 16 * 2);
    CHECK(high[axis] >= 1);
    CHECK(high[axis] <= 1 + 5.0 / 16 * 2);
  }
}

TEST_CASE("grids refuse sizes, boxes and maps that make none") {
  const PointMap same = [](const glm::dvec3& p) { return p; };
  CHECK_THROWS_WITH(make_map_grid(same, {1, 8, 8}, glm::dvec3(0), glm::dvec3(1)),
                    Catch::Contains("2 to 128"));
  CHECK_THROWS_WITH(make_map_grid(same, {8, 8, 129}, glm::dvec3(0), glm::dvec3(1)), Catch::Contains("129"));
  CHECK_THROWS_AS(make_map_grid(same, {8, 8, 8}, glm::dvec3(0), glm::dvec3(1, 0, 1)), UsageError);
  CHECK_THROWS_WITH(
      make_map_grid([](const glm::dvec3& p) { return p / 0.0; }, {8, 8, 8}, glm::dvec3(0), glm::dvec3(1)),
      Catch::Contains("finite"));
}
