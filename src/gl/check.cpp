#include "gl/check.h"

#include "core/errors.h"

#include <cstdio>

namespace slicelens::gl {
namespace {
// A lost context may report the same error for ever.
constexpr int most_errors = 16;
} // namespace

std::string error_name(GLenum error) {
  switch (error) {
  case GL_NO_ERROR:
    return "GL_NO_ERROR";
  case GL_INVALID_ENUM:
    return "GL_INVALID_ENUM";
  case GL_INVALID_VALUE:
    return "GL_INVALID_VALUE";
  case GL_INVALID_OPERATION:
    return "GL_INVALID_OPERATION";
  case GL_STACK_OVERFLOW:
    return "GL_STACK_OVERFLOW";
  case GL_STACK_UNDERFLOW:
    return "GL_STACK_UNDERFLOW";
  case GL_OUT_OF_MEMORY:
    return "GL_OUT_OF_MEMORY";
  case GL_INVALID_FRAMEBUFFER_OPERATION:
    return "GL_INVALID_FRAMEBUFFER_OPERATION";
  case GL_CONTEXT_LOST:
    return "GL_CONTEXT_LOST";
  default: {
    char text[32];
    std::snprintf(text, sizeof text, "0x%04X", error);
    return text;
  }
  }
}

void check_errors(const Functions& gl, const std::string& where) {
  const GLenum error = gl.GetError();
  if (error == GL_NO_ERROR)
    return;
  clear_errors(gl);
  throw GraphicsError(where + ": " + error_name(error));
}

void clear_errors(const Functions& gl) {
  for (int i = 0; i < most_errors && gl.GetError() != GL_NO_ERROR; ++i) {
  }
}

} // namespace slicelens::gl
