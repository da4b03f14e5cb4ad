#include "catch.h"
#include "core/errors.h"
#include "slicing/slice_stack.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <limits>

using namespace slicelens;

namespace {

SliceRequest front_view_of_unit_cube(double spacing) {
  SliceRequest request;
  request.view.eye = {0.5, -3, 0.5};
  request.view.right = {1, 0, 0};
  request.view.up = {0, 0, 1};
  request.view.forward = {0, 1, 0};
  request.spacing = spacing;
  return request;
}

/// World-space area of slice `slice`.
double world_area(const SliceRequest& request, const SliceStack& stack, const Slice& slice) {
  Polygon polygon;
  for (std::uint32_t i = 0; i < slice.count; ++i) {
    polygon.push_back(world_from_texture(request.box, stack.corners[slice.first + i]));
  }
  return area(polygon);
}

double swept_volume(const SliceRequest& request) {
  const SliceStack stack = make_slice_stack(request);
  double sum = 0;
  for (const Slice& slice : stack.slices)
    sum += world_area(request, stack, slice) * request.spacing;
  return sum;
}

/// The frame turned by `rotation`, about the origin.
View rotated(const View& view, const glm::dmat3& rotation) {
  View result = view;
  result.eye = rotation * view.eye;
  result.right = rotation * view.right;
  result.up = rotation * view.up;
  result.forward = rotation * view.forward;
  return result;
}

const glm::dmat3 oblique =
    glm::dmat3(glm::rotate(glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(0, 0, 1)), -0.4, glm::dvec3(1, 0, 0)));

} // namespace

TEST_CASE("planes sit half a spacing beside the box centre and come in the order asked for") {
  SliceRequest request = front_view_of_unit_cube(0.25);
  const SliceStack back = make_slice_stack(request);
  REQUIRE(back.slices.size() == 4);
  // Distances from the centre ±.125 and ±.375; the farthest first.
  CHECK(back.slices[0].distance == Approx(0.375));
  CHECK(back.slices[3].distance == Approx(-0.375));
  CHECK(back.slices[0].index == 1);
  for (std::uint32_t i = 0; i < back.slices[0].count; ++i) {
    CHECK(back.corners[back.slices[0].first + i].y == Approx(0.875)); // texture y of the farthest plane
  }
  request.order = SliceOrder::front_to_back;
  const SliceStack front = make_slice_stack(request);
  REQUIRE(front.slices.size() == 4);
  CHECK(front.slices[0].distance == Approx(-0.375));
}

TEST_CASE("a spacing larger than the box leaves the planes beside the centre, if they still cut") {
  CHECK(make_slice_stack(front_view_of_unit_cube(0.9)).slices.size() == 2); // at ±.45
  CHECK(make_slice_stack(front_view_of_unit_cube(1.2)).slices.empty());     // at ±.6
}

TEST_CASE("areas times spacing sum to the volume, to second order in the spacing") {
  SliceRequest request = front_view_of_unit_cube(0.1);
  request.box = make_box({40, 30, 20}, {0.1, 0.2, 0.15}, {1, 2, 3}, glm::dmat3(1));
  request.view = rotated(request.view, oblique);
  const double volume = 4.0 * 6.0 * 3.0;
  // The cut area is piecewise quadratic and continuous in the plane's distance for a general direction, so
  // the midpoint rule is of second order: halving the spacing divides the error by about four.
  std::vector<double> errors;
  for (const double spacing : {0.4, 0.1, 0.025}) {
    request.spacing = spacing;
    errors.push_back(std::abs(swept_volume(request) - volume) / volume);
  }
  CHECK(errors[1] < errors[0]);
  CHECK(errors[2] < 2e-5);
}

TEST_CASE("turning camera and box together changes nothing") {
  SliceRequest request = front_view_of_unit_cube(0.07);
  request.box = make_box({4, 3, 2}, {0.3, 0.2, 0.4}, {-0.5, -0.3, -0.2}, glm::dmat3(1));
  request.view = rotated(request.view, oblique);
  const SliceStack before = make_slice_stack(request);
  const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 1.1, glm::normalize(glm::dvec3(1, 2, 3)));
  request.box.world_from_texture = turn * request.box.world_from_texture;
  request.view = rotated(request.view, glm::dmat3(turn));
  const SliceStack after = make_slice_stack(request);
  REQUIRE(after.slices.size() == before.slices.size());
  REQUIRE(after.corners.size() == before.corners.size());
  for (std::size_t i = 0; i < before.corners.size(); ++i) {
    CHECK(glm::length(after.corners[i] - before.corners[i]) < 1e-12);
  }
}

TEST_CASE("every polygon lies on its plane, in both projections") {
  SliceRequest request = front_view_of_unit_cube(0.05);
  request.view = rotated(request.view, oblique);
  for (const Projection projection : {Projection::orthographic, Projection::perspective}) {
    request.view.projection = projection;
    const SliceStack stack = make_slice_stack(request);
    const double anchor = depth(request.view, center(request.box));
    REQUIRE_FALSE(stack.slices.empty());
    for (const Slice& slice : stack.slices) {
      for (std::uint32_t i = 0; i < slice.count; ++i) {
        const glm::dvec3 world = world_from_texture(request.box, stack.corners[slice.first + i]);
        CHECK(depth(request.view, world) - anchor == Approx(slice.distance).margin(1e-12));
      }
    }
  }
}

TEST_CASE("with the eye inside the box only planes in front of it are cut") {
  SliceRequest request = front_view_of_unit_cube(0.1);
  request.view.projection = Projection::perspective;
  request.view.eye = {0.5, 0.32, 0.5};
  const SliceStack stack = make_slice_stack(request);
  CHECK(stack.slices.size() == 7); // texture y = .35, .45 … .95
}

TEST_CASE("clipping planes cut the stack in texture space") {
  SliceRequest request = front_view_of_unit_cube(0.25);
  request.clip = {{{1, 0, 0}, 0.5}, {{0, -1, 0}, -0.5}}; // x ≥ ½ and y ≤ ½
  const SliceStack stack = make_slice_stack(request);
  REQUIRE(stack.slices.size() == 2);
  for (const glm::dvec3& corner : stack.corners) {
    CHECK(corner.x >= 0.5);
    CHECK(corner.y <= 0.5);
  }
}

TEST_CASE("impossible spacings are refused") {
  for (const double spacing : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-12}) {
    CHECK_THROWS_AS(make_slice_stack(front_view_of_unit_cube(spacing)), UsageError);
  }
}

TEST_CASE("samples on an oblique perspective ray are 1/cos apart") {
  View view;
  view.projection = Projection::perspective;
  view.width = view.height = 2;
  view.half_height = 1; // 90° view angle
  CHECK(sample_distance_ratio(view, 1, 1) == Approx(1));
  CHECK(sample_distance_ratio(view, 2, 1) == Approx(std::sqrt(2.0)));
  CHECK(sample_distance_ratio(view, 2, 2) == Approx(std::sqrt(3.0)));
  view.projection = Projection::orthographic;
  CHECK(sample_distance_ratio(view, 2, 2) == 1);
}
