#include "gl/target.h"

#include "core/errors.h"
#include "gl/check.h"
#include "gl/state.h"
#include "gl/texture.h"

#include <algorithm>

namespace slicelens::gl {
namespace {

const char* status_name(GLenum status) {
  switch (status) {
  case GL_FRAMEBUFFER_UNSUPPORTED:
    return "GL_FRAMEBUFFER_UNSUPPORTED";
  case GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT:
    return "GL_FRAMEBUFFER_INCOMPLETE_ATTACHMENT";
  case GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER:
    return "GL_FRAMEBUFFER_INCOMPLETE_DRAW_BUFFER";
  default:
    return "the framebuffer is incomplete";
  }
}

} // namespace

Target make_target(const Functions& gl, int width, int height, GLenum format) {
  GLint limits[2] = {0, 0};
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, limits);
  if (width > limits[0] || height > limits[1])
    throw LimitError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels is larger than this driver's limit of " + std::to_string(limits[0]) + " x " +
                     std::to_string(limits[1]));
  Target target;
  target.color = make_texture_2d(gl, {.format = format, .filter = GL_NEAREST}, {width, height}, {});
  target.framebuffer = make_framebuffer(gl);
  target.width = width;
  target.height = height;
  target.format = format;
  GLint draw = 0;
  gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer.name());
  gl.FramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.color.name(), 0);
  const GLenum status = gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw));
  check_errors(gl, "making a target");
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw GraphicsError("the driver cannot draw into format " + error_name(format) + ": " +
                        status_name(status));
  return target;
}

void attach_depth(const Functions& gl, Target& target) {
  GLint draw = 0;
  GLint bound = 0;
  gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &draw);
  gl.GetIntegerv(GL_RENDERBUFFER_BINDING, &bound);
  target.depth = make_renderbuffer(gl);
  gl.BindRenderbuffer(GL_RENDERBUFFER, target.depth.name());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, target.width, target.height);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer.name());
  gl.FramebufferRenderbuffer(GL_DRAW_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target.depth.name());
  const GLenum status = gl.CheckFramebufferStatus(GL_DRAW_FRAMEBUFFER);
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(draw));
  gl.BindRenderbuffer(GL_RENDERBUFFER, static_cast<GLuint>(bound));
  check_errors(gl, "making a depth buffer");
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw GraphicsError(std::string("the driver cannot draw with a depth buffer: ") + status_name(status));
}

void bind_target(const Functions& gl, const Target& target) {
  gl.BindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer.name());
  gl.Viewport(0, 0, target.width, target.height);
}

std::vector<float> read_pixels(const Functions& gl, const Target& target) {
  const std::size_t row = 4 * static_cast<std::size_t>(target.width);
  const auto rows = static_cast<std::size_t>(target.height);
  std::vector<float> pixels(checked_product(row, rows, "picture"));
  {
    const PackGuard guard(gl);
    gl.BindFramebuffer(GL_READ_FRAMEBUFFER, target.framebuffer.name());
    gl.ReadPixels(0, 0, target.width, target.height, GL_RGBA, GL_FLOAT, pixels.data());
  }
  check_errors(gl, "reading pixels");
  for (std::size_t y = 0; y < rows / 2; ++y) {
    const auto top = pixels.begin() + static_cast<std::ptrdiff_t>(y * row);
    const auto bottom = pixels.begin() + static_cast<std::ptrdiff_t>((rows - 1 - y) * row);
    std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
  }
  return pixels;
}

} // namespace slicelens::gl
