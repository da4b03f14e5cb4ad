#include "tess/homogeneous.h"

#include <functional>
#include <tuple>

namespace slicelens {

namespace {

bool before(const LensVertex& a, const LensVertex& b) {
  return std::tie(a.position.x, a.position.y, a.position.z) <
         std::tie(b.position.x, b.position.y, b.position.z);
}

LensVertex between(const LensVertex& a, const LensVertex& b, double va, double vb) {
  // Always from the same end, whichever way round the polygon goes.
  if (before(b, a))
    return between(b, a, vb, va);
  const double x = va / (va - vb);
  return {glm::mix(a.position, b.position, x), glm::mix(a.texture, b.texture, x)};
}

LensPolygon clip_by(const LensPolygon& polygon, const std::function<double(const LensVertex&)>& value) {
  LensPolygon result;
  // A cut through a corner gives that corner again.
  const auto append = [&](const LensVertex& vertex) {
    if (result.empty() || vertex.position != result.back().position)
      result.push_back(vertex);
  };
  bool all_inside = true;
  std::vector<double> values;
  values.reserve(polygon.size());
  for (const LensVertex& vertex : polygon) {
    values.push_back(value(vertex));
    all_inside = all_inside && values.back() >= 0;
  }
  if (all_inside)
    return polygon;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    if (values[i] >= 0)
      append(polygon[i]);
    if ((values[i] >= 0) != (values[next] >= 0))
      append(between(polygon[i], polygon[next], values[i], values[next]));
  }
  while (result.size() > 1 && result.front().position == result.back().position)
    result.pop_back();
  return result.size() < 3 ? LensPolygon{} : result;
}

} // namespace

TextureHalfSpace homogeneous(const Plane& plane) { return {glm::dvec4(plane.normal, -plane.offset)}; }

std::vector<TextureHalfSpace> faces_of(const glm::dvec3& low, const glm::dvec3& high) {
  std::vector<TextureHalfSpace> faces;
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0);
    normal[axis] = 1;
    faces.push_back(homogeneous({normal, low[axis]}));
    faces.push_back(homogeneous({-normal, -high[axis]}));
  }
  return faces;
}

LensPolygon clip(const LensPolygon& polygon, const TextureHalfSpace& half_space) {
  return clip_by(polygon, [&](const LensVertex& v) { return glm::dot(half_space.coefficients, v.texture); });
}

LensPolygon clip_position(const LensPolygon& polygon, const Plane& plane) {
  return clip_by(polygon, [&](const LensVertex& v) { return signed_value(plane, v.position); });
}

} // namespace slicelens
