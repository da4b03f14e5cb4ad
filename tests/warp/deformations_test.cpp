// Brunet's deformations and the volume widgets: points worked by hand, what is refused, strength zero,
// bounds.
#include "catch.h"
#include "core/errors.h"
#include "warp/object_bounds.h"
#include "warp_cases.h"

#include <functional>
#include <limits>
#include <numbers>

using namespace slicelens;
using namespace warp_cases;

namespace {

constexpr double pi = std::numbers::pi;
const BoxSpace unit = {glm::dvec3(1), 1};
const std::vector<std::string> kinds = {"shift",    "sine",   "twist",  "bend",    "pulse",
                                        "spreader", "leafer", "peeler", "expander"};

/// The point of the data, and back.
void check_point(const WarpMap& map, const glm::dvec3& p, const glm::dvec3& expected) {
  const glm::dvec3 u = texture_from_object(map, p);
  INFO("u(" << p.x << ", " << p.y << ", " << p.z << ") = (" << u.x << ", " << u.y << ", " << u.z << ") for ("
            << expected.x << ", " << expected.y << ", " << expected.z << ")");
  CHECK(glm::length(u - expected) < 1e-12);
  CHECK(glm::length(object_from_texture(map, expected) - p) < 1e-12);
}

void check_nowhere(const WarpMap& map, const glm::dvec3& p) {
  INFO(p.x << ", " << p.y << ", " << p.z);
  CHECK(is_nowhere(texture_from_object(map, p)));
  CHECK(jacobian(map, p) == glm::dmat3(1));
}

WarpMap unit_map(const Warp& warp, const BoxSpace& space = unit) { return map_of(warp, space, {}); }

std::string refusal(const Warp& warp, const BoxSpace& space = unit) {
  try {
    validate(warp);
    (void)map_of(warp, space, {});
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

void check_refused(const Warp& warp, const std::vector<std::string>& named) {
  const std::string message = refusal(warp);
  INFO(kind_of(warp) << ": " << message);
  REQUIRE_FALSE(message.empty());
  CHECK(message.find('\n') == std::string::npos);
  CHECK(message.find("warp '" + kind_of(warp) + "'") == 0);
  for (const std::string& text : named) {
    INFO(text);
    CHECK(message.find(text) != std::string::npos);
  }
}

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace

TEST_CASE("shift: points worked by hand") {
  const WarpMap map = unit_map(Shift{{0.1, -0.2, 0}});
  check_point(map, {0, 0, 0}, {-0.1, 0.2, 0});
  check_point(map, {0.1, 0, 0}, {0, 0.2, 0});
  check_point(map, {0.5, 0.5, 0.5}, {0.4, 0.7, 0.5});
  check_point(map, {1, 1, 1}, {0.9, 1.2, 1});
  check_point(map, {1.1, 0.8, 1}, {1, 1, 1});
}

TEST_CASE("sine: points worked by hand") {
  const WarpMap map = unit_map(Sine{Axis::x, Axis::z, 0.1, 0.5, 0});
  check_point(map, {0.5, 0.5, 0}, {0.5, 0.5, 0});
  check_point(map, {0.5, 0.5, 0.125}, {0.4, 0.5, 0.125});
  check_point(map, {0.5, 0.5, 0.25}, {0.5, 0.5, 0.25});
  check_point(map, {0.5, 0.5, 0.375}, {0.6, 0.5, 0.375});
  check_point(map, {0.5, 0.5, 1.0 / 24}, {0.45, 0.5, 1.0 / 24});
  // A quarter wave of phase is a quarter wave further on.
  check_point(unit_map(Sine{Axis::x, Axis::z, 0.1, 0.5, 90}), {0.5, 0.5, 0}, {0.4, 0.5, 0});
  // ∂u_x/∂z = −A·2π/λ at z = 0.
  CHECK(jacobian(map, {0.5, 0.5, 0})[2].x == Approx(-0.4 * pi));
}

TEST_CASE("twist: points worked by hand") {
  const WarpMap map = unit_map(Twist{Axis::z, glm::dvec3(0.5), 180});
  check_point(map, {1, 0.5, 0.5}, {1, 0.5, 0.5});
  check_point(map, {1, 0.5, 1}, {0.5, 0, 1});
  check_point(map, {0.5, 1, 1}, {1, 0.5, 1});
  check_point(map, {1, 0.5, 0}, {0.5, 1, 0});
  check_point(map, {0.5, 0.5, 0.9}, {0.5, 0.5, 0.9});
  // The angle is over the box's length: a box of half the height turns as much over it.
  check_point(unit_map(Twist{Axis::z, glm::dvec3(0.5), 180}, {{1, 1, 0.5}, 1}), {1, 0.5, 0.5}, {0.5, 0, 0.5});
}

TEST_CASE("bend: points worked by hand") {
  // k = 1 and L = π in a map of its own; a box has no edge above 1.
  const BendMap map = {glm::dvec3(0), {0, 1, 0}, {1, 0, 0}, 1, pi / 2, std::cos(pi / 2), 1, 1, 1};
  const double root = std::sqrt(0.5);
  check_point(map, {0, 0, 0.3}, {0, 0, 0.3});
  check_point(map, {0.5, 0, 0.3}, {0.5, 0, 0.3});
  check_point(map, {1 - root, root, 0.3}, {0, pi / 4, 0.3});
  check_point(map, {1, 1, 0.3}, {0, pi / 2, 0.3});
  check_point(map, {1, 0.5, 0.3}, {0.5, pi / 2, 0.3});
  check_point(map, {1.25, 1, 0.3}, {0, pi / 2 + 0.25, 0.3});
  check_point(map, {1.25, -1, 0.3}, {0, -pi / 2 - 0.25, 0.3});
}

TEST_CASE("bend: the formulas of its definition, with either sign, and beyond the ends") {
  CHECK(rc::check([] {
    const BoxSpace space = box_space(lens_cases::random_box());
    const Bend bend = random_bend(space);
    const BendMap map = bend_map(bend, space);
    const glm::dvec3 p = warp_cases::random_point(space);
    const double k = glm::radians(bend.angle) / space.size[index_of(bend.axis)];
    if (std::abs(k) < 1e-3)
      return; // the formulas as they stand divide by k
    const double x = glm::dot(p - map.center, map.toward);
    const double y = glm::dot(p - map.center, map.axis);
    const double s = k < 0 ? -1 : 1;
    const double rho = s * std::hypot(1 / k - x, y);
    const double theta = std::atan2(s * y, s * (1 / k - x));
    const double most = std::abs(glm::radians(bend.angle)) / 2;
    glm::dvec2 u(1 / k - rho, theta / k);
    if (std::abs(theta) > most) {
      const double end = theta < 0 ? -most : most;
      u = {1 / k - (1 / k - x) * std::cos(end) - y * std::sin(end),
           end / k + y * std::cos(end) - (1 / k - x) * std::sin(end)};
    }
    const glm::dvec3 expected = p + (u.x - x) * map.toward + (u.y - y) * map.axis;
    // 1/k up to 1000 cancels to 1e-13.
    RC_ASSERT(glm::length(texture_from_object(map, p) - expected) < 1e-11);
  }));
}

TEST_CASE("pulse: points worked by hand, and its course in time") {
  const WarpMap map = unit_map(Pulse{glm::dvec3(0.5), 0.4, 2, 0.5});
  check_point(map, {0.5, 0.5, 0.5}, {0.5, 0.5, 0.5});
  check_point(map, {0.6, 0.5, 0.5}, {0.571875, 0.5, 0.5});
  check_point(map, {0.7, 0.5, 0.5}, {0.675, 0.5, 0.5});
  check_point(map, {0.8, 0.5, 0.5}, {0.790625, 0.5, 0.5});
  check_point(map, {0.9, 0.5, 0.5}, {0.9, 0.5, 0.5});
  CHECK(jacobian(map, glm::dvec3(0.5))[0][0] == Approx(0.5));
  // sin²(π/6) = 1/4: of the magnification 2 a quarter of 1 is left, m = 5/4.
  CHECK(jacobian(unit_map(Pulse{glm::dvec3(0.5), 0.4, 2, 1.0 / 6}), glm::dvec3(0.5))[1][1] == Approx(0.8));
}

TEST_CASE("spreader: points worked by hand") {
  const WarpMap map = unit_map(Spreader{Axis::x, Direction::z, glm::dvec3(0.5), 90, 0});
  const auto at = [](double x, double z) { return glm::dvec3(0.5 + x, 0.5, 0.5 + z); };
  const double root = std::sqrt(2.0);
  const double radius = 0.4;
  check_nowhere(map, at(0, 0.4));
  check_nowhere(map, at(0.29, 0.3));
  check_point(map, at(0.3, 0.3), at(0, 0.3 * root));
  check_point(map, at(0.4, 0), at(0.4, 0));
  const double shown = 67.5 * pi / 180;
  check_point(map, at(radius * std::sin(shown), radius * std::cos(shown)), at(0.2 * root, 0.2 * root));
  check_point(map, at(-radius * std::sin(shown), radius * std::cos(shown)), at(-0.2 * root, 0.2 * root));
  check_point(map, at(0.2, -0.3), at(0.2, -0.3));
  const WarpMap gap = unit_map(Spreader{Axis::x, Direction::z, glm::dvec3(0.5), 0, 0.2});
  check_nowhere(gap, at(0.05, 0.2));
  check_point(gap, at(0.3, 0.2), at(0.2, 0.2));
  check_point(gap, at(-0.3, 0.2), at(-0.2, 0.2));
}

TEST_CASE("leafer: points worked by hand") {
  const WarpMap map = unit_map(Leafer{Direction::y, Direction::x, 2, 90});
  check_point(map, {0.8, 0.2, 0.7}, {0.8, 0.2, 0.7});
  check_nowhere(map, {0.8, 0.6, 0.7});
  check_point(map, {-0.6, 0.8, 0.7}, {0.8, 0.6, 0.7});
  check_point(map, {-0.55, 0.3, 0.7}, {0.3, 0.55, 0.7});
  check_nowhere(map, {-0.4, 0.5, 0.7});
  // From the opposite edge, against both axes.
  const WarpMap other = unit_map(Leafer{Direction::minus_y, Direction::minus_x, 2, 90});
  check_point(other, {0.2, 0.8, 0.7}, {0.2, 0.8, 0.7});
  check_point(other, {1.6, 0.2, 0.7}, {0.2, 0.4, 0.7});
}

TEST_CASE("peeler: points worked by hand") {
  const PeelerMap map = {glm::dvec3(0), {0, 1, 0}, {1, 0, 0}, 1, pi / 2, std::cos(pi / 2), 1};
  const double root = std::sqrt(0.5);
  check_point(map, {0.2, -0.5, 0.3}, {0.2, -0.5, 0.3});
  check_point(map, {-0.2, 0.5, 0.3}, {-0.2, 0.5, 0.3});
  check_point(map, {0.5, 0.5, 0.3}, {1 - root, pi / 4, 0.3});
  check_point(map, {1, 0.8, 0.3}, {0.2, pi / 2, 0.3});
  check_point(map, {1.3, 0.8, 0.3}, {0.2, pi / 2 + 0.3, 0.3});
  check_nowhere(map, {0.1, 0.9, 0.3});
  // The layer leaves its place without a jump.
  for (const double x : {0.01, 0.2, 0.9}) {
    const glm::dvec3 before = texture_from_object(map, {x, -1e-9, 0});
    const glm::dvec3 after = texture_from_object(map, {x, 1e-9, 0});
    CHECK(glm::length(after - before) < 1e-7);
  }
}

TEST_CASE("expander: points worked by hand") {
  const WarpMap map = unit_map(Expander{glm::dvec3(0.5), 0.1, 0.3});
  check_nowhere(map, {0.55, 0.5, 0.5});
  CHECK(glm::length(texture_from_object(map, {0.6 + 1e-15, 0.5, 0.5}) - glm::dvec3(0.5)) < 1e-12);
  check_point(map, {0.7, 0.5, 0.5}, {0.65, 0.5, 0.5});
  check_point(map, {0.75, 0.5, 0.5}, {0.725, 0.5, 0.5});
  check_point(map, {0.8, 0.5, 0.5}, {0.8, 0.5, 0.5});
  check_point(map, {0.5, 0.95, 0.5}, {0.5, 0.95, 0.5});
}

TEST_CASE(
    "the bend jumps behind its arc's axis, where it declares a cut, and shows nothing of the volume there") {
  CHECK(rc::check([] {
    const BoxSpace space = box_space(lens_cases::random_box());
    const BendMap map = bend_map(random_bend(space), space);
    if (std::abs(map.curvature) < 0.1)
      return;
    const glm::dvec3 q = map.center + (random_in(1.01, 3) / map.curvature) * map.toward;
    const glm::dvec3 above = texture_from_object(map, q + 1e-9 * map.axis);
    const glm::dvec3 below = texture_from_object(map, q - 1e-9 * map.axis);
    RC_ASSERT(glm::length(above - below) > map.half_length);
    RC_ASSERT(near_cut(WarpMap(map), q, 1e-8));
    for (const glm::dvec3& u : {above, below})
      RC_ASSERT(std::abs(glm::dot(u - map.center, map.axis)) > map.half_length);
  }));
}

TEST_CASE("deformations and widgets without strength move nothing") {
  const std::vector<Warp> still = {
      Shift{glm::dvec3(0)},
      Sine{Axis::x, Axis::z, 0, 0.5, 30},
      Twist{Axis::y, {0.3, 0.4, 0.5}, 0},
      Bend{Axis::z, Direction::minus_x, {0.3, 0.4, 0.5}, 0},
      Pulse{{0.3, 0.4, 0.5}, 0.4, 1, 0.5},
      Pulse{{0.3, 0.4, 0.5}, 0.4, 3, 0},
      Pulse{{0.3, 0.4, 0.5}, 0.4, 3, 1},
      Spreader{Axis::x, Direction::minus_y, {0.3, 0.4, 0.5}, 0, 0},
      Leafer{Direction::minus_z, Direction::y, 5, 0},
      Peeler{Direction::z, Direction::minus_y, {0.3, 0.4, 0.5}, 0.7, 0},
      Expander{{0.3, 0.4, 0.5}, 0, 0.3},
  };
  for (const Warp& warp : still) {
    INFO(kind_of(warp));
    CHECK(refusal(warp).empty());
    CHECK(rc::check([&] {
      const BoxSpace space = box_space(lens_cases::random_box());
      const glm::dvec3 p = space.size * glm::dvec3(random_in(0, 1), random_in(0, 1), random_in(0, 1));
      RC_ASSERT(glm::length(texture_from_object(unit_map(warp, space), p) - p) < 1e-14);
    }));
  }
}

TEST_CASE("nothing of the volume is shown outside its bounds, and they are not much too large") {
  for (const std::string& kind : kinds) {
    INFO(kind);
    CHECK(rc::check([&] {
      const WarpCase c = warp_cases::random_case(kind);
      const Bounds bounds = object_bounds(c.map, {glm::dvec3(0), c.space.size});
      for (int i = 0; i < 60; ++i) {
        glm::dvec3 t(random_in(0, 1), random_in(0, 1), random_in(0, 1));
        if (i % 2 == 0)
          t[*rc::gen::inRange(0, 3)] = *rc::gen::inRange(0, 2); // on a face
        const glm::dvec3 p = object_from_texture(c.map, t * c.space.size);
        RC_ASSERT(glm::all(glm::greaterThanEqual(p, bounds.low - 1e-12)));
        RC_ASSERT(glm::all(glm::lessThanEqual(p, bounds.high + 1e-12)));
      }
      // What is exact is touched on every side by a dense set of points of the faces.
      if (kind == "spreader" || kind == "pulse" || kind == "expander" || kind == "sine" || kind == "peeler")
        return;
      glm::dvec3 low(1e9);
      glm::dvec3 high(-1e9);
      for (int k = 0; k < 6 * 41 * 41; ++k) {
        glm::dvec3 t(k / 6 % 41 / 40.0, k / 6 / 41 / 40.0, 0);
        t = k % 3 == 0 ? t : k % 3 == 1 ? glm::dvec3(t.z, t.x, t.y) : glm::dvec3(t.y, t.z, t.x);
        if (k % 6 >= 3)
          t[(k % 3 + 2) % 3] = 1;
        const glm::dvec3 p = object_from_texture(c.map, t * c.space.size);
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
      // Half a cell of 1/40 along arcs that turn by at most 2 radians for each unit of the bounds.
      const double loose = 0.1 * glm::length(bounds.high - bounds.low);
      RC_ASSERT(glm::all(glm::lessThanEqual(low - bounds.low, glm::dvec3(loose))));
      RC_ASSERT(glm::all(glm::lessThanEqual(bounds.high - high, glm::dvec3(loose))));
    }));
  }
}

TEST_CASE("bounds worked by hand") {
  const Bounds box{glm::dvec3(0), glm::dvec3(1)};
  const auto check = [&](const Warp& warp, const glm::dvec3& low, const glm::dvec3& high) {
    const Bounds bounds = object_bounds(unit_map(warp), box);
    INFO(kind_of(warp) << ": (" << bounds.low.x << ", " << bounds.low.y << ", " << bounds.low.z << ") to ("
                       << bounds.high.x << ", " << bounds.high.y << ", " << bounds.high.z << ")");
    CHECK(glm::length(bounds.low - low) < 1e-12);
    CHECK(glm::length(bounds.high - high) < 1e-12);
  };
  check(Shift{{0.25, -0.5, 0}}, {0.25, -0.5, 0}, {1.25, 0.5, 1});
  check(Sine{Axis::y, Axis::z, -0.1, 0.3, 0}, {0, -0.1, 0}, {1, 1.1, 1});
  // 45 degrees either way: corners come to the axes.
  const double root = std::sqrt(0.5);
  check(Twist{Axis::z, glm::dvec3(0.5), 90}, {0.5 - root, 0.5 - root, 0}, {0.5 + root, 0.5 + root, 1});
  // Arms from 1/k − 1/2 to 1/k + 1/2 with k = π/3, half angle 30 degrees.
  const double r = 3 / pi;
  check(Bend{Axis::z, Direction::x, glm::dvec3(0.5), 60}, {0, 0, 0.5 - (r + 0.5) / 2},
        {0.5 + r - (r - 0.5) * std::cos(pi / 6), 1, 0.5 + (r + 0.5) / 2});
  // The second of two leaves stands upright beyond the spine.
  check(Leafer{Direction::y, Direction::x, 2, 90}, {-1, 0, 0}, {1, 1, 1});
  check(Pulse{glm::dvec3(0.5), 0.3, 2, 0.5}, {0, 0, 0}, {1, 1, 1});
  check(Pulse{{0.5, 0.9, 0.5}, 0.3, 2, 0.5}, {0, 0, 0}, {1, 1.2, 1});
}

TEST_CASE("deformations that are none are refused by name") {
  check_refused(Shift{{0, 5, 0}}, {"offset", "5"});
  check_refused(Shift{{nan_value, 0, 0}}, {"offset"});
  check_refused(Sine{Axis::x, Axis::x}, {"axis", "along", "both x"});
  for (const double wavelength : {0.0, -1.0, nan_value, infinite})
    check_refused(Sine{Axis::x, Axis::y, 0.1, wavelength}, {"wavelength"});
  for (const double amplitude : {-3.0, 3.0, nan_value, infinite})
    check_refused(Sine{Axis::x, Axis::y, amplitude}, {"amplitude"});
  check_refused(Sine{Axis::x, Axis::y, 0.1, 1, infinite}, {"phase"});
  check_refused(Twist{Axis::x, glm::dvec3(0.5), 1e5}, {"angle"});
  check_refused(Twist{Axis::x, glm::dvec3(nan_value), 10}, {"center"});
  check_refused(Bend{Axis::x, Direction::minus_x}, {"axis", "toward", "both x"});
  check_refused(Bend{Axis::x, Direction::y, glm::dvec3(0.5), 181}, {"angle"});
  check_refused(Bend{Axis::x, Direction::y, glm::dvec3(0.5), nan_value}, {"angle"});
  check_refused(Pulse{glm::dvec3(0.5), 0, 2, 0.5}, {"radius"});
  check_refused(Pulse{glm::dvec3(0.5), 0.3, 0.249, 0.5}, {"magnification", "folds", "0.25"});
  check_refused(Pulse{glm::dvec3(0.5), 0.3, infinite, 0.5}, {"magnification"});
  check_refused(Pulse{glm::dvec3(0.5), 0.3, 2, 1.5}, {"phase"});
  CHECK(refusal(Pulse{glm::dvec3(0.5), 0.3, 0.25, 0.5}).empty());
}

TEST_CASE("widgets that are none are refused by name") {
  check_refused(Spreader{Axis::y, Direction::minus_y}, {"axis", "toward", "both y"});
  check_refused(Spreader{Axis::x, Direction::y, glm::dvec3(0.5), 171}, {"angle"});
  check_refused(Spreader{Axis::x, Direction::y, glm::dvec3(0.5), 10, -1}, {"gap"});
  check_refused(Leafer{Direction::z, Direction::minus_z}, {"both z"});
  check_refused(Leafer{Direction::z, Direction::x, 1}, {"leaves"});
  check_refused(Leafer{Direction::z, Direction::x, 65}, {"leaves"});
  check_refused(Leafer{Direction::z, Direction::x, 5, 190}, {"angle"});
  check_refused(Peeler{Direction::x, Direction::x}, {"both x"});
  check_refused(Peeler{Direction::x, Direction::y, glm::dvec3(0.5), 0.5, 90}, {"radius", "folds", "0.5"});
  check_refused(Peeler{Direction::x, Direction::y, glm::dvec3(0.5), 0.6, -1}, {"angle"});
  CHECK(refusal(Peeler{Direction::x, Direction::y, {0.5, 0.9, 0.5}, 0.11, 90}).empty());
  check_refused(Expander{glm::dvec3(0.5), 0.3, 0.3}, {"opening", "smaller than radius"});
  check_refused(Expander{glm::dvec3(0.5), -0.1, 0.3}, {"opening"});
  check_refused(Expander{glm::dvec3(infinite), 0.1, 0.3}, {"center"});
}

TEST_CASE("a bend that folds the box is refused, and says which angle would do") {
  // 1/k > 1/2: below 2 radians = 114.59 degrees about the middle.
  CHECK(refusal(Bend{Axis::z, Direction::x, glm::dvec3(0.5), 114.5}).empty());
  CHECK(refusal(Bend{Axis::z, Direction::x, glm::dvec3(0.5), -114.5}).empty());
  check_refused(Bend{Axis::z, Direction::x, glm::dvec3(0.5), 114.7}, {"angle", "folds", "114.5"});
  check_refused(Bend{Axis::z, Direction::x, glm::dvec3(0.5), -114.7}, {"angle", "folds"});
  // About the face on that side everything up to half a turn is possible, towards the other side less.
  CHECK(refusal(Bend{Axis::z, Direction::x, {0.9, 0.5, 0.5}, 180}).empty());
  check_refused(Bend{Axis::z, Direction::minus_x, {0.9, 0.5, 0.5}, 70}, {"angle", "folds"});
  check_refused(Bend{Axis::z, Direction::x, {0.9, 0.5, 0.5}, -70}, {"angle", "folds"});
  // The same angle over half the length.
  CHECK_FALSE(refusal(Bend{Axis::z, Direction::x, glm::dvec3(0.5), 60}, {{1, 1, 0.5}, 1}).empty());
}
