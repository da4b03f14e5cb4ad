// Which texture holds a volume's voxels (render.volume_texture).
#pragma once

#include "scene/scene.h"

#include <cstddef>

namespace slicelens {

/// The texture that `auto` stands for: r16 for integers of 8 and 16 bits, which it holds exactly, else r32f.
/// Not r8: software drivers filter 8-bit textures to 8 bits (docs/accuracy.md).
VolumeTexture chosen_texture(VolumeTexture wish, ScalarType type);

/// Bytes of a texel of the chosen texture: 1, 2 or 4.
std::size_t texel_bytes(VolumeTexture wish, ScalarType type);

} // namespace slicelens
