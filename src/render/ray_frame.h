// The values of shaders/lib/ray.glsl's RayFrame for a scene's view.
#pragma once

#include "render/prepare.h"

namespace slicelens {

/// See shaders/lib/ray.glsl for the meaning of each field. Texture space; vectors per world unit of length.
struct RayFrameValues {
  glm::dvec3 center{0};
  glm::dvec3 forward{0};
  glm::dvec3 right{0};
  glm::dvec3 up{0};
  double half_width = 0;
  double half_height = 0;
  double anchor = 0;
};

RayFrameValues ray_frame(const PreparedScene& prepared);

/// Throws UsageError when the rays of the picture would take more than max_planes samples each.
void check_sample_count(const PreparedScene& prepared);

} // namespace slicelens
