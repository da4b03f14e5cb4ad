#include "scene/volume_texture.h"

namespace slicelens {

VolumeTexture chosen_texture(VolumeTexture wish, ScalarType type) {
  if (wish != VolumeTexture::automatic)
    return wish;
  return size_of(type) <= 2 ? VolumeTexture::r16 : VolumeTexture::r32f;
}

std::size_t texel_bytes(VolumeTexture wish, ScalarType type) {
  switch (chosen_texture(wish, type)) {
  case VolumeTexture::r8:
    return 1;
  case VolumeTexture::r16:
    return 2;
  default:
    return 4;
  }
}

} // namespace slicelens
