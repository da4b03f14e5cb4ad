// Front to back, what lies behind opaque pixels is rejected by depth before it is shaded (render.skip
// `empty+hidden`). docs/skipping.md.
#pragma once

#include "gl/program.h"
#include "gl/target.h"

namespace slicelens {

/// Slices between two markings, at least.
inline constexpr std::size_t slices_per_mark = 16;

/// Marks opaque pixels of a target in a depth buffer of its own. OpenGL 3.3: no pass reads what it draws
/// into.
class HiddenMarks {
public:
  /// Throws GraphicsError and LimitError.
  HiddenMarks(const gl::Functions& gl, const gl::Target& target);

  /// Whether it was made for this target.
  bool fits(const gl::Target& target) const;

  /// Binds the target's colours with the depth buffer, empty, and the test: everything passes but behind
  /// marks. Everything drawn must have depth 0 in [−1, 1] and write none.
  void begin() const;

  /// Marks what has become opaque since. Leaves the framebuffer, the test, blending and colour mask as after
  /// begin(); changes the program, the vertex array and texture unit `unit`.
  void mark(GLenum unit) const;

private:
  const gl::Functions* gl_;
  GLuint color_;
  int width_;
  int height_;
  gl::Renderbuffer depth_;
  gl::Framebuffer drawing_; ///< the target's colours and the depth buffer
  gl::Framebuffer marking_; ///< the depth buffer alone
  gl::Program program_;
  gl::VertexArray no_vertices_;
};

} // namespace slicelens
