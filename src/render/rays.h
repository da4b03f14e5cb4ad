// Pipeline `rays`: a fragment-shader ray caster with analytic box hits (docs/pipeline.md).
#pragma once

#include "gl/target.h"
#include "render/gpu_scene.h"

#include <optional>

namespace slicelens {

class RayRenderer {
public:
  /// Compiles the program. Throws GraphicsError.
  RayRenderer(const gl::Functions& gl, const PreparedScene& prepared);

  /// Draws the picture into `target`: associated colour over transparent black. State is restored. Reports
  /// the stage "draw" when `progress` listens.
  void draw(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target,
            const Progress& progress);

private:
  void draw_parts(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target);

  const gl::Functions* gl_;
  gl::Program program_;
  gl::Program classify_program_;       ///< MIP in parts only
  std::optional<gl::Target> gathered_; ///< likewise
  gl::VertexArray no_vertices_;
};

} // namespace slicelens
