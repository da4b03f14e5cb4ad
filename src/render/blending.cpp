#include "render/blending.h"

#include "render/uniforms.h"

namespace slicelens {

void set_blending(const gl::Functions& gl, Mode mode, Order order) {
  gl.Enable(GL_BLEND);
  const bool extreme = mode == Mode::mip || mode == Mode::minip;
  gl.BlendEquation(extreme ? GL_MAX : GL_FUNC_ADD);
  if (mode == Mode::xray || mode == Mode::average) {
    gl.BlendFunc(GL_ONE, GL_ONE);
  } else if (order == Order::back_to_front) {
    gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  } else {
    gl.BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
  }
}

void classify_gathered(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                       const GpuScene& scene, const gl::Target& gathered, const glm::dvec2& value_from_unit,
                       const gl::Target& target) {
  gl::bind_target(gl, target);
  gl.Disable(GL_BLEND);
  gl.Disable(GL_DEPTH_TEST);
  gl.UseProgram(program.name());
  set_common_uniforms(gl, program, prepared, scene);
  gl.ActiveTexture(GL_TEXTURE2);
  gl.BindTexture(GL_TEXTURE_2D, gathered.color.name());
  set_uniform(gl, program, "maxima", 2);
  set_uniform(gl, program, "value_from_unit", glm::vec2(value_from_unit));
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace slicelens
