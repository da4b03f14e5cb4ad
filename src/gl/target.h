// What a pass draws into, and reading it back.
#pragma once

#include "gl/handle.h"

#include <vector>

namespace slicelens::gl {

/// A framebuffer with one colour texture, GL_COLOR_ATTACHMENT0.
struct Target {
  Framebuffer framebuffer;
  Texture color;      ///< GL_TEXTURE_2D, filter nearest, clamped to the edge
  Renderbuffer depth; ///< 32-bit float; none but after attach_depth
  int width = 0;
  int height = 0;
  GLenum format = GL_RGBA8; ///< internal format of `color`
};

/// A target of width × height pixels, content undefined. `format`: GL_RGBA8, GL_RGBA16F, GL_RGBA32F … All
/// bindings stay as they were. Throws LimitError when it is too large for the driver, GraphicsError when the
/// driver cannot draw into the format.
Target make_target(const Functions& gl, int width, int height, GLenum format);

/// Gives the target a depth buffer of 32-bit floats. Throws GraphicsError when the driver has none.
void attach_depth(const Functions& gl, Target& target);

/// Binds the target for drawing and sets the viewport to its size.
void bind_target(const Functions& gl, const Target& target);

/// All pixels as float RGBA, 4·width·height values, row 0 at the top (OpenGL's last row), not clamped. Waits
/// for the drawing to finish. Bindings and pixel store stay as they were. Throws GraphicsError.
std::vector<float> read_pixels(const Functions& gl, const Target& target);

} // namespace slicelens::gl
