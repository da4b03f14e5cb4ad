#include "render/carried_runs.h"

#include "core/errors.h"
#include "gl/texture.h"
#include "render/shaders.h"

namespace slicelens {

namespace {

/// Units of a pyramid's levels, which two-level scenes do not have; the three before are those of labels.
constexpr std::array<GLenum, 3> units = {6, 7, 8};
constexpr std::array<const char*, 3> names = {"carried_color", "carried_shown", "carried_run"};
constexpr std::array<GLenum, 3> attachments = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1,
                                               GL_COLOR_ATTACHMENT2};
/// No run, and no slice before the first (shaders/lib/two_level.glsl, nothing_gathered).
constexpr std::array<float, 4> no_run = {-1, 0, -3e38F, -1};
constexpr std::array<float, 4> nothing = {0, 0, 0, 0};

} // namespace

CarriedRuns::CarriedRuns(const gl::Functions& gl, int width, int height)
    : gl_(&gl), width_(width), height_(height), framebuffer_(gl::make_framebuffer(gl)) {
  const gl::TextureSpec spec{.format = GL_RGBA32F, .filter = GL_NEAREST};
  for (gl::Texture& texture : written_)
    texture = gl::make_texture_2d(gl, spec, {width, height}, {});
  if (gl.TextureBarrier == nullptr) {
    for (gl::Texture& texture : copies_)
      texture = gl::make_texture_2d(gl, spec, {width, height}, {});
  }
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "picture.vert", {});
  const auto end = shader_stage(GL_FRAGMENT_SHADER, "end_runs.frag", {"LOCAL_MODES"});
  stages.insert(stages.end(), end.begin(), end.end());
  end_program_ = gl::make_program(gl, stages);
}

void CarriedRuns::begin(const gl::Program& program) const {
  const gl::Functions& gl = *gl_;
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name()); // for copies as well
  for (std::size_t i = 0; i < written_.size(); ++i)
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, attachments[i], GL_TEXTURE_2D, written_[i].name(), 0);
  gl.DrawBuffers(3, attachments.data());
  if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw GraphicsError("the driver cannot draw into three textures of floats at once, which local modes in "
                        "slices need; set render.pipeline to rays");
  gl.Viewport(0, 0, width_, height_);
  gl.Disable(GL_BLEND);
  gl.ClearBufferfv(GL_COLOR, 0, nothing.data());
  gl.ClearBufferfv(GL_COLOR, 1, nothing.data());
  gl.ClearBufferfv(GL_COLOR, 2, no_run.data());
  bind_textures(program);
}

void CarriedRuns::bind_textures(const gl::Program& program) const {
  const auto& read = copies_[0] ? copies_ : written_;
  for (std::size_t i = 0; i < read.size(); ++i) {
    gl_->ActiveTexture(GL_TEXTURE0 + units[i]);
    gl_->BindTexture(GL_TEXTURE_2D, read[i].name());
    set_uniform(*gl_, program, names[i], static_cast<int>(units[i]));
  }
}

void CarriedRuns::finish_writing() const {
  const gl::Functions& gl = *gl_;
  if (!copies_[0]) {
    gl.TextureBarrier();
    return;
  }
  for (std::size_t i = 0; i < copies_.size(); ++i) {
    gl.ReadBuffer(attachments[i]);
    gl.ActiveTexture(GL_TEXTURE0 + units[i]);
    gl.CopyTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 0, 0, width_, height_);
  }
}

void CarriedRuns::before_slice(const gl::Program& program, std::size_t number) const {
  finish_writing();
  set_uniform(*gl_, program, "slice_number", static_cast<float>(number));
}

void CarriedRuns::end(double xray_scale) const {
  finish_writing();
  gl_->UseProgram(end_program_.name());
  bind_textures(end_program_);
  set_uniform(*gl_, end_program_, "xray_scale", static_cast<float>(xray_scale));
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

} // namespace slicelens
