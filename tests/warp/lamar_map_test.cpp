#include "catch.h"
#include "lens_cases.h"

using namespace slicelens;
using namespace lens_cases;

namespace {

double distance(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

/// How far p is from the places where a profile has a crease, in units of box space.
double crease_distance(const LensCase& c, const glm::dvec3& p) {
  const Across a = across_of(c, p);
  const double r = radius_of(c, a);
  const double d = std::abs(a.depth);
  double nearest = std::min({std::abs(r - c.lens.inner), std::abs(r - c.lens.outer),
                             std::abs(d - depth_inner(c.lens)), std::abs(d - depth_outer(c.lens))});
  if (c.lens.shape == LensShape::square)
    nearest = std::min(nearest, std::abs(std::abs(a.x) - std::abs(a.y)));
  return nearest;
}

template <class Real>
typename shared::LamarFunctions<Real>::LamarMap rounded(const LamarMap& map) {
  using Vec = glm::vec<3, Real>;
  typename shared::LamarFunctions<Real>::LamarMap r;
  r.center = Vec(map.center);
  r.axis = Vec(map.axis);
  r.forward = Vec(map.forward);
  r.right = Vec(map.right);
  r.up = Vec(map.up);
  r.center_depth = Real(map.center_depth);
  r.square = map.square;
  r.border = map.border;
  r.minification = Real(map.minification);
  r.inner = Real(map.inner);
  r.outer = Real(map.outer);
  r.depth_inner = Real(map.depth_inner);
  r.depth_outer = Real(map.depth_outer);
  return r;
}

} // namespace

TEST_CASE("box space: the longest edge is 1, circles stay circles") {
  const Box box = make_box({400, 200, 64}, {1, 2, 2}, {5, 6, 7}, glm::dmat3(1)); // 400 × 400 × 128
  const BoxSpace space = box_space(box);
  CHECK(space.longest == Approx(400));
  CHECK(distance(space.size, {1, 1, 0.32}) < 1e-15);
  CHECK(distance(box_from_texture(space, {0.5, 0.25, 0.5}), {0.5, 0.25, 0.16}) < 1e-15);
  CHECK(distance(texture_from_box(space, {0.5, 0.25, 0.16}), {0.5, 0.25, 0.5}) < 1e-15);
}

TEST_CASE("a view keeps its right angles in box space and its eye its place") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.3);
    RC_ASSERT(std::abs(glm::dot(c.warp.forward, c.warp.right)) < 1e-12);
    RC_ASSERT(std::abs(glm::dot(c.warp.forward, c.warp.up)) < 1e-12);
    RC_ASSERT(std::abs(glm::dot(c.warp.right, c.warp.up)) < 1e-12);
    const glm::dvec3 eye = world_from_texture(c.box, texture_from_box(c.space, c.warp.eye));
    RC_ASSERT(distance(eye, c.view.eye) < 1e-9 * glm::length(c.view.eye));
  }));
}

TEST_CASE("any lens is the map that its page describes") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.4);
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 p = random_point(c);
      RC_ASSERT(distance(texture_from_object(c.map, p), expected_texture(c, p)) < 1e-12);
    }
    // The axis is shown where it is, at every depth.
    const glm::dvec3 on_axis = point_at(c, random_in(-1, 1) * depth_outer(c.lens), 0, 0);
    RC_ASSERT(distance(texture_from_object(c.map, on_axis), on_axis) < 1e-12);
  }));
}

TEST_CASE("the identity outside the radius, outside the depths, and everywhere at zoom 1") {
  CHECK(rc::check([] {
    LensCase c = random_case(0.4);
    const double r = c.lens.outer * random_in(1.000001, 3);
    const double angle = random_in(0, 6.3);
    const double side = random_in(-1, 1);
    const glm::dvec3 beside =
        c.lens.shape == LensShape::circle
            ? point_at(c, random_in(-0.3, 0.3), r * std::cos(angle), r * std::sin(angle))
            : point_at(c, random_in(-0.3, 0.3), r * side, -r);
    RC_ASSERT(texture_from_object(c.map, beside) == beside);
    RC_ASSERT(jacobian(c.map, beside) == glm::dmat3(1));
    const glm::dvec3 behind = point_at(c, depth_outer(c.lens) * random_in(1.000001, 2), 0.01, 0.02);
    RC_ASSERT(texture_from_object(c.map, behind) == behind);
    c.map.minification = 1;
    const glm::dvec3 p = random_point(c);
    RC_ASSERT(distance(texture_from_object(c.map, p), p) <= 1e-12);
  }));
}

TEST_CASE("the forward map undoes the inverse one") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.4);
    for (int i = 0; i < 10; ++i) {
      const glm::dvec3 p = random_point(c);
      RC_ASSERT(distance(object_from_texture(c.map, texture_from_object(c.map, p)), p) < 1e-9);
      RC_ASSERT(distance(texture_from_object(c.map, object_from_texture(c.map, p)), p) < 1e-9);
    }
  }));
}

TEST_CASE("planes stay where they are: points move across the view only, along lines through the axis") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.4);
    const glm::dvec3 p = random_point(c);
    const Across before = across_of(c, p);
    const Across after = across_of(c, texture_from_object(c.map, p));
    RC_ASSERT(std::abs(before.depth - after.depth) < 1e-12);
    RC_ASSERT(std::abs(before.x * after.y - before.y * after.x) < 1e-12);
    RC_ASSERT(radius_of(c, after) <= radius_of(c, before) + 1e-12); // a magnifying lens looks inwards
  }));
}

TEST_CASE("no jump at any border of regions") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.4);
    const double h = 1e-9;
    // Steepest slope met: the simple border's 1 + outer·(Q − 1)/width ≤ 1 + .4·7/.05 = 57, and points are 2h
    // apart, so 1e-6 lets no visible jump through.
    const auto jump = [&](double d0, double x0, double y0, double d1, double x1, double y1) {
      return distance(texture_from_object(c.map, point_at(c, d0, x0, y0)),
                      texture_from_object(c.map, point_at(c, d1, x1, y1)));
    };
    const double d = random_in(-1, 1) * depth_outer(c.lens);
    const double side = random_in(-1, 1);
    const double s = c.lens.shape == LensShape::square ? 1 : 1 / std::hypot(1, side);
    for (const double r : {c.lens.inner, c.lens.outer}) {
      const double low = (r - h) * s;
      const double high = (r + h) * s;
      RC_ASSERT(jump(d, low, low * side, d, high, high * side) < 1e-6);
    }
    const double x = random_in(-1, 1) * c.lens.outer;
    const double y = random_in(-1, 1) * c.lens.outer;
    for (const double edge : {depth_inner(c.lens), depth_outer(c.lens)}) {
      RC_ASSERT(jump(edge - h, x, y, edge + h, x, y) < 1e-6);
      RC_ASSERT(jump(-edge - h, x, y, -edge + h, x, y) < 1e-6);
    }
    RC_ASSERT(jump(d, x - h, x, d, x + h, x) < 1e-6); // the square's diagonals
    RC_ASSERT(jump(d, x - h, -x, d, x + h, -x) < 1e-6);
    RC_ASSERT(jump(d, -h, h, d, h, -h) < 1e-6); // the axis
  }));
}

TEST_CASE("the Jacobian is the derivative of the map") {
  int inside = 0;
  int blended = 0;
  CHECK(rc::check([&] {
    const LensCase c = random_case(0.4);
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 p = random_point(c);
      if (crease_distance(c, p) < 1e-4)
        continue;
      const double h = 1e-6;
      glm::dmat3 differences;
      for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0);
        step[axis] = h;
        differences[axis] = (expected_texture(c, p + step) - expected_texture(c, p - step)) /
                            (2 * h); // the second writing of u
      }
      const glm::dmat3 exact = jacobian(c.map, p);
      double largest = 0;
      double error = 0;
      for (int column = 0; column < 3; ++column) {
        largest = std::max(largest, glm::length(exact[column]));
        error = std::max(error, glm::length(exact[column] - differences[column]));
      }
      RC_ASSERT(error <= 1e-5 * largest);
      const Across a = across_of(c, p);
      const bool in = radius_of(c, a) < c.lens.outer && std::abs(a.depth) < depth_outer(c.lens);
      inside += in;
      blended += in && std::abs(a.depth) > depth_inner(c.lens);
    }
  }));
  CHECK(inside > 200); // of 2000 points: the test did not look beside the lens only
  CHECK(blended > 50);
}

TEST_CASE("the Jacobian worked by hand in the zoom region") {
  LamarLens lens; // Q = 4, orthographic along y: across the view 1/4, along it 1
  const LensCase c = make_case(lens, Box{}, front_view());
  const glm::dmat3 j = jacobian(c.map, {0.55, 0.52, 0.47});
  glm::dmat3 expected(0.25);
  expected[1][1] = 1;
  for (int column = 0; column < 3; ++column)
    CHECK(distance(j[column], expected[column]) < 1e-15);
}

TEST_CASE("in single precision, as shaders compute it, the map is within 1e-5") {
  CHECK(rc::check([] {
    const LensCase c = random_case(0.3);
    const auto map = rounded<float>(c.map);
    shared::LamarFunctions<float> functions;
    for (int i = 0; i < 20; ++i) {
      const glm::dvec3 p = random_point(c);
      const glm::dvec3 single(functions.lamar_texture_from_object(map, glm::vec3(p)));
      RC_ASSERT(distance(single, texture_from_object(c.map, p)) < 1e-5);
    }
  }));
}

TEST_CASE("under perspective the outline is one circle in the picture, at every depth") {
  Box box = make_box({40, 30, 20}, {1, 1, 2}, {3, 4, 5}, glm::dmat3(1));
  View view = front_view();
  view.projection = Projection::perspective;
  view.eye = center(box) + glm::dvec3(-11, -70, 9);
  view.half_height = 0.5;
  LamarLens lens;
  lens.center = {0.6, 0.4, 0.3};
  lens.depth_outer = 0.4;
  const LensCase c = make_case(lens, box, view);
  const glm::dvec2 middle = pixel_from_world(view, world_from_texture(box, lens.center));
  // By similar triangles: radius in world units over the centre's depth, in tangents of half the picture.
  const double center_depth = depth(view, world_from_texture(box, lens.center));
  const double expected = lens.outer * 40 / center_depth / view.half_height * view.height / 2;
  for (const double z : {-0.3, -0.1, 0.0, 0.2, 0.35}) {
    for (int i = 0; i < 12; ++i) {
      const double angle = 0.5236 * i;
      const LensPlane plane = lens_plane(c.map, z);
      REQUIRE(plane.touched);
      const glm::dvec3 on_outline =
          plane.axis_point +
          plane.scale * lens.outer * (std::cos(angle) * c.map.right + std::sin(angle) * c.map.up);
      const auto pixel = [&](const glm::dvec3& b) {
        return pixel_from_world(view, world_from_texture(box, texture_from_box(c.space, b)));
      };
      CHECK(glm::length(pixel(on_outline) - middle) == Approx(expected).epsilon(1e-10));
      // It is the outline: a hair inside moves, a hair outside does not.
      const glm::dvec3 in = plane.axis_point + 0.99 * (on_outline - plane.axis_point);
      const glm::dvec3 out = plane.axis_point + 1.001 * (on_outline - plane.axis_point);
      CHECK(distance(texture_from_object(c.map, in), in) > 1e-6);
      CHECK(texture_from_object(c.map, out) == out);
      // The data moves towards the lens' own axis: in the picture straight to the middle.
      const glm::dvec3 half = plane.axis_point + 0.8 * (on_outline - plane.axis_point);
      const glm::dvec2 from = pixel(half) - middle;
      const glm::dvec2 to = pixel(texture_from_object(c.map, half)) - middle;
      CHECK(std::abs(from.x * to.y - from.y * to.x) < 1e-8 * glm::length(from) * glm::length(from));
    }
  }
}

TEST_CASE("in a 400 by 400 by 128 mm box the lens is a circle in the world") {
  const Box box = make_box({400, 400, 64}, {1, 1, 2}, {10, 20, 30}, glm::dmat3(1));
  const LamarLens lens; // radii .12 and .2 of 400 mm
  const LensCase c = make_case(lens, box, front_view());
  const glm::dvec3 middle = center(box);
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.5236 * i;
    const glm::dvec3 direction(std::cos(angle), 0, std::sin(angle));
    const auto shown = [&](double mm) {
      const glm::dvec3 t = glm::dvec3(texture_from_world(box) * glm::dvec4(middle + mm * direction, 1));
      const glm::dvec3 u = texture_from_object(c.map, box_from_texture(c.space, t));
      return distance(world_from_texture(box, texture_from_box(c.space, u)), middle);
    };
    CHECK(shown(40) == Approx(10));   // zoom region
    CHECK(shown(48) == Approx(12));   // its border at .12 · 400 mm
    CHECK(shown(79.9) < 79.9 - 1e-6); // still inside the outer radius of 80 mm
    CHECK(shown(80.1) == Approx(80.1));
  }
}
