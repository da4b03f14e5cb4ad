// Laws of every warp in the list of warps: a new one is held to them by being listed.
#include "catch.h"
#include "warp/axis_tables.h"
#include "warp_cases.h"

using namespace slicelens;
using namespace warp_cases;

namespace {

double largest_entry(const glm::dmat3& m) {
  double largest = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row)
      largest = std::max(largest, std::abs(m[column][row]));
  }
  return largest;
}

/// Whether the derivative changes suddenly near p: a crease or a jump within 2e-4.
template <class Map>
bool near_crease(const Map& map, const glm::dvec3& p) {
  const glm::dmat3 here = jacobian(map, p);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double h : {-2e-4, -5e-5, 5e-5, 2e-4}) {
      glm::dvec3 beside = p;
      beside[axis] += h;
      if (largest_entry(jacobian(map, beside) - here) > 0.03 * largest_entry(here))
        return true;
    }
  }
  return false;
}

/// Whether differences at p straddle a face between cells of a map on a grid, whose derivative may jump there
/// by less than near_crease sees.
bool near_cell_face(const WarpMap& map, const glm::dvec3& p) {
  const auto* held = std::get_if<GridMap>(&map);
  if (held == nullptr)
    return false;
  const MapGrid& grid = *held->grid;
  const glm::dvec3 cells(grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1);
  const glm::dvec3 x = (p - grid.low) / (grid.high - grid.low) * cells;
  const glm::dvec3 off = glm::abs(x - glm::round(x)) * (grid.high - grid.low) / cells;
  return std::min({off.x, off.y, off.z}) <
         5e-5; // slopes of maps before it, at most some 20, widen the step of 1e-6
}

bool near_cell_face(const std::vector<WarpMap>& maps, const glm::dvec3& p) {
  glm::dvec3 u = p;
  for (auto map = maps.rbegin(); map != maps.rend(); ++map) {
    if (near_cell_face(*map, u))
      return true;
    u = texture_from_object(*map, u);
  }
  return false;
}

template <class Map>
glm::dmat3 differences(const Map& map, const glm::dvec3& p) {
  // Where only the second derivative jumps (inner edges of lenses, by at most 2·800) they are off by 4e-5.
  const double h = 1e-7;
  glm::dmat3 result;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 step(0);
    step[axis] = h;
    result[axis] = (texture_from_object(map, p + step) - texture_from_object(map, p - step)) / (2 * h);
  }
  return result;
}

std::vector<WarpMap> random_chain(BoxSpace& space) {
  const Box box = lens_cases::random_box();
  const WarpView view = warp_view(lens_cases::random_view(box), box);
  space = box_space(box);
  std::vector<WarpMap> maps;
  const int count = *rc::gen::inRange(2, 4);
  for (int i = 0; i < count; ++i) {
    const auto kind =
        static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(warp_infos().size())));
    maps.push_back(map_of(random_warp(warp_infos()[kind].kind, space), space, view));
  }
  return maps;
}

/// Whether each map of the list is handed a point of the volume, away from its cuts: what all of them show.
bool stays_shown(const std::vector<WarpMap>& maps, const BoxSpace& space, glm::dvec3 u) {
  for (const WarpMap& map : maps) {
    if (has_cuts(map) && !in_box(space, u))
      return false;
    u = object_from_texture(map, u);
    if (near_cut(map, u, 1e-9))
      return false;
  }
  return true;
}

} // namespace

TEST_CASE("every listed warp can be made, is valid, and names at least the pipelines that show it exactly") {
  for (const WarpInfo& info : warp_infos()) {
    INFO(info.kind);
    const std::optional<Warp> warp = make_warp(info.kind);
    REQUIRE(warp);
    CHECK(kind_of(*warp) == info.kind);
    CHECK(rc::check([&] { validate(default_warp(info.kind)); }));
    CHECK_FALSE(info.description.empty());
    for (const char* pipeline : {"fragment", "rays", "reference"})
      CHECK(std::count(info.pipelines.begin(), info.pipelines.end(), pipeline) == 1);
    const bool by_axis = std::count(info.pipelines.begin(), info.pipelines.end(), "axis") == 1;
    CHECK(is_separable(*warp) == by_axis);
  }
  CHECK_FALSE(make_warp("no such warp"));
}

TEST_CASE("every warp: forward and inverse undo each other") {
  for (const WarpInfo& info : warp_infos()) {
    INFO(info.kind);
    CHECK(rc::check([&] {
      const WarpCase c = warp_cases::random_case(info.kind);
      for (int i = 0; i < 10; ++i) {
        const glm::dvec3 p = random_point(c.space);
        // The bar is 1e-6; closed forms and bisection come to rounding. Where a cut leaves a gap nothing is
        // shown; all of the volume is, but on the cut itself rounding chooses the side.
        const glm::dvec3 u = texture_from_object(c.map, p);
        if (!is_nowhere(u))
          RC_ASSERT(glm::length(object_from_texture(c.map, u) - p) < 1e-6);
        const glm::dvec3 shown = object_from_texture(c.map, p);
        if (has_cuts(c.map) && (!in_box(c.space, p) || near_cut(c.map, shown, 1e-9)))
          continue;
        RC_ASSERT(glm::length(texture_from_object(c.map, shown) - p) < 1e-6);
      }
    }));
  }
}

TEST_CASE("every warp: the Jacobian is the derivative of the map, and does not fold") {
  for (const WarpInfo& info : warp_infos()) {
    INFO(info.kind);
    int checked = 0;
    int moved = 0;
    CHECK(rc::check([&] {
      const WarpCase c = warp_cases::random_case(info.kind);
      for (int i = 0; i < 20; ++i) {
        const glm::dvec3 p = random_point(c.space);
        const glm::dmat3 exact = jacobian(c.map, p);
        RC_ASSERT(glm::determinant(exact) > 0);
        if (near_crease(c.map, p) || near_cut(c.map, p, 1e-5) || near_cell_face(c.map, p))
          continue;
        RC_ASSERT(largest_entry(exact - differences(c.map, p)) <= 1e-4 * largest_entry(exact));
        ++checked;
        moved += texture_from_object(c.map, p) != p;
      }
    }));
    CHECK(checked > 1000); // of 2000: most points are away from creases
    CHECK(moved > 50);     // and not all beside the lens
  }
}

TEST_CASE("every warp: continuous but at its declared cuts") {
  for (const WarpInfo& info : warp_infos()) {
    INFO(info.kind);
    int checked = 0;
    CHECK(rc::check([&] {
      const WarpCase c = warp_cases::random_case(info.kind);
      for (int i = 0; i < 20; ++i) {
        const glm::dvec3 p = random_point(c.space);
        const glm::dvec3 beside = p + 1e-7 * lens_cases::random_direction();
        if (near_cut(c.map, p, 1e-6))
          continue;
        // Slopes stay below some hundred here; jumps are wider.
        RC_ASSERT(glm::length(texture_from_object(c.map, beside) - texture_from_object(c.map, p)) < 1e-4);
        ++checked;
      }
      RC_ASSERT(has_cuts(c.map) || !near_cut(c.map, random_point(c.space), 1));
    }));
    CHECK(checked > 1900); // of 2000: cuts are thin
  }
}

TEST_CASE("every warp of bounded support: the identity far outside the volume") {
  for (const WarpInfo& info : warp_infos()) {
    if (!has_bounded_support(*make_warp(info.kind)))
      continue;
    INFO(info.kind);
    CHECK(rc::check([&] {
      const WarpCase c = warp_cases::random_case(info.kind);
      glm::dvec3 p;
      for (int axis = 0; axis < 3; ++axis)
        p[axis] = lens_cases::random_bool() ? random_in(2, 3) : random_in(-3, -2);
      RC_ASSERT(glm::length(texture_from_object(c.map, p) - p) <= 1e-13);
      RC_ASSERT(jacobian(c.map, p) == glm::dmat3(1));
    }));
  }
}

TEST_CASE("every separable warp: the volume fills its own box, and its faces stay in place") {
  for (const WarpInfo& info : warp_infos()) {
    if (!is_separable(*make_warp(info.kind)))
      continue;
    INFO(info.kind);
    CHECK(rc::check([&] {
      const WarpCase c = warp_cases::random_case(info.kind);
      const glm::dvec3 p = c.space.size * glm::dvec3(random_in(0, 1), random_in(0, 1), random_in(0, 1));
      const glm::dvec3 u = texture_from_object(c.map, p);
      for (int axis = 0; axis < 3; ++axis) {
        RC_ASSERT((u[axis] >= -1e-13 && u[axis] <= c.space.size[axis] + 1e-13));
        for (const double end : {0.0, c.space.size[axis]}) {
          glm::dvec3 face = p;
          face[axis] = end;
          RC_ASSERT(std::abs(texture_from_object(c.map, face)[axis] - end) <= 1e-13);
        }
      }
      RC_ASSERT(focus_region(c.warp).has_value());
    }));
  }
}

TEST_CASE("every separable warp: its axes' samples are its map") {
  for (const WarpInfo& info : warp_infos()) {
    if (!is_separable(*make_warp(info.kind)))
      continue;
    INFO(info.kind);
    CHECK(rc::check([&] {
      const WarpCase c = warp_cases::random_case(info.kind);
      const glm::dvec3 p = random_point(c.space);
      const glm::dvec3 t = texture_from_box(c.space, p);
      glm::dvec3 offset;
      double mask = 1;
      for (int axis = 0; axis < 3; ++axis) {
        const AxisSample sample = sample_axis(c.warp, axis, t[axis]);
        RC_ASSERT((sample.mask >= 0 && sample.mask <= 1));
        offset[axis] = sample.texture - t[axis];
        mask *= sample.mask;
      }
      const glm::dvec3 expected = box_from_texture(c.space, t + mask * offset);
      RC_ASSERT(glm::length(texture_from_object(c.map, p) - expected) < 1e-13);
    }));
  }
}

TEST_CASE("a list of warps is their composition, and can be undone") {
  int checked = 0;
  CHECK(rc::check([&] {
    BoxSpace space;
    const std::vector<WarpMap> maps = random_chain(space);
    for (int i = 0; i < 10; ++i) {
      const glm::dvec3 p = random_point(space);
      glm::dvec3 u = p;
      for (auto map = maps.rbegin(); map != maps.rend();
           ++map) // the last one is applied first, from display to data
        u = texture_from_object(*map, u);
      RC_ASSERT(texture_from_object(maps, p) == u);
      if (is_nowhere(u))
        continue;
      RC_ASSERT(glm::length(object_from_texture(maps, u) - p) < 1e-6);
      if (stays_shown(maps, space, p))
        RC_ASSERT(glm::length(texture_from_object(maps, object_from_texture(maps, p)) - p) < 1e-6);
      if (near_crease(maps, p) || near_cut(maps, p, 1e-5) || near_cell_face(maps, p))
        continue;
      const glm::dmat3 exact = jacobian(maps, p);
      RC_ASSERT(largest_entry(exact - differences(maps, p)) <= 1e-3 * largest_entry(exact));
      ++checked;
    }
  }));
  CHECK(checked > 300);
}
