#include "warp/fisheye.h"

#include "core/errors.h"
#include "core/text.h"

#include <cmath>

namespace slicelens {

namespace {
using Functions = shared::FisheyeFunctions<double>;
}

void validate(const Fisheye& fisheye) {
  for (int axis = 0; axis < 3; ++axis) {
    const double center = fisheye.center[axis];
    if (!(center > 0 && center < 1)) {
      throw UsageError("warp 'fisheye': center must lie within the volume and touch no face: above 0 and "
                       "below 1 on every axis, not " +
                       number_text(center));
    }
    const double distortion = fisheye.distortion[axis];
    if (!(distortion >= 0 && distortion <= 1e4)) {
      throw UsageError("warp 'fisheye': distortion must be from 0 to 10000, not " + number_text(distortion));
    }
  }
}

FisheyeMap fisheye_map(const Fisheye& fisheye, const BoxSpace& space) {
  return {space.size, fisheye.center, fisheye.distortion};
}

glm::dvec3 texture_from_object(const FisheyeMap& map, const glm::dvec3& p) {
  return Functions().fisheye_texture_from_object(map, p);
}

glm::dmat3 jacobian(const FisheyeMap& map, const glm::dvec3& p) {
  return Functions().fisheye_jacobian(map, p);
}

glm::dvec3 object_from_texture(const FisheyeMap& map, const glm::dvec3& u) {
  glm::dvec3 t = texture_from_box({map.size, 1}, u);
  for (int axis = 0; axis < 3; ++axis) {
    if (t[axis] < 0 || t[axis] > 1)
      continue;
    const double center = map.center[axis];
    const double border = t[axis] < center ? -center : 1 - center;
    const double f = (t[axis] - center) / border;
    t[axis] = center + border * (map.distortion[axis] + 1) * f / (1 + map.distortion[axis] * f);
  }
  return box_from_texture({map.size, 1}, t);
}

} // namespace slicelens
