// Volumes made by hand for the tests of the renderers.
#pragma once

#include "volume/volume.h"

#include <array>
#include <cstring>

namespace slicelens {

/// A volume of `type` holding f(i, j, k), spacing 1, centre of the box at the world's origin.
template <class Function>
Volume volume_of(ScalarType type, const std::array<std::size_t, 3>& dims, const Function& f) {
  Volume volume;
  volume.dims = dims;
  volume.type = type;
  volume.origin = -(glm::dvec3(dims[0], dims[1], dims[2]) - 1.0) / 2.0;
  volume.voxels.resize(voxel_bytes(volume));
  visit_scalar_type(type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    std::size_t at = 0;
    for (std::size_t k = 0; k < dims[2]; ++k) {
      for (std::size_t j = 0; j < dims[1]; ++j) {
        for (std::size_t i = 0; i < dims[0]; ++i, at += sizeof(T)) {
          const T value = static_cast<T>(f(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)));
          std::memcpy(volume.voxels.data() + at, &value, sizeof(T));
        }
      }
    }
  });
  update_statistics(volume);
  return volume;
}

} // namespace slicelens
