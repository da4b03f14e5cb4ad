#include "catch.h"
#include "core/errors.h"
#include "scene/camera.h"

using namespace slicelens;

namespace {

Box cube_of_two() {
  return make_box({2, 2, 2}, {1, 1, 1}, {10, 20, 30}, glm::dmat3(1));
} // centre (10.5, 20.5, 30.5)

void check_close(const glm::dvec3& a, const glm::dvec3& b) { CHECK(glm::length(a - b) < 1e-12); }

} // namespace

TEST_CASE("the default camera looks from the front: along +y, +z up, +x to the right, whole box in view") {
  const View view = make_view({}, cube_of_two(), 100, 100);
  check_close(view.forward, {0, 1, 0});
  check_close(view.up, {0, 0, 1});
  check_close(view.right, {1, 0, 0});
  CHECK(view.half_height == Approx(std::sqrt(3.0))); // half the diagonal of a cube of edge 2
  const glm::dvec2 middle = pixel_from_world(view, {10.5, 20.5, 30.5});
  CHECK(middle.x == Approx(50));
  CHECK(middle.y == Approx(50));
}

TEST_CASE("azimuth, elevation and roll turn as VTK's cameras do") {
  // VTK: Azimuth(90) from the front moves the eye to +x (right-hand rotation about view up).
  check_close(make_view({.azimuth = 90}, cube_of_two(), 10, 10).forward, {-1, 0, 0});
  // Elevation(90) moves the eye above; its picture's up is then +y, away from the former eye.
  const View above = make_view({.elevation = 90}, cube_of_two(), 10, 10);
  check_close(above.forward, {0, 0, -1});
  check_close(above.up, {0, 1, 0});
  // Roll(90) about the viewing direction +y takes +z to +x.
  check_close(make_view({.roll = 90}, cube_of_two(), 10, 10).up, {1, 0, 0});
}

TEST_CASE("perspective stands where the bounding sphere touches the view cone, and zoom divides the angle") {
  const View view = make_view({.projection = ProjectionName::perspective}, cube_of_two(), 10, 10);
  CHECK(depth(view, {10.5, 20.5, 30.5}) == Approx(std::sqrt(3.0) / std::sin(glm::radians(15.0))));
  CHECK(view.half_height == Approx(std::tan(glm::radians(15.0))));
  const View zoomed =
      make_view({.zoom = 2, .projection = ProjectionName::perspective}, cube_of_two(), 10, 10);
  CHECK(zoomed.half_height == Approx(std::tan(glm::radians(7.5))));
  CHECK(make_view({.zoom = 2}, cube_of_two(), 10, 10).half_height == Approx(std::sqrt(3.0) / 2));
}

TEST_CASE("an explicit camera is taken as given and impossible ones are refused") {
  CameraSettings camera;
  camera.position = glm::dvec3(10.5, 20.5, 100);
  camera.view_up = glm::dvec3(0, -1, 0);
  check_close(make_view(camera, cube_of_two(), 10, 10).forward, {0, 0, -1});
  camera.view_up = glm::dvec3(0, 0, 1);
  CHECK_THROWS_AS(make_view(camera, cube_of_two(), 10, 10), UsageError);
  camera.position = glm::dvec3(10.5, 20.5, 30.5);
  CHECK_THROWS_AS(make_view(camera, cube_of_two(), 10, 10), UsageError);
}
