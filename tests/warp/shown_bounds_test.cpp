// Where small parts of the data are shown: whatever point looks into the part lies in its bounds.
#include "catch.h"
#include "warp/shown_bounds.h"
#include "warp/warp_grid.h"

#include <random>

using namespace slicelens;

namespace {

const BoxSpace unit{glm::dvec3(1)};

bool inside(const Bounds& bounds, const glm::dvec3& p, double margin) {
  return glm::all(glm::greaterThanEqual(p, bounds.low - margin)) &&
         glm::all(glm::lessThanEqual(p, bounds.high + margin));
}

/// 40 random parts of an eighth of the box, and thin ones.
std::vector<Bounds> random_parts(const glm::dvec3& size) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> corner(0, 0.875);
  std::vector<Bounds> parts;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 low(corner(random), corner(random), corner(random));
    const glm::dvec3 edge = i % 4 == 0 ? glm::dvec3(0.02, 0.12, 0.125) : glm::dvec3(0.125);
    parts.push_back({size * low, size * (low + edge)});
  }
  return parts;
}

/// Looks back from points all over the place: whatever looks into a part lies in its bounds, as each map in
/// turn gives them and as the list does.
void check_parts(const std::vector<WarpMap>& maps, double reach, const glm::dvec3& size = glm::dvec3(1)) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(-reach, 1 + reach);
  const std::vector<Bounds> parts = random_parts(size);
  const ShownBounds shown_by_list = shown_bounds_of(maps);
  std::vector<std::optional<Bounds>> one_by_one;
  std::vector<std::optional<Bounds>> shown;
  for (const Bounds& part : parts) {
    one_by_one.emplace_back(part);
    for (const WarpMap& map : maps)
      one_by_one.back() = one_by_one.back() ? shown_bounds(map, *one_by_one.back()) : std::nullopt;
    shown.push_back(shown_by_list(part));
  }
  int hits = 0;
  for (int n = 0; n < 40000; ++n) {
    const glm::dvec3 p = size * glm::dvec3(place(random), place(random), place(random));
    const glm::dvec3 u = texture_from_object(maps, p);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!inside(parts[i], u, 0))
        continue;
      ++hits;
      INFO("part " << i << " is shown at " << p.x << " " << p.y << " " << p.z);
      REQUIRE(one_by_one[i].has_value());
      CHECK(inside(*one_by_one[i], p, 1e-9));
      REQUIRE(shown[i].has_value());
      CHECK(inside(*shown[i], p, 1e-9));
    }
  }
  CHECK(hits > 100);
}

void check_parts(const Warp& warp, double reach) {
  INFO(kind_of(warp));
  check_parts(std::vector<WarpMap>{map_of(warp, unit, {})}, reach);
}

/// Random displacements, large enough to fold, in a grid that ends within the data.
GridMap random_grid(double size) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> offset(-size, size);
  const GridFill fill = [&](const std::array<std::size_t, 3>& n, const glm::dvec3&, const glm::dvec3&) {
    std::vector<glm::dvec3> offsets(n[0] * n[1] * n[2]);
    for (glm::dvec3& one : offsets)
      one = {offset(random), offset(random), offset(random)};
    return offsets;
  };
  return {
      std::make_shared<const MapGrid>(make_map_grid(fill, {6, 5, 7}, {0.05, -0.1, 0.1}, {0.9, 1.1, 0.95}))};
}

GridMap gridded(const Warp& warp, std::size_t nodes) {
  const std::vector<WarpMap> maps = {map_of(warp, unit, {})};
  return {std::make_shared<const MapGrid>(
      make_map_grid(maps, {nodes, nodes, nodes}, glm::dvec3(-0.3), glm::dvec3(1.3)))};
}

double volume_of(const std::optional<Bounds>& bounds) {
  if (!bounds)
    return 0;
  const glm::dvec3 edges = bounds->high - bounds->low;
  return edges.x * edges.y * edges.z;
}

/// Sum of the volumes of the bounds of all 16³ cells of the unit cube.
double volume_of_cells(const ShownBounds& shown) {
  double sum = 0;
  for (int i = 0; i < 16 * 16 * 16; ++i) {
    const glm::dvec3 low(i % 16 / 16.0, i / 16 % 16 / 16.0, i / 256 / 16.0);
    sum += volume_of(shown({low, low + 1 / 16.0}));
  }
  return sum;
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

TEST_CASE("small parts are shown within their bounds: Cohen's maps") {
  Bifocal bifocal;
  bifocal.focus = ranges_of({0.3, 0.4, 0.1}, {0.5, 0.7, 0.3});
  check_parts(bifocal, 0.1);
  Fisheye fisheye;
  fisheye.center = {0.3, 0.5, 0.8};
  fisheye.distortion = {3, 0, 12};
  check_parts(fisheye, 0.1);
  for (const double magnification : {0.8, 1.0, 2.0, 8.0}) {
    const LensBox box{{0.45, 0.5, 0.55}, {0.15, 0.1, 0.2}, {0.35, 0.4, 0.43}, magnification};
    check_parts(VolumeLens{box}, 0.1);
    check_parts(ConnectedLens{box}, 0.1);
  }
}

TEST_CASE("small parts are shown within their bounds: grids") {
  for (const double size : {0.02, 0.1, 0.6})
    check_parts({random_grid(size)}, 0.8);
  check_parts({gridded(Twist{Axis::z, glm::dvec3(0.5), 120}, 24)}, 0.4);
  check_parts({gridded(Spreader{}, 16)}, 0.6);
  Landmarks landmarks;
  landmarks.space = LandmarkSpace::texture;
  landmarks.pairs =
      std::vector<LandmarkPair>{LandmarkPair{glm::dvec3(0.3, 0.3, 0.3), glm::dvec3(0.35, 0.3, 0.2)},
                                LandmarkPair{glm::dvec3(0.7, 0.4, 0.5), glm::dvec3(0.7, 0.5, 0.5)},
                                LandmarkPair{glm::dvec3(0.5, 0.8, 0.6), glm::dvec3(0.45, 0.8, 0.6)},
                                LandmarkPair{glm::dvec3(0.2, 0.6, 0.9), glm::dvec3(0.2, 0.6, 0.8)},
                                LandmarkPair{glm::dvec3(0.8, 0.8, 0.2), glm::dvec3(0.8, 0.9, 0.3)}};
  check_parts(landmarks, 0.5);
}

TEST_CASE("small parts are shown within their bounds: lists, and a box that is no cube") {
  const WarpMap twist = map_of(Twist{Axis::z, glm::dvec3(0.5), 70}, unit, {});
  const WarpMap fisheye = map_of(Fisheye{}, unit, {});
  check_parts({fisheye, twist}, 0.4);
  check_parts({twist, fisheye}, 0.4);
  check_parts({random_grid(0.1), twist, gridded(Sine{Axis::y, Axis::z, 0.1, 0.3, 20}, 24)}, 0.8);
  check_parts({map_of(ConnectedLens{}, unit, {}), random_grid(0.05), fisheye}, 0.4);
  const BoxSpace flat{{1, 0.5, 0.25}};
  check_parts({map_of(Fisheye{}, flat, {}), map_of(ConnectedLens{}, flat, {}), map_of(Bifocal{}, flat, {})},
              0.1, flat.size);
}

TEST_CASE("maps of single axes have the tightest bounds") {
  // Exact cells of a partition of the data make a partition of the display: volumes add up to 1.
  const auto sum = [](const Warp& warp) {
    return volume_of_cells(shown_bounds_of({map_of(warp, unit, {})}));
  };
  CHECK(sum(Bifocal{}) == Approx(1).epsilon(1e-12));
  CHECK(sum(Fisheye{}) == Approx(1).epsilon(1e-12));
  // Cells within the lens tile where it shows them all: [0.2, 0.8]³ is its box.
  const WarpMap lens = map_of(VolumeLens{}, unit, {});
  double tiles = 0;
  const auto corner = [](int i) { return 0.21 + 0.58 * i / 8; };
  for (int i = 0; i < 8 * 8 * 8; ++i) {
    const glm::ivec3 at(i % 8, i / 8 % 8, i / 64);
    tiles += volume_of(shown_bounds(lens, {{corner(at.x), corner(at.y), corner(at.z)},
                                           {corner(at.x + 1), corner(at.y + 1), corner(at.z + 1)}}));
  }
  CHECK(tiles == Approx(volume_of(shown_bounds(lens, {glm::dvec3(0.21), glm::dvec3(0.79)}))).epsilon(1e-12));
  // Cells that cross its faces count where they are and where the lens shows them; in the connected lens'
  // border all do.
  CHECK(sum(VolumeLens{}) < 1.6);
  CHECK(sum(ConnectedLens{}) < 2.1);
}

TEST_CASE("a grid's bounds are as tight as its displacements are even") {
  const Bounds part{{0.2, 0.3, 0.4}, {0.25, 0.4, 0.5}};
  // The same displacement everywhere: the box itself, moved, also beyond the grid.
  const Shift shift{{0.25, -0.1, 0}};
  const auto moved = shown_bounds_of({gridded(shift, 12)})(part);
  REQUIRE(moved.has_value());
  CHECK(glm::length(moved->low - (part.low + shift.offset)) < 1e-6); // displacements are floats
  CHECK(glm::length(moved->high - (part.high + shift.offset)) < 1e-6);
  // A twist: on the two axes that turn a cell's bounds grow by what displacements differ by in the grid's
  // cells that show it: at most (1/16 + 2·1.6/47)·|J − 1|, with 70° a unit at most 1/√2 from the axis, and
  // turned by 35°: |J − 1| < 1.1. So they are less than 1.6 times as long, where the exact map's own bounds
  // already are.
  const Twist twist{Axis::z, glm::dvec3(0.5), 70};
  const double held = volume_of_cells(shown_bounds_of({gridded(twist, 48)}));
  const double exact = volume_of_cells(shown_bounds_of({map_of(twist, unit, {})}));
  CHECK(held < 1.6 * 1.6 * exact);
}

TEST_CASE("parts are shown beyond the grid as its faces move") {
  const auto half = [](const glm::dvec3& p) { return glm::dvec3(0.5 + p.x / 2, p.y, p.z); };
  const GridMap map{
      std::make_shared<const MapGrid>(make_map_grid(half, {5, 5, 5}, glm::dvec3(0), glm::dvec3(1)))};
  const auto shown = shown_bounds(map, {glm::dvec3(0.1), glm::dvec3(0.2)});
  REQUIRE(shown.has_value());
  CHECK(shown->low.x == Approx(-0.4)); // u = p + 0.5
  CHECK(inside(*shown, {-0.3, 0.15, 0.15}, 0));
  CHECK(shown->high.x < 0);
}

TEST_CASE("what a map shows nowhere has no bounds") {
  // Displacements jump from 0 to 1 between nodes 2 and 3 of 5, and no weight shows x from 1.25 to 1.75 but
  // by the cell between them.
  GridFill fill = [](const std::array<std::size_t, 3>& n, const glm::dvec3&, const glm::dvec3&) {
    std::vector<glm::dvec3> offsets(n[0] * n[1] * n[2], glm::dvec3(0));
    for (std::size_t i = 0; i < offsets.size(); ++i)
      offsets[i].y = i % n[0] < 3 ? 0.0 : 1.0;
    return offsets;
  };
  const GridMap map{
      std::make_shared<const MapGrid>(make_map_grid(fill, {5, 5, 5}, glm::dvec3(0), glm::dvec3(1)))};
  const auto shown = shown_bounds(map, {{0.55, 0.4, 0.4}, {0.6, 0.5, 0.5}});
  REQUIRE(shown.has_value());
  CHECK(shown->low.x == Approx(0.55));
  CHECK(shown->high.x == Approx(0.6));
  CHECK(shown->low.y == Approx(-0.6)); // where the cell moves from 0 to 1
  CHECK(shown->high.y == Approx(0.5));
}
