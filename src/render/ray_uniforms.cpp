#include "render/ray_uniforms.h"

#include "render/ray_frame.h"
#include "render/uniforms.h"

namespace slicelens {

void set_ray_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared) {
  const RayFrameValues frame = ray_frame(prepared);
  set_uniform(gl, program, "frame.center", glm::vec3(frame.center));
  set_uniform(gl, program, "frame.forward", glm::vec3(frame.forward));
  set_uniform(gl, program, "frame.right", glm::vec3(frame.right));
  set_uniform(gl, program, "frame.up", glm::vec3(frame.up));
  set_uniform(gl, program, "frame.half_width", static_cast<float>(frame.half_width));
  set_uniform(gl, program, "frame.half_height", static_cast<float>(frame.half_height));
  set_uniform(gl, program, "frame.anchor", static_cast<float>(frame.anchor));
  set_uniform(gl, program, "delta", static_cast<float>(prepared.spacing));
  set_uniform(gl, program, "object_low", glm::vec3(prepared.object_low));
  set_uniform(gl, program, "object_high", glm::vec3(prepared.object_high));
  // Under a warp a straight ray leaves and enters the data's half-spaces more than once: gpu/warp.glsl tests
  // each sample.
  std::vector<glm::vec4> planes = plane_vectors(prepared.object_clip);
  if (!is_warped(prepared)) {
    for (const glm::vec4& plane : plane_vectors(prepared.data_clip))
      planes.push_back(plane);
  }
  set_uniform(gl, program, "clip_count", static_cast<int>(planes.size()));
  if (!planes.empty())
    set_uniform(gl, program, "clip_planes", std::span<const glm::vec4>(planes));
}

} // namespace slicelens
