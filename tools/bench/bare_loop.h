// The measure that the slice pipeline is held to: as little OpenGL as draws blended, textured, classified
// quads.
#pragma once

#include "gl/program.h"
#include "gl/target.h"
#include "render/gpu_scene.h"
#include "slicing/slice_stack.h"

#include <vector>

namespace slicelens::bench {

/// One polygon of a draw call: a triangle fan of corners [first, first + count).
struct Fan {
  GLint first = 0;
  GLsizei count = 0;
};

/// Corners in clip space (x, y) and texture space (s, t, r): five floats each, in one buffer.
class BareLoop {
public:
  explicit BareLoop(const gl::Functions& gl);

  /// `count` squares that cover the whole picture, perpendicular to `forward` (world space, unit), at the
  /// positions of the slice stack: what an implementation without clipping to the box would draw.
  void set_squares(const PreparedScene& prepared);
  /// The very polygons of the slice stack.
  void set_polygons(const PreparedScene& prepared);

  /// One glDrawArrays per polygon. Leaves its state behind.
  void draw(const GpuScene& scene, const gl::Target& target) const;

  std::size_t polygon_count() const { return fans_.size(); }

private:
  void set_corners(const std::vector<float>& corners);

  const gl::Functions* gl_;
  gl::Program program_;
  gl::VertexArray vertex_array_;
  gl::Buffer corners_;
  std::vector<Fan> fans_;
};

} // namespace slicelens::bench
