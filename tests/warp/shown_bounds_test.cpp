// Where small parts of the data are shown: whatever point looks into the part lies in its bounds.
#include "catch.h"
#include "warp/object_bounds.h"

#include <random>

using namespace slicelens;

namespace {

const BoxSpace unit{glm::dvec3(1)};

bool inside(const Bounds& bounds, const glm::dvec3& p, double margin) {
  return glm::all(glm::greaterThanEqual(p, bounds.low - margin)) &&
         glm::all(glm::lessThanEqual(p, bounds.high + margin));
}

/// Looks back from points all over the place, 40 random parts of an eighth of the box.
void check_parts(const Warp& warp, double reach) {
  const WarpMap map = map_of(warp, unit, {});
  std::mt19937 random(11);
  std::uniform_real_distribution<double> corner(0, 0.875);
  std::uniform_real_distribution<double> place(-reach, 1 + reach);
  std::vector<Bounds> parts;
  std::vector<std::optional<Bounds>> shown;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 low(corner(random), corner(random), corner(random));
    parts.push_back({low, low + 0.125});
    shown.push_back(shown_bounds(map, parts.back()));
  }
  int hits = 0;
  for (int n = 0; n < 40000; ++n) {
    const glm::dvec3 p(place(random), place(random), place(random));
    const glm::dvec3 u = texture_from_object(map, p);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!inside(parts[i], u, 0))
        continue;
      ++hits;
      REQUIRE(shown[i].has_value());
      INFO(kind_of(warp) << " shows part " << i << " at " << p.x << " " << p.y << " " << p.z);
      CHECK(inside(*shown[i], p, 1e-9));
    }
  }
  CHECK(hits > 100);
}

} // namespace

TEST_CASE("small parts are shown within their bounds") {
  check_parts(Shift{{0.25, -0.1, 0}}, 0.3);
  check_parts(Sine{Axis::y, Axis::z, 0.1, 0.3, 20}, 0.2);
  check_parts(Twist{Axis::z, glm::dvec3(0.5), 120}, 0.4);
  check_parts(Bend{Axis::z, Direction::x, glm::dvec3(0.5), 60}, 0.6);
  check_parts(Pulse{}, 0.3);
  check_parts(Spreader{}, 0.6);
  check_parts(Peeler{}, 0.6);
  check_parts(Expander{}, 0.3);
  check_parts(Leafer{}, 0.6);
  LamarLens lens;
  lens.center = {0.5, 0.4, 0.55};
  lens.inner = 0.15;
  lens.outer = 0.3;
  check_parts(lens, 0.1);
}

TEST_CASE("a lens leaves alone what does not meet its footprint") {
  LamarLens lens;
  lens.inner = 0.1;
  lens.outer = 0.2;
  const WarpMap map = map_of(lens, unit, {});
  const Bounds corner{glm::dvec3(0), glm::dvec3(0.1)};
  CHECK(shown_bounds(map, corner)->low == corner.low);
  CHECK(shown_bounds(map, corner)->high == corner.high);
  CHECK(shown_bounds(map, {glm::dvec3(0.45), glm::dvec3(0.55)})->high.x == Approx(0.7));
}

TEST_CASE("bounds of Cohen's maps are not known") {
  CHECK_FALSE(shown_bounds(map_of(Fisheye{}, unit, {}), {glm::dvec3(0), glm::dvec3(0.1)}).has_value());
}
