#include "core/errors.h"
#include "volume/volume.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

namespace slicelens {

bool holds_colors(const Volume& volume) {
  return volume.components >= 3 && (volume.type == ScalarType::u8 || volume.type == ScalarType::u16);
}

Volume with_luminance(const Volume& volume) {
  if (!holds_colors(volume)) {
    throw UsageError("a volume of " + std::to_string(volume.components) + " component(s) of type " +
                     name_of(volume.type) + " holds no colours; they are 3 or 4 of uint8 or uint16");
  }
  Volume result;
  result.dims = volume.dims;
  result.spacing = volume.spacing;
  result.origin = volume.origin;
  result.direction = volume.direction;
  result.type = volume.type;
  result.frames = volume.frames;
  result.format = volume.format;
  result.voxels.resize(voxel_bytes(result));
  result.colors.has_opacity = volume.components == 4;
  const std::size_t count = voxel_count(volume);
  result.colors.rgba.resize(4 * count);
  const auto components = static_cast<std::size_t>(volume.components);
  const auto fill = [&](auto* luminances) {
    using T = std::remove_pointer_t<decltype(luminances)>;
    const double to_eight_bits = 255.0 / std::numeric_limits<T>::max();
    const T* in = reinterpret_cast<const T*>(volume.voxels.data());
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const T* voxel = in + i * components;
      for (std::size_t c = 0; c < 4; ++c) {
        result.colors.rgba[4 * i + c] =
            c < components ? static_cast<std::uint8_t>(std::lround(voxel[c] * to_eight_bits)) : 255;
      }
      luminances[i] = static_cast<T>(std::lround(0.2126 * voxel[0] + 0.7152 * voxel[1] + 0.0722 * voxel[2]));
    });
  };
  if (volume.type == ScalarType::u8)
    fill(reinterpret_cast<std::uint8_t*>(result.voxels.data()));
  else
    fill(reinterpret_cast<std::uint16_t*>(result.voxels.data()));
  update_statistics(result);
  return result;
}

} // namespace slicelens
