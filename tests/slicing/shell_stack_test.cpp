// Polygons that cover spherical shells about the eye.
#include "catch.h"
#include "core/errors.h"
#include "slicing/shell_stack.h"

#include <rapidcheck.h>

#include <cmath>

using namespace slicelens;

namespace {

double fraction(double low, double high) {
  return low + (high - low) * static_cast<double>(*rc::gen::inRange(0, 1'000'000)) / 1e6;
}

glm::dvec3 direction() {
  const double azimuth = fraction(0, 6.28);
  const double z = fraction(-0.95, 0.95);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}

View view_from(const glm::dvec3& eye, const glm::dvec3& forward, double tangent) {
  View view;
  view.projection = Projection::perspective;
  view.eye = eye;
  view.forward = forward;
  view.right = glm::normalize(glm::cross(forward, glm::dvec3(0, 0, 1)));
  view.up = glm::cross(view.right, forward);
  view.half_height = tangent;
  view.width = 40;
  view.height = 30;
  return view;
}

/// Whether (x, y) lies in the polygon, whose corners go round either way.
bool holds(const std::vector<glm::dvec2>& polygon, const glm::dvec2& p) {
  int left = 0;
  int right = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i];
    const glm::dvec2 b = polygon[(i + 1) % polygon.size()];
    const double side = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    ++(side >= 0 ? left : right);
  }
  return left == 0 || right == 0;
}

} // namespace

TEST_CASE("the hull of a square with points inside is the square") {
  const Polygon hull =
      convex_hull({{0, 0, 0}, {1, 1, 0}, {0.5, 0.5, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {1, 1, 0}});
  CHECK(hull.size() == 4);
  CHECK(area(hull) == Approx(1));
  CHECK(convex_hull({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}).size() < 3);
}

TEST_CASE("every sample of every ray lies in the polygon of its shell", "[property]") {
  REQUIRE(rc::check([] {
    SliceRequest request;
    request.box.world_from_texture = glm::dmat4(glm::dvec4(2, 0, 0, 0), glm::dvec4(0.3, 1, 0, 0),
                                                glm::dvec4(0, 0.1, 1.5, 0), glm::dvec4(-1, -0.5, -0.7, 1));
    request.low = glm::dvec3(fraction(-0.3, 0));
    request.high = glm::dvec3(fraction(1, 1.3));
    request.spacing = fraction(0.05, 0.3);
    // From outside, from inside, and past the box.
    const glm::dvec3 forward = direction();
    request.view = view_from(fraction(-4, 4) * direction(), forward, fraction(0.1, 2));
    const double plane_depth = fraction(0.5, 3);
    const SliceStack stack = make_shell_stack(request, plane_depth);

    const View& view = request.view;
    const double anchor = glm::length(view.eye - center(request.box));
    const glm::dmat4 to_texture = texture_from_world(request.box);
    for (int i = 0; i < 40; ++i) {
      const glm::dvec2 pixel(fraction(0, view.width), fraction(0, view.height));
      const Ray ray = ray_from_pixel(view, pixel.x, pixel.y);
      const auto k = *rc::gen::inRange<std::int64_t>(-60, 60);
      const double radius = anchor + (static_cast<double>(k) + 0.5) * request.spacing;
      const glm::dvec3 t(to_texture * glm::dvec4(view.eye + radius * ray.direction, 1));
      if (radius < 1e-2 || glm::any(glm::lessThan(t, request.low)) ||
          glm::any(glm::greaterThan(t, request.high)))
        continue;
      const auto slice = std::find_if(stack.slices.begin(), stack.slices.end(),
                                      [&](const Slice& s) { return s.index == k; });
      RC_ASSERT(slice != stack.slices.end());
      RC_ASSERT(slice->distance == Approx((static_cast<double>(k) + 0.5) * request.spacing));
      std::vector<glm::dvec2> polygon;
      for (std::uint32_t c = 0; c < slice->count; ++c) {
        const glm::dvec3 world = world_from_texture(request.box, stack.corners[slice->first + c]);
        RC_ASSERT(depth(view, world) == Approx(plane_depth));
        polygon.push_back(pixel_from_world(view, world));
      }
      RC_ASSERT(holds(polygon, pixel));
    }
  }));
}

TEST_CASE("shells come in drawing order, and none for a box behind the eye") {
  SliceRequest request;
  request.spacing = 0.1;
  request.view = view_from({0.5, -2, 0.5}, {0, 1, 0}, 0.5);
  const SliceStack back = make_shell_stack(request, 2);
  REQUIRE(back.slices.size() > 10);
  CHECK(back.slices.front().index > back.slices.back().index);
  request.order = SliceOrder::front_to_back;
  CHECK(make_shell_stack(request, 2).slices.front().index == back.slices.back().index);
  // Between the nearest face at 2 − 1/2 and the farthest corner: no more shells than fit.
  CHECK(back.slices.size() <= 1 + static_cast<std::size_t>(std::ceil((std::sqrt(9 + 0.5) - 2) / 0.1)));
  request.view.forward = {0, -1, 0};
  CHECK(make_shell_stack(request, 2).slices.empty());
  request.spacing = 1e-9;
  request.view.forward = {0, 1, 0};
  CHECK_THROWS_AS(make_shell_stack(request, 2), UsageError);
}
