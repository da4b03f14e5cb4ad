#include "catch.h"
#include "slicing/polygon.h"

#include <rapidcheck.h>

#include <algorithm>
#include <array>

using namespace slicelens;

namespace {

bool on_a_cube_edge(const glm::dvec3& p) {
  int at_faces = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < -1e-12 || p[axis] > 1 + 1e-12)
      return false;
    if (std::abs(p[axis]) < 1e-9 || std::abs(p[axis] - 1) < 1e-9)
      ++at_faces;
  }
  return at_faces >= 2;
}

/// All turns go the same way, seen along the plane's normal.
bool is_convex(const Polygon& polygon, const glm::dvec3& normal) {
  double smallest = 0;
  double largest = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const glm::dvec3& c = polygon[(i + 2) % polygon.size()];
    const double turn = glm::dot(glm::cross(b - a, c - b), normal);
    smallest = std::min(smallest, turn);
    largest = std::max(largest, turn);
  }
  return smallest >= -1e-12 || largest <= 1e-12;
}

double random_in(double low, double high) {
  return low + (high - low) * static_cast<double>(*rc::gen::inRange(0, 1'000'001)) / 1e6;
}

glm::dvec3 random_direction() {
  for (;;) {
    const glm::dvec3 v(random_in(-1, 1), random_in(-1, 1), random_in(-1, 1));
    const double length = glm::length(v);
    if (length > 0.01)
      return v / length;
  }
}

} // namespace

TEST_CASE("planes through the cube give the polygons a reader can draw") {
  SECTION("across an axis: the unit square") {
    const Polygon square = cut_unit_cube({{0, 0, 1}, 0.25});
    REQUIRE(square.size() == 4);
    CHECK(area(square) == Approx(1));
  }
  SECTION("near a corner: the triangle with corners at .3 on the three edges") {
    const Polygon triangle = cut_unit_cube({{1, 1, 1}, 0.3});
    REQUIRE(triangle.size() == 3);
    // side .3·√2, so the area is √3/4 · 2 · .09
    CHECK(area(triangle) == Approx(std::sqrt(3.0) / 4 * 2 * 0.09));
  }
  SECTION("through the middle of the space diagonal: the regular hexagon") {
    const Polygon hexagon = cut_unit_cube({{1, 1, 1}, 1.5});
    REQUIRE(hexagon.size() == 6);
    // side √½, area 3√3/2 · ½
    CHECK(area(hexagon) == Approx(3 * std::sqrt(3.0) / 4));
  }
  SECTION("five corners") {
    // x + y + 2z = 1.5 meets x=1, y=1 at z = 0: above it at the corner (1,1,0); counted by hand: edges
    // (1,.5,0), (.5,1,0), (0,1,.25), (0,0,.75), (1,0,.25).
    const Polygon pentagon = cut_unit_cube({{1, 1, 2}, 1.5});
    REQUIRE(pentagon.size() == 5);
    for (const glm::dvec3& expected : {glm::dvec3(1, .5, 0), glm::dvec3(.5, 1, 0), glm::dvec3(0, 1, .25),
                                       glm::dvec3(0, 0, .75), glm::dvec3(1, 0, .25)}) {
      CHECK(std::any_of(pentagon.begin(), pentagon.end(),
                        [&](const glm::dvec3& p) { return glm::length(p - expected) < 1e-12; }));
    }
  }
  SECTION("diagonal through two opposite edges: the 1 by √2 rectangle") {
    const Polygon rectangle = cut_unit_cube({{1, -1, 0}, 0});
    REQUIRE(rectangle.size() == 4);
    CHECK(area(rectangle) == Approx(std::sqrt(2.0)));
  }
}

TEST_CASE("degenerate planes: faces count once, edges and corners not at all") {
  CHECK(area(cut_unit_cube({{0, 0, 1}, 1})) == Approx(1)); // the cube on the negative side: the face
  CHECK(cut_unit_cube({{0, 0, -1}, -1}).empty());          // the same plane seen from the other side: nothing
  CHECK(cut_unit_cube({{0, 0, 1}, 0}).empty());
  CHECK(area(cut_unit_cube({{0, 0, -1}, 0})) == Approx(1));
  CHECK(cut_unit_cube({{1, 1, 0}, 0}).empty()); // touches an edge
  CHECK(cut_unit_cube({{1, 1, 0}, 2}).empty());
  CHECK(cut_unit_cube({{1, 1, 1}, 3}).empty()); // touches a corner
  CHECK(cut_unit_cube({{1, 1, 1}, 4}).empty()); // misses
  // Grazing: a plane a hair inside a face still gives the whole face.
  CHECK(area(cut_unit_cube({{1e-9, 0, 1}, 1e-10 + 1e-9})) == Approx(1).epsilon(1e-6));
}

TEST_CASE(
    "any plane: corners on cube edges and on the plane, convex, 3 to 6 of them, both halves fill the cube") {
  CHECK(rc::check([] {
    const glm::dvec3 normal = random_direction();
    const glm::dvec3 through(random_in(0, 1), random_in(0, 1), random_in(0, 1));
    const Plane plane{normal, glm::dot(normal, through)};
    const Polygon polygon = cut_unit_cube(plane);
    if (polygon.empty())
      return; // the random point may lie on the cube's surface
    RC_ASSERT(polygon.size() >= 3 && polygon.size() <= 6);
    for (const glm::dvec3& p : polygon) {
      RC_ASSERT(std::abs(signed_value(plane, p)) < 1e-12);
      RC_ASSERT(on_a_cube_edge(p));
    }
    RC_ASSERT(is_convex(polygon, normal));
    // Clipping by a second plane and by its opposite parts the polygon without loss.
    const glm::dvec3 other = random_direction();
    const Plane knife{other, glm::dot(other, through)};
    const Plane back{-other, -glm::dot(other, through)};
    RC_ASSERT(std::abs(area(clip(polygon, knife)) + area(clip(polygon, back)) - area(polygon)) < 1e-9);
  }));
}

TEST_CASE("clipping keeps the side the normal points to") {
  const Polygon square = cut_unit_cube({{0, 0, 1}, 0.5});
  const Polygon right = clip(square, {{1, 0, 0}, 0.75});
  REQUIRE(right.size() == 4);
  CHECK(area(right) == Approx(0.25));
  for (const glm::dvec3& p : right)
    CHECK(p.x >= 0.75 - 1e-12);
  CHECK(clip(square, {{1, 0, 0}, 2}).empty());
  CHECK(area(clip(square, {{1, 0, 0}, -1})) == Approx(1));
  CHECK(clip(square, {{1, 1, 0}, 1.5}).size() == 3);
}

TEST_CASE("pull_back moves a plane through an affine map") {
  glm::dmat4 m(1); // x ↦ 2x + 3 along every axis
  m[0][0] = m[1][1] = m[2][2] = 2;
  m[3] = glm::dvec4(3, 3, 3, 1);
  const Plane plane = pull_back({{1, 0, 0}, 5}, m); // 2x + 3 = 5
  CHECK(signed_value(plane, {1, 9, 9}) == Approx(0));
  CHECK(signed_value(plane, {2, 0, 0}) == Approx(2));
}
