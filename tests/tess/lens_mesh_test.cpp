#include "catch.h"
#include "mesh_checks.h"

using namespace mesh_checks;

namespace {

/// A random depth at which the lens is there, sometimes beyond.
double random_depth(const LensCase& c) { return random_in(-1.1, 1.1) * depth_outer(c.lens); }

/// A lens well inside the unit box, seen from the front: footprint from .25 to .75.
LensCase inside_case() {
  LamarLens lens;
  lens.inner = 0.12;
  lens.outer = 0.25;
  lens.depth_inner = 0.1;
  lens.depth_outer = 0.3;
  return make_case(lens, Box{}, front_view());
}

} // namespace

TEST_CASE("the triangles cover a slice once and show the tessellated map: random lenses, boxes, planes") {
  int inside = 0;
  CHECK(rc::check([&] {
    const LensCase c = random_case(0.5);
    const double z = random_depth(c);
    const Polygon polygon = slice_at(c, z);
    const LensMesh mesh = tessellate_slice(polygon, {prepare(c)}, c.space, {});
    if (polygon.empty()) {
      RC_ASSERT(mesh.triangles.empty());
      return;
    }
    RC_ASSERT(mesh.triangles.size() == 3 * mesh.regions.size());
    for (int i = 0; i < 40; ++i) {
      // Half the points in and beside the lens, half anywhere on the plane.
      const double reach = i % 2 == 0 ? 1.6 * c.lens.outer : 1.2;
      const glm::dvec3 p = point_at(c, z, random_in(-reach, reach), random_in(-reach, reach));
      const std::string wrong =
          wrong_at(mesh, texture_from_box(c.space, p), texture_from_box(c.space, tessellated_texture(c, p)));
      if (!wrong.empty())
        RC_FAIL(wrong);
      inside += !mesh.triangles.empty();
    }
  }));
  CHECK(inside > 1000);
}

TEST_CASE("corners are shared: no T-junction, no triangle without area, random lenses, boxes, planes") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.5);
    const std::string wrong = wrong_corners(mesh_at(c, random_depth(c)));
    if (!wrong.empty())
      RC_FAIL(wrong);
  }));
}

TEST_CASE("a lens inside the box: the triangles' areas sum to the polygon's") {
  int tried = 0;
  CHECK(rc::check([&] {
    LensCase c = random_case(0.12);
    c.lens.center = {random_in(0.45, 0.55), random_in(0.45, 0.55), random_in(0.45, 0.55)};
    c = make_case(c.lens, c.box, c.view);
    const double z = random_in(-1, 1) * std::min(0.1, depth_outer(c.lens));
    const Polygon polygon = slice_at(c, z);
    for (const glm::dvec2& corner :
         {glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(1, -1), glm::dvec2(-1, -1)}) {
      const glm::dvec2 at = 1.01 * c.lens.outer * corner;
      const glm::dvec3 t = texture_from_box(c.space, point_at(c, z, at.x, at.y));
      if (glm::any(glm::lessThan(t, glm::dvec3(0))) || glm::any(glm::greaterThan(t, glm::dvec3(1))))
        return; // reaches beyond a thin box
    }
    ++tried;
    RC_ASSERT(std::abs(total_area(mesh_at(c, z)) - area(polygon)) < 1e-12);
  }));
  CHECK(tried > 20);
}

TEST_CASE("both triangulations of the switch cover the slice, homogeneous or not") {
  for (const bool homogeneous : {true, false}) {
    LensCase c = inside_case();
    c.lens.homogeneous = homogeneous;
    CHECK(total_area(mesh_at(c, 0.05)) == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("magnified data beyond the box's outline is kept") {
  // The lens' centre .05 inside the face x = 1, Q = 4, r_i = .2: the face is shown at .95 + 4·.05 = 1.15.
  LamarLens lens;
  lens.shape = LensShape::square;
  lens.border = LensBorder::linear;
  lens.center = {0.95, 0.5, 0.5};
  lens.inner = 0.2;
  lens.outer = 0.4;
  const LensCase c = make_case(lens, Box{}, front_view());
  const LensMesh mesh = mesh_at(c, 0);
  double farthest = 0;
  for (const LensVertex& vertex : mesh.vertices) {
    farthest = std::max(farthest, vertex.position.x);
    const glm::dvec3 t = glm::dvec3(vertex.texture) / vertex.texture.w;
    for (int axis = 0; axis < 3; ++axis)
      CHECK((t[axis] >= -1e-12 && t[axis] <= 1 + 1e-12));
  }
  CHECK(farthest == Approx(1.15).epsilon(1e-12));
  CHECK(wrong_corners(mesh).empty());
}

TEST_CASE("zoom 1 maps every corner to itself, without a special case") {
  CHECK(rc::check([] {
    LensCase c = random_case(0.4);
    c.lens.zoom = 1;
    c = make_case(c.lens, c.box, c.view);
    for (const LensVertex& vertex : mesh_at(c, random_depth(c)).vertices)
      RC_ASSERT(glm::length(glm::dvec3(vertex.texture) / vertex.texture.w - vertex.position) <= 1e-12);
  }));
}

TEST_CASE("a plane that the lens does not touch stays one polygon with its own corners") {
  const auto same = [](const LensMesh& mesh, const Polygon& polygon) {
    REQUIRE(mesh.vertices.size() == polygon.size());
    CHECK(mesh.regions == std::vector<LensRegion>(polygon.size() - 2, LensRegion::normal));
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      CHECK(mesh.vertices[i].position == polygon[i]);
      CHECK(mesh.vertices[i].texture == glm::dvec4(polygon[i], 1));
    }
  };
  LensCase c = inside_case();
  for (const double z : {-0.45, -0.3, 0.3, 0.4})
    same(mesh_at(c, z), slice_at(c, z));
  // Beside it: the lens is at the plane's depth, but its footprint ends before the slice begins.
  for (const bool bounded : {true, false}) {
    for (const glm::dvec3& beside : {glm::dvec3(0.5, 0.5, 1.26), glm::dvec3(-0.26, 0.5, 0.5),
                                     glm::dvec3(1.3, 0.5, 0.9), glm::dvec3(0.5, 0.5, -0.3)}) {
      c.lens.center = beside;
      c.lens.bounded = bounded;
      c = make_case(c.lens, c.box, c.view);
      same(mesh_at(c, 0), slice_at(c, 0));
    }
  }
  CHECK(tessellate_slice({}, {prepare(inside_case())}, c.space, {}).vertices.empty());
}

TEST_CASE("no more pieces than the method needs") {
  LensCase c = inside_case();
  const auto count = [](const LensMesh& mesh, LensRegion region) {
    return std::count(mesh.regions.begin(), mesh.regions.end(), region);
  };
  const LensMesh bounded = mesh_at(c, 0);
  CHECK(count(bounded, LensRegion::zoom) == 30);           // a polygon of 32 corners
  CHECK(count(bounded, LensRegion::border) == 2 * 32 * 8); // quads
  c.lens.shape = LensShape::square;
  const LensMesh square = mesh_at(c, 0);
  CHECK(count(square, LensRegion::zoom) == 2);
  CHECK(count(square, LensRegion::border) == 2 * 4 * 8);
  // Four trapezoids between the square's edges and those of the slice around it.
  CHECK(count(square, LensRegion::normal) == 2 * 4);
  c.lens.border = LensBorder::simple; // always one radial segment
  CHECK(count(mesh_at(c, 0), LensRegion::border) == 2 * 4);
}

TEST_CASE("regions are those of Figure 7: a plane in the warp depths has no zoom region") {
  const LensCase c = inside_case(); // depths .1 and .3, radii .12 and .25
  const auto region_at = [&](double z, double x) -> std::optional<LensRegion> {
    const LensMesh mesh = mesh_at(c, z);
    const glm::dvec3 p = point_at(c, z, x, 0.0123 * x);
    for (std::size_t i = 0; i < mesh.regions.size(); ++i) {
      const auto weights = barycentric(corners_of(mesh, i), p);
      if (weights && std::min({weights->x, weights->y, weights->z}) > 0)
        return mesh.regions[i];
    }
    return std::nullopt;
  };
  for (const double z : {-0.05, 0.02, 0.099}) {
    CHECK(region_at(z, 0.05) == LensRegion::zoom);
    CHECK(region_at(z, 0.2) == LensRegion::border);
    CHECK(region_at(z, 0.24) == LensRegion::border);
    CHECK(region_at(z, 0.2495) ==
          LensRegion::border); // the ring's chord reaches .25·cos(π/32) at least: .2488
    CHECK(region_at(z, 0.4) == LensRegion::normal);
  }
  for (const double z : {-0.2, 0.101, 0.29}) {
    CHECK(region_at(z, 0.05) == LensRegion::border);
    CHECK(region_at(z, 0.2) == LensRegion::border);
    CHECK(region_at(z, 0.4) == LensRegion::normal);
  }
  CHECK(region_at(0.31, 0.05) == LensRegion::normal);
}
