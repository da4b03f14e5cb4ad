#include "render/fixed_function.h"

#include "gl/check.h"
#include "gl/state.h"
#include "gl/timer.h"

#include <algorithm>
#include <cstddef>

namespace slicelens {

FixedFunctionRenderer::FixedFunctionRenderer(const gl::Context& context)
    : gl_(&context.functions()), fixed_(gl::load_fixed_functions(context)),
      vertex_array_(gl::make_vertex_array(*gl_)) {}

void FixedFunctionRenderer::slice(const PreparedScene& prepared) {
  set_geometry(make_stack_geometry(prepared));
}

void FixedFunctionRenderer::set_geometry(const LensMesh& mesh) {
  StackGeometry geometry;
  for (const LensVertex& vertex : mesh.vertices)
    geometry.vertices.push_back({glm::vec3(vertex.position), glm::vec4(vertex.texture)});
  geometry.indices = mesh.triangles;
  geometry.index_ends = {geometry.indices.size()};
  set_geometry(geometry);
}

void FixedFunctionRenderer::set_geometry(const StackGeometry& geometry) {
  const gl::Functions& gl = *gl_;
  index_ends_ = geometry.index_ends;
  const gl::StateGuard guard(gl);
  const gl::FixedFunctionGuard fixed_guard(gl, fixed_); // texture unit 0 is the one that takes coordinates
  gl.BindVertexArray(vertex_array_.name());
  corners_ = gl::make_buffer(gl, GL_ARRAY_BUFFER, std::as_bytes(std::span(geometry.vertices)));
  fixed_.EnableClientState(gl::fixed::vertex_array);
  fixed_.VertexPointer(3, GL_FLOAT, sizeof(StackVertex),
                       reinterpret_cast<const void*>(offsetof(StackVertex, position)));
  fixed_.EnableClientState(gl::fixed::texture_coordinate_array);
  fixed_.TexCoordPointer(4, GL_FLOAT, sizeof(StackVertex),
                         reinterpret_cast<const void*>(offsetof(StackVertex, texture)));
  indices_ = gl::make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(geometry.indices)));
  gl::check_errors(gl, "handing over fixed-function geometry");
}

void FixedFunctionRenderer::draw_stack(const Progress& progress) {
  const std::size_t count = index_ends_.size();
  // One call draws the whole stack in order. Only where somebody watches it is cut into steps.
  const std::size_t step = std::max<std::size_t>(1, progress.advance ? count / 50 : count);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < count; i += step) {
    const std::size_t last = std::min(count, i + step);
    const std::size_t end = index_ends_[last - 1];
    gl_->DrawElements(GL_TRIANGLES, static_cast<GLsizei>(end - begin), GL_UNSIGNED_INT,
                      reinterpret_cast<const void*>(begin * sizeof(std::uint32_t)));
    begin = end;
    if (progress.advance) {
      gl::finish(*gl_);
      report_progress(progress, "draw", static_cast<double>(last) / static_cast<double>(count));
    }
  }
}

void FixedFunctionRenderer::draw(const PreparedScene& prepared, const GpuScene& scene,
                                 const gl::Target& target, const Progress& progress) {
  draw({GL_TEXTURE_3D, scene.volume.name()}, glm::mat4(clip_from_texture(prepared)),
       prepared.scene.render.order, target, progress);
}

void FixedFunctionRenderer::draw(const FixedFunctionTexture& texture, const glm::mat4& clip_from_position,
                                 Order order, const gl::Target& target, const Progress& progress) {
  const gl::Functions& gl = *gl_;
  const gl::StateGuard guard(gl);
  const gl::FixedFunctionGuard fixed_guard(gl, fixed_);
  gl::bind_target(gl, target);
  for (const GLenum off : {GL_DEPTH_TEST, GL_CULL_FACE, GL_SCISSOR_TEST, GL_DITHER, GL_FRAMEBUFFER_SRGB})
    gl.Disable(off);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.ClearColor(0, 0, 0, 0);
  gl.Clear(GL_COLOR_BUFFER_BIT);

  gl.UseProgram(0);
  fixed_.MatrixMode(gl::fixed::projection);
  fixed_.LoadMatrixf(&clip_from_position[0][0]);
  gl.Enable(texture.target);
  gl.BindTexture(texture.target, texture.name);
  gl.BindSampler(0, 0);
  gl.Enable(GL_BLEND);
  gl.BlendEquation(GL_FUNC_ADD);
  if (order == Order::back_to_front)
    gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  else
    gl.BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
  gl.BindVertexArray(vertex_array_.name());
  draw_stack(progress);
  gl::check_errors(gl, "drawing by fixed function");
}

} // namespace slicelens
