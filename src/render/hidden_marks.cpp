#include "render/hidden_marks.h"

#include "core/errors.h"
#include "gl/check.h"
#include "render/occupancy.h"
#include "render/shaders.h"

namespace slicelens {

HiddenMarks::HiddenMarks(const gl::Functions& gl, const gl::Target& target)
    : gl_(&gl), color_(target.color.name()), width_(target.width), height_(target.height),
      depth_(gl::make_renderbuffer(gl)), drawing_(gl::make_framebuffer(gl)),
      marking_(gl::make_framebuffer(gl)), no_vertices_(gl::make_vertex_array(gl)) {
  GLint bound = 0;
  gl.GetIntegerv(GL_RENDERBUFFER_BINDING, &bound);
  gl.BindRenderbuffer(GL_RENDERBUFFER, depth_.name());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_, height_);
  gl.BindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(bound));
  gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  bool complete = true;
  for (const gl::Framebuffer* framebuffer : {&drawing_, &marking_}) {
    gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer->name());
    gl.FramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
    const GLenum output = framebuffer == &drawing_ ? GL_COLOR_ATTACHMENT0 : GL_NONE;
    if (framebuffer == &drawing_)
      gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, output, GL_TEXTURE_2D, color_, 0);
    gl.DrawBuffers(1, &output);
    complete = complete && gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
  }
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(bound));
  gl::check_errors(gl, "making the depth buffer of hidden samples");
  if (!complete)
    throw GraphicsError("the driver cannot draw with a depth buffer; set render.skip to empty");
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "picture.vert", {});
  const auto fragment = shader_stage(GL_FRAGMENT_SHADER, "hidden_marks.frag", {});
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  program_ = gl::make_program(gl, stages);
}

bool HiddenMarks::fits(const gl::Target& target) const {
  return color_ == target.color.name() && width_ == target.width && height_ == target.height;
}

void HiddenMarks::begin() const {
  const gl::Functions& gl = *gl_;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, drawing_.name());
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  gl.ClearDepth(1);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  gl.DepthMask(GL_FALSE);
  gl.DepthFunc(GL_LESS);
}

void HiddenMarks::mark(GLenum unit) const {
  const gl::Functions& gl = *gl_;
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, marking_.name());
  gl.DepthMask(GL_TRUE);
  gl.UseProgram(program_.name());
  gl.ActiveTexture(GL_TEXTURE0 + unit);
  gl.BindTexture(GL_TEXTURE_2D, color_);
  set_uniform(gl, program_, "colors", static_cast<int>(unit));
  set_uniform(gl, program_, "nothing_behind", static_cast<float>(opaque_enough));
  gl.BindVertexArray(no_vertices_.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl.DepthMask(GL_FALSE);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, drawing_.name());
}

} // namespace slicelens
