// The second texture of gradients `prefiltered` and `precomputed`.
#pragma once

#include "gl/texture.h"
#include "render/prepare.h"

namespace slicelens {

/// Voxels of the volume for one of the Gaussian copy on each axis: 1, 2 or 4.
std::size_t reduction_of(GradientResolution resolution);

struct GradientTexture {
  gl::Texture texture; ///< R32F, values of the copy; RGB16F, differences; RGBA32F, differences and values;
                       ///< empty where gradients need none
  glm::vec3 voxel{
      1}; ///< step of differences in texture coordinates: one voxel, of the copy where there is one
  glm::vec3 scale{1}; ///< derivative by texture coordinates = scale ∘ texel of a gradient volume
  std::size_t bytes = 0;
};

/// Makes it on all cores and uploads it. `precomputed` holds three halfs, 6 bytes a voxel: central
/// differences as shares of the data's range (volume/gradient_volume.h), with 11 bits 0.03° of direction; or
/// four floats, 16 bytes, the last one what the volume's texture holds there: (value − value_from_texel.y) /
/// value_from_texel.x. Throws LimitError where the driver has no room.
GradientTexture upload_gradients(const gl::Functions& gl, const PreparedScene& prepared,
                                 const glm::vec2& value_from_texel, const Progress& progress);

/// Whether shaded samples are read from that one texture alone: where the volume's own would give the same.
bool reads_value_with_gradient(const PreparedScene& prepared);

} // namespace slicelens
