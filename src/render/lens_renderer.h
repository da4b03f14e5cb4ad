// Programs, textures and geometry of a 2D lens.
#pragma once

#include "gl/program.h"
#include "gl/target.h"
#include "render/lens_picture.h"

namespace slicelens {

/// One corner as the GPU takes it, 5 floats.
struct PictureVertex {
  glm::vec2 corner; ///< clip space
  glm::vec3 look;   ///< (s·q, t·q, q) of the image looked at
  bool operator==(const PictureVertex&) const = default;
};

/// The mesh of a picture with equal corners joined; the undisturbed triangles come first.
struct PictureGeometry {
  std::vector<PictureVertex> vertices;
  std::vector<std::uint32_t> indices;
  std::size_t normal_indices = 0; ///< of undisturbed triangles
};
PictureGeometry make_picture_geometry(const PreparedPicture& prepared);

/// Draws one prepared picture any number of times; the geometry is made once and kept by the driver.
class PictureRenderer {
public:
  /// Compiles, uploads the image and, for pipeline `lookup`, the table of the warp. Throws GraphicsError,
  /// LimitError.
  PictureRenderer(const gl::Functions& gl, const PreparedPicture& prepared);

  /// Draws into `target`, a picture of the prepared size: associated colour on transparent black. State is
  /// restored.
  void draw(const gl::Target& target) const;

  /// The same in two steps, for drawing many frames. bind() binds target, textures and buffers and leaves
  /// them bound; draw_bound() draws the triangles and nothing else: one call, or two where undisturbed
  /// triangles have a program of their own.
  void bind(const gl::Target& target) const;
  void draw_bound() const;

  std::size_t triangle_count() const { return index_count_ / 3; }

private:
  void upload(const PreparedPicture& prepared);
  void set_uniforms(const gl::Program& program, const PreparedPicture& prepared,
                    const WarpTable& table) const;

  const gl::Functions* gl_;
  gl::Program plain_; ///< divides the homogeneous coordinate
  gl::Program lens_;  ///< evaluates the lens at each fragment; none where the corners carry it
  gl::Texture image_;
  gl::Texture table_; ///< pipeline `lookup`
  gl::VertexArray vertex_array_;
  gl::Buffer corners_;
  gl::Buffer indices_;
  std::size_t normal_count_ = 0; ///< indices drawn by plain_
  std::size_t index_count_ = 0;
};

} // namespace slicelens
