// Saving and restoring OpenGL state, so that a pass leaves nothing behind.
#pragma once

#include "gl/functions.h"

#include <array>
#include <vector>

namespace slicelens::gl {

/// Saves at construction and restores at destruction what the passes of Slicelens change: blending (switch,
/// functions, equations, colour), viewport, scissor, depth test, function and mask, face culling, colour
/// mask, clear colour, dithering, sRGB conversion, framebuffers, program, vertex array, array and
/// pixel-buffer bindings, pixel store, active unit, and for the first texture_units units the 1D, 2D and 3D
/// textures and the sampler. Costs about a hundred glGet calls: use one per pass, not per draw. Keep it
/// shorter-lived than the objects that were bound.
class StateGuard {
public:
  static constexpr int texture_units = 16;

  explicit StateGuard(const Functions& gl);
  ~StateGuard();
  StateGuard(const StateGuard&) = delete;
  StateGuard& operator=(const StateGuard&) = delete;

private:
  struct Unit {
    std::array<GLint, 3> textures; // 1D, 2D, 3D
    GLint sampler;
  };
  const Functions& gl_;
  std::vector<GLint> integers_;
  std::array<bool, 6> switches_{};
  std::array<GLint, 4> viewport_{};
  std::array<GLint, 4> scissor_{};
  std::array<GLfloat, 4> blend_color_{};
  std::array<GLfloat, 4> clear_color_{};
  std::array<GLboolean, 4> color_mask_{};
  GLboolean depth_mask_ = GL_TRUE;
  std::vector<Unit> units_;
};

/// Restores the texture bound to `target` (GL_TEXTURE_1D, _2D or _3D) on the unit that is active now.
class TextureBindingGuard {
public:
  TextureBindingGuard(const Functions& gl, GLenum target);
  ~TextureBindingGuard();
  TextureBindingGuard(const TextureBindingGuard&) = delete;
  TextureBindingGuard& operator=(const TextureBindingGuard&) = delete;

private:
  const Functions& gl_;
  GLenum target_;
  GLint texture_ = 0;
};

/// Sets tightly packed texels from client memory (alignment 1, no row length, no skips, no unpack buffer) and
/// restores what was set before.
class UnpackGuard {
public:
  explicit UnpackGuard(const Functions& gl);
  ~UnpackGuard();
  UnpackGuard(const UnpackGuard&) = delete;
  UnpackGuard& operator=(const UnpackGuard&) = delete;

private:
  const Functions& gl_;
  std::array<GLint, 6> values_{};
  GLint buffer_ = 0;
};

/// The same for reading: tightly packed pixels into client memory, and the framebuffer and colour buffer that
/// are read.
class PackGuard {
public:
  explicit PackGuard(const Functions& gl);
  ~PackGuard();
  PackGuard(const PackGuard&) = delete;
  PackGuard& operator=(const PackGuard&) = delete;

private:
  const Functions& gl_;
  std::array<GLint, 4> values_{};
  GLint buffer_ = 0;
  GLint framebuffer_ = 0;
};

} // namespace slicelens::gl
