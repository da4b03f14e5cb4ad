// Pipeline `fixed-function`: LaMar's own hardware path, without shaders (LaMar, Hamann and Joy 2001 §4). The
// corners carry homogeneous texture coordinates (glTexCoordPointer with four components), the rasteriser
// divides, the texture environment replaces the fragment by a texel of the pre-classified RGBA volume, and
// blending composites in 8 bits.
#pragma once

#include "gl/fixed_function.h"
#include "gl/target.h"
#include "render/gpu_scene.h"
#include "render/stack_geometry.h"

namespace slicelens {

/// What one fixed-function draw reads.
struct FixedFunctionTexture {
  GLenum target = GL_TEXTURE_3D; ///< GL_TEXTURE_2D or GL_TEXTURE_3D
  GLuint name = 0;               ///< associated colour, filter and wrapping as the texture says
};

/// Draws triangles without shaders. Needs a compatibility context, current from construction to destruction.
class FixedFunctionRenderer {
public:
  /// Throws GraphicsError where the context is not of the compatibility profile.
  explicit FixedFunctionRenderer(const gl::Context& context);

  /// Cuts the stack for the scene's view and hands it to the driver.
  void slice(const PreparedScene& prepared);
  /// Triangles of the caller's own, in drawing order; `index_ends` of each slice.
  void set_geometry(const StackGeometry& geometry);
  /// One mesh, for instance a lens over a 2D image.
  void set_geometry(const LensMesh& mesh);

  /// Draws the stack into `target`: associated colour over transparent black. State is restored. Reports the
  /// stage "draw" when `progress` listens.
  void draw(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target,
            const Progress& progress);

  /// Draws the triangles into `target`, cleared to transparent black before: back to front each goes over
  /// what was drawn before it, front to back under it. `clip_from_position`: OpenGL clip coordinates of the
  /// corners' positions. State is restored.
  void draw(const FixedFunctionTexture& texture, const glm::mat4& clip_from_position, Order order,
            const gl::Target& target, const Progress& progress);

  std::size_t slice_count() const { return index_ends_.size(); }
  std::size_t triangle_count() const { return index_ends_.empty() ? 0 : index_ends_.back() / 3; }

private:
  void draw_stack(const Progress& progress);

  const gl::Functions* gl_;
  gl::FixedFunctions fixed_;
  gl::VertexArray vertex_array_;
  gl::Buffer corners_;
  gl::Buffer indices_;
  std::vector<std::size_t> index_ends_; ///< of each slice in the index buffer
};

} // namespace slicelens
