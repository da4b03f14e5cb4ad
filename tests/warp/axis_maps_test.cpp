// The maps of one axis (shaders/lib/axis_maps.glsl): points worked by hand, and the laws of their formulas.
#include "catch.h"
#include "lens_cases.h"
#include "warp/shared_axis_maps.h"

#include <functional>

using namespace slicelens;
using lens_cases::random_in;

namespace {

using Functions = shared::AxisMapFunctions<double>;
using Axis = std::function<glm::dvec2(double)>;

struct Point {
  double x;
  double u;
  double slope;
};

void check_points(const Axis& map, const std::vector<Point>& points) {
  for (const Point& point : points) {
    INFO("x = " << point.x);
    // Ten operations on numbers of at most 4.
    CHECK(map(point.x).x == Approx(point.u).margin(1e-14));
    CHECK(map(point.x).y == Approx(point.slope).epsilon(1e-13));
  }
}

Axis bifocal(double low, double high, double shown_low, double shown_high) {
  return [=](double x) { return Functions().bifocal_axis(x, low, high, shown_low, shown_high); };
}
Axis fisheye(double focal_point, double distortion) {
  return [=](double x) { return Functions().fisheye_axis(x, focal_point, distortion); };
}
Axis lens(double center, double inner, double outer, double magnification) {
  return [=](double x) { return Functions().lens_axis(x, center, inner, outer, magnification); };
}
Axis weight(double center, double inner, double outer) {
  return [=](double x) { return Functions().lens_weight(x, center, inner, outer); };
}

/// Both slopes beside a border, from differences: left and right of it.
glm::dvec2 slopes_beside(const Axis& map, double x) {
  const double h = 1e-7;
  return {(map(x).x - map(x - h).x) / h, (map(x + h).x - map(x).x) / h};
}

void check_slopes_beside(const Axis& map, double x, double left, double right) {
  INFO("beside " << x);
  const glm::dvec2 slopes = slopes_beside(map, x);
  // Differences over 1e-7: second derivatives of at most 100 times 1e-7, rounding 1e-16/1e-7.
  CHECK(slopes.x == Approx(left).margin(2e-5));
  CHECK(slopes.y == Approx(right).margin(2e-5));
}

struct RandomAxis {
  const char* name;
  std::function<Axis()> make;
};

/// Any parameters that the scene accepts, away from slopes beyond 1000.
const std::vector<RandomAxis>& random_axes() {
  static const std::vector<RandomAxis> list = {
      {"bifocal",
       [] {
         const double low = random_in(0.02, 0.9);
         const double shown_low = random_in(0.02, 0.9);
         return bifocal(low, random_in(low + 0.01, 0.98), shown_low, random_in(shown_low + 0.01, 0.98));
       }},
      {"fisheye", [] { return fisheye(random_in(0.02, 0.98), random_in(0, 20)); }},
      {"lens",
       [] {
         const double center = random_in(0.1, 0.9);
         const double outer = random_in(0.3, 1) * std::min(center, 1 - center);
         const double inner = outer * random_in(0.05, 0.8);
         // From the smallest magnification that does not fold.
         return lens(center, inner, outer, random_in((outer + inner) / (2 * outer), 10));
       }},
  };
  return list;
}

} // namespace

TEST_CASE("bifocal axis: points worked by hand") {
  // Data [0.4, 0.6] shown in [0.2, 0.8]: slopes 2, 1/3, 2.
  check_points(bifocal(0.4, 0.6, 0.2, 0.8), {{0, 0, 2},
                                             {0.05, 0.1, 2},
                                             {0.1, 0.2, 2},
                                             {0.5, 0.5, 1.0 / 3},
                                             {0.35, 0.45, 1.0 / 3},
                                             {0.9, 0.8, 2},
                                             {1, 1, 2}});
  // Data [0.1, 0.3] shown in [0.2, 0.7]: slopes 1/2, 2/5, 7/3.
  check_points(bifocal(0.1, 0.3, 0.2, 0.7), {{0, 0, 0.5},
                                             {0.1, 0.05, 0.5},
                                             {0.2, 0.1, 0.4},
                                             {0.45, 0.2, 0.4},
                                             {0.7, 0.3, 0.4},
                                             {0.85, 0.65, 7.0 / 3},
                                             {1, 1, 7.0 / 3}});
}

TEST_CASE("fisheye axis: points worked by hand") {
  // d = 3: the fraction g becomes g/(4 − 3g), with slope 4/(4 − 3g)².
  check_points(fisheye(0.5, 3),
               {{0, 0, 4}, {0.25, 0.4, 0.64}, {0.5, 0.5, 0.25}, {0.75, 0.6, 0.64}, {1, 1, 4}});
  // About 1/4: g = 1/2 at 1/8 and at 5/8.
  check_points(fisheye(0.25, 3),
               {{0, 0, 4}, {0.125, 0.2, 0.64}, {0.25, 0.25, 0.25}, {0.625, 0.4, 0.64}, {1, 1, 4}});
  // d = 1: g = 1/2 becomes 1/3.
  check_points(fisheye(0.5, 1), {{0.75, 0.5 + 0.5 / 3, 2 / 2.25}});
}

TEST_CASE("lens axis: points worked by hand") {
  check_points(lens(0.5, 0.1, 0.3, 2), {{0.5, 0.5, 0.5},
                                        {0.55, 0.525, 0.5},
                                        {0.6, 0.55, 0.5},
                                        {0.7, 0.6375, 1.25},
                                        {0.3, 0.3625, 1.25},
                                        {0.1, 0.1, 1},
                                        {0.9, 0.9, 1}});
  // c = .4, i = .1, o = .2, m = 4: bend .2·(3/4)/.01 = 15; at δ = .15: .025 + .0125 + 15·.0025.
  check_points(lens(0.4, 0.1, 0.2, 4), {{0.45, 0.4125, 0.25},
                                        {0.5, 0.425, 0.25},
                                        {0.55, 0.475, 1.75},
                                        {0.25, 0.325, 1.75},
                                        {0.61, 0.61, 1},
                                        {0.19, 0.19, 1}});
  // Minification by 2/3, the least that does not fold: (i + o)/(2o). Slope 3/2 within, 0 at the outer edge.
  check_points(lens(0.5, 0.1, 0.3, 2.0 / 3), {{0.6, 0.65, 1.5}, {0.7, 0.7625, 0.75}});
  check_slopes_beside(lens(0.5, 0.1, 0.3, 2.0 / 3), 0.8, 0, 1);
}

TEST_CASE("weight of the connected lens: points worked by hand") {
  // o − i = .2; 1 − s²(3 − 2s), slope −6s(1 − s)/.2.
  check_points(weight(0.5, 0.1, 0.3), {{0.65, 0.84375, -5.625}, {0.7, 0.5, -7.5}, {0.3, 0.5, 7.5}});
  for (const double x : {0.4, 0.45, 0.5, 0.6})
    CHECK(Functions().lens_weight(x, 0.5, 0.1, 0.3).x == Approx(1).margin(1e-14));
  for (const double x : {0.0, 0.2, 0.8, 1.0})
    CHECK(Functions().lens_weight(x, 0.5, 0.1, 0.3).x == Approx(0).margin(1e-14));
}

TEST_CASE("slopes beside the borders of regions") {
  check_slopes_beside(bifocal(0.4, 0.6, 0.2, 0.8), 0.2, 2, 1.0 / 3);
  check_slopes_beside(bifocal(0.4, 0.6, 0.2, 0.8), 0.8, 1.0 / 3, 2);
  check_slopes_beside(bifocal(0.1, 0.3, 0.2, 0.7), 0.7, 0.4, 7.0 / 3);
  check_slopes_beside(fisheye(0.5, 3), 0.5, 0.25, 0.25);
  check_slopes_beside(fisheye(0.25, 3), 0.25, 0.25, 0.25);
  check_slopes_beside(fisheye(0.25, 3), 1, 4, 1); // beyond the face nothing is moved
  check_slopes_beside(fisheye(0.25, 3), 0, 1, 4);
  // The quadratic leaves the inner edge with the slope 1/m that it meets there: C¹.
  check_slopes_beside(lens(0.5, 0.1, 0.3, 2), 0.6, 0.5, 0.5);
  check_slopes_beside(lens(0.5, 0.1, 0.3, 2), 0.4, 0.5, 0.5);
  check_slopes_beside(lens(0.4, 0.1, 0.2, 4), 0.5, 0.25, 0.25);
  // At the outer edge it arrives with 1/m + 2o(1 − 1/m)/(o − i), and leaves with 1.
  check_slopes_beside(lens(0.5, 0.1, 0.3, 2), 0.8, 2, 1);
  check_slopes_beside(lens(0.5, 0.1, 0.3, 2), 0.2, 1, 2);
  check_slopes_beside(lens(0.4, 0.1, 0.2, 4), 0.6, 3.25, 1);
}

TEST_CASE("every axis map is continuous, rises, keeps its ends, and is the identity beyond them") {
  for (const RandomAxis& kind : random_axes()) {
    INFO(kind.name);
    CHECK(rc::check([&] {
      const Axis map = kind.make();
      RC_ASSERT(std::abs(map(0).x) <= 1e-13);
      RC_ASSERT(std::abs(map(1).x - 1) <= 1e-13);
      const double beyond = random_in(1e-9, 3);
      RC_ASSERT(map(-beyond) == glm::dvec2(-beyond, 1));
      RC_ASSERT(map(1 + beyond) == glm::dvec2(1 + beyond, 1));
      double before = 0;
      for (int i = 1; i <= 400; ++i) {
        const double u = map(i / 400.0).x;
        RC_ASSERT(u >= before - 1e-13);
        // The steepest is a bifocal's middle, .96/.01 = 96, over a four-hundredth.
        RC_ASSERT(u - before < 0.25);
        before = u;
      }
    }));
  }
}

TEST_CASE("the slope that an axis map gives is its derivative") {
  for (const RandomAxis& kind : random_axes()) {
    INFO(kind.name);
    CHECK(rc::check([&] {
      const Axis map = kind.make();
      // At the inner edge of a lens the second derivative jumps by 2·bend, at most 1700: h·bend/2 = 4e-5.
      const double h = 1e-7;
      for (int i = 0; i < 20; ++i) {
        const double x = random_in(0.01, 0.99);
        const double left = map(x - h).y;
        const double right = map(x + h).y;
        if (std::abs(left - right) > 0.01 * (left + right))
          continue; // a crease
        const double difference = (map(x + h).x - map(x - h).x) / (2 * h);
        RC_ASSERT(std::abs(map(x).y - difference) <= 1e-4 * std::max(1.0, map(x).y));
      }
    }));
  }
}

TEST_CASE("without strength an axis map is the identity") {
  CHECK(rc::check([] {
    const double x = random_in(-0.5, 1.5);
    const double a = random_in(0.05, 0.8);
    const double b = random_in(a + 0.01, 0.95);
    const double outer = std::min(a, 1 - a);
    for (const glm::dvec2& u : {bifocal(a, b, a, b)(x), fisheye(a, 0)(x), lens(a, outer / 3, outer, 1)(x)}) {
      RC_ASSERT(std::abs(u.x - x) <= 1e-13);
      RC_ASSERT(std::abs(u.y - 1) <= 1e-14);
    }
  }));
}
