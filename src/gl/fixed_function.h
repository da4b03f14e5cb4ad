// What OpenGL 1.x could do without shaders: the few functions of it that Slicelens draws with, and a guard
// for its state. They are not in the core headers and exist in compatibility contexts only.
#pragma once

#include "gl/context.h"

#include <array>

namespace slicelens::gl {

/// Enumerators that glcorearb.h leaves out (GL/gl.h, OpenGL 1.1 to 1.3).
namespace fixed {
inline constexpr GLenum matrix_mode = 0x0BA0;
inline constexpr GLenum modelview = 0x1700;
inline constexpr GLenum projection = 0x1701;
inline constexpr GLenum modelview_matrix = 0x0BA6;
inline constexpr GLenum projection_matrix = 0x0BA7;
inline constexpr GLenum texture_matrix = 0x0BA8;
inline constexpr GLenum texture_environment = 0x2300;
inline constexpr GLenum texture_environment_mode = 0x2200;
inline constexpr GLenum vertex_array = 0x8074;
inline constexpr GLenum texture_coordinate_array = 0x8078;
inline constexpr GLenum client_active_texture = 0x84E1;
} // namespace fixed

/// Named as in the specification without the prefix `gl`.
struct FixedFunctions {
  void(APIENTRYP MatrixMode)(GLenum) = nullptr;
  void(APIENTRYP LoadMatrixf)(const GLfloat*) = nullptr;
  void(APIENTRYP LoadIdentity)() = nullptr;
  void(APIENTRYP TexEnvi)(GLenum, GLenum, GLint) = nullptr;
  void(APIENTRYP GetTexEnviv)(GLenum, GLenum, GLint*) = nullptr;
  void(APIENTRYP ClientActiveTexture)(GLenum) = nullptr;
  void(APIENTRYP EnableClientState)(GLenum) = nullptr;
  void(APIENTRYP VertexPointer)(GLint, GLenum, GLsizei, const void*) = nullptr;
  void(APIENTRYP TexCoordPointer)(GLint, GLenum, GLsizei, const void*) = nullptr;
};

/// Throws GraphicsError naming what is missing: the compatibility profile, or a function.
FixedFunctions load_fixed_functions(const Context& context);

/// Switches that FixedFunctionGuard knows.
inline constexpr std::size_t fixed_switch_count = 22;

/// Saves at construction and restores at destruction the fixed-function state that a textured, unlit draw
/// depends on: the matrices of position and of texture unit 0 with the matrix mode, texture unit 0's switches
/// and environment mode, and lighting, fog, alpha test, generated texture coordinates, clip planes, stencil
/// and the like. In between the switches are off, the matrices are the identity, the environment mode is
/// GL_REPLACE, the active units are 0. Vertex arrays are not saved: bind a vertex array object. Use it inside
/// a StateGuard.
class FixedFunctionGuard {
public:
  FixedFunctionGuard(const Functions& gl, const FixedFunctions& fixed);
  ~FixedFunctionGuard();
  FixedFunctionGuard(const FixedFunctionGuard&) = delete;
  FixedFunctionGuard& operator=(const FixedFunctionGuard&) = delete;

private:
  const Functions& gl_;
  const FixedFunctions& fixed_;
  std::array<bool, fixed_switch_count> switches_{};
  std::array<std::array<GLfloat, 16>, 3> matrices_{};
  GLint matrix_mode_ = 0;
  GLint client_unit_ = 0;
  GLint active_unit_ = 0;
  GLint environment_mode_ = 0;
};

} // namespace slicelens::gl
