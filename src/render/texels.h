// How a volume's values are stored in texels.
#pragma once

#include "gl/handle.h"
#include "render/prepare.h"
#include "scene/volume_texture.h"

#include <cstddef>
#include <span>

namespace slicelens {

/// value = scale · code + offset for a texel's code: a whole number of a normalised format, the texel itself
/// of a float one.
struct TexelCoding {
  VolumeTexture format = VolumeTexture::r32f; ///< what `automatic` became
  GLenum gl_format = 0;
  std::size_t bytes = 4; ///< of a texel
  double scale = 1;
  double offset = 0;
  glm::vec2 value_from_texel{1, 0}; ///< data value = x · texel as shaders read it + y
};

/// Integers are stored so that they come back exactly where the format has the bits; otherwise values are
/// scaled to the format over the volume's range. With levels the means of coarser ones get the codes between
/// whole numbers that the type has to spare.
TexelCoding texel_coding(const PreparedScene& prepared);

/// Writes the texels of `count` scalars of `volume` from number `first` on, on all cores. Those that are no
/// numbers count as volume.min.
void encode_voxels(const Volume& volume, const TexelCoding& coding, std::size_t first, std::size_t count,
                   std::span<std::byte> out);

/// The same in this thread: for callers that share the work out themselves.
void encode_run(const Volume& volume, const TexelCoding& coding, std::size_t first, std::size_t count,
                std::byte* out);

} // namespace slicelens
