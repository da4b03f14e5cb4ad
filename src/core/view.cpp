#include "core/view.h"

namespace slicelens {

double half_width(const View& view) { return view.half_height * view.width / view.height; }

double depth(const View& view, const glm::dvec3& world) { return glm::dot(world - view.eye, view.forward); }

Ray ray_from_pixel(const View& view, double x, double y) {
  const double u = (2.0 * x / view.width - 1.0) * half_width(view);
  const double v = (1.0 - 2.0 * y / view.height) * view.half_height;
  const glm::dvec3 offset = u * view.right + v * view.up;
  if (view.projection == Projection::orthographic)
    return {view.eye + offset, view.forward};
  return {view.eye, glm::normalize(view.forward + offset)};
}

glm::dvec3 towards_viewer(const View& view, const glm::dvec3& world) {
  if (view.projection == Projection::orthographic)
    return -view.forward;
  return glm::normalize(view.eye - world);
}

glm::dmat4 clip_from_world(const View& view, double near, double far) {
  const double sx = 1.0 / half_width(view);
  const double sy = 1.0 / view.half_height;
  // Rows of the map from world to (x, y, depth), depth positive in front of the eye.
  const glm::dvec4 x(view.right, -glm::dot(view.right, view.eye));
  const glm::dvec4 y(view.up, -glm::dot(view.up, view.eye));
  const glm::dvec4 z(view.forward, -glm::dot(view.forward, view.eye));
  const glm::dvec4 one(0, 0, 0, 1);
  glm::dmat4 rows;
  rows[0] = sx * x;
  rows[1] = sy * y;
  if (view.projection == Projection::orthographic) {
    rows[2] = (2.0 * z - (near + far) * one) / (far - near);
    rows[3] = one;
  } else {
    rows[2] = ((far + near) * z - 2.0 * far * near * one) / (far - near);
    rows[3] = z;
  }
  return glm::transpose(rows);
}

glm::dvec2 pixel_from_world(const View& view, const glm::dvec3& world) {
  const glm::dvec3 d = world - view.eye;
  double u = glm::dot(d, view.right);
  double v = glm::dot(d, view.up);
  if (view.projection == Projection::perspective) {
    const double z = glm::dot(d, view.forward);
    u /= z;
    v /= z;
  }
  return {(u / half_width(view) + 1.0) * 0.5 * view.width, (1.0 - v / view.half_height) * 0.5 * view.height};
}

} // namespace slicelens
