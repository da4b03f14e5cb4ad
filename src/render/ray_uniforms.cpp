#include "render/ray_uniforms.h"

#include "render/ray_frame.h"

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
}

} // namespace slicelens
