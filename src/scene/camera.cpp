#include "scene/camera.h"

#include "core/errors.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace slicelens {

namespace {

void turn(View& view, double degrees, const glm::dvec3& axis) {
  const glm::dmat3 rotation(glm::rotate(glm::dmat4(1), glm::radians(degrees), axis));
  view.right = rotation * view.right;
  view.up = rotation * view.up;
  view.forward = rotation * view.forward;
}

/// Sets the frame that looks along `direction` with `view_up` upwards.
void look_along(View& view, const glm::dvec3& direction, const glm::dvec3& view_up) {
  const glm::dvec3 right = glm::cross(direction, view_up);
  if (!(glm::length(direction) > 0))
    throw UsageError("camera.position and camera.focal_point are the same point");
  if (!(glm::length(right) > 1e-9 * glm::length(direction) * glm::length(view_up))) {
    throw UsageError("camera.view_up is parallel to the viewing direction; give another one");
  }
  view.forward = glm::normalize(direction);
  view.right = glm::normalize(right);
  view.up = glm::cross(view.right, view.forward);
}

} // namespace

View make_view(const CameraSettings& camera, const Box& box, int width, int height) {
  const double radius = bounding_radius(box);
  const glm::dvec3 focal_point = camera.focal_point.value_or(center(box));
  const double half_angle = glm::radians(camera.view_angle) / 2;
  const bool perspective = camera.projection == ProjectionName::perspective;
  const double distance = perspective ? radius / std::sin(half_angle) : 2 * radius;

  View view;
  view.width = width;
  view.height = height;
  view.projection = perspective ? Projection::perspective : Projection::orthographic;
  view.half_height =
      perspective ? std::tan(half_angle / camera.zoom) : camera.parallel_scale.value_or(radius) / camera.zoom;

  if (camera.position) {
    look_along(view, focal_point - *camera.position, camera.view_up.value_or(glm::dvec3(0, 0, 1)));
    view.eye = *camera.position;
    return view;
  }
  look_along(view, {0, 1, 0}, camera.view_up.value_or(glm::dvec3(0, 0, 1)));
  turn(view, camera.azimuth, view.up);
  turn(view, camera.elevation, -view.right);
  turn(view, camera.roll, view.forward);
  view.eye = focal_point - distance * view.forward;
  return view;
}

} // namespace slicelens
