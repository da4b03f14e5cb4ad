// Local modes in slices. Fixed blending cannot hold a run of samples whose largest value or sum counts only
// where the run ends (shaders/lib/two_level.glsl), so each ray's state lies in three textures of floats:
// every fragment of a slice reads its own pixel, adds its sample and writes the pixel again, from the nearest
// slice to the farthest. Between two slices stands a texture barrier (OpenGL 4.5), or a copy of the textures.
#pragma once

#include "gl/handle.h"
#include "gl/program.h"
#include "render/gpu_scene.h"

#include <array>

namespace slicelens {

/// The textures and the pass that ends the last runs.
class CarriedRuns {
public:
  /// For pictures of width × height pixels. Throws GraphicsError, and LimitError where the driver has no
  /// room.
  CarriedRuns(const gl::Functions& gl, int width, int height);

  /// Binds the framebuffer with empty runs at all pixels and no blending. `program`, slices.frag, is in use.
  void begin(const gl::Program& program) const;

  /// Before slice `number`, counted from 0 at the nearest: what the ones before have written can be read.
  void before_slice(const gl::Program& program, std::size_t number) const;

  /// Draws associated colours into the bound framebuffer. Changes the program and needs a vertex array.
  void end(double xray_scale) const;

  int width() const { return width_; }
  int height() const { return height_; }

private:
  void bind_textures(const gl::Program& program) const;
  void finish_writing() const;

  const gl::Functions* gl_;
  int width_;
  int height_;
  gl::Framebuffer framebuffer_;
  std::array<gl::Texture, 3> written_; ///< colour, shown, run
  std::array<gl::Texture, 3> copies_;  ///< what is read where there are no texture barriers
  gl::Program end_program_;
};

} // namespace slicelens
