#include "volume/pyramid.h"

#include "core/errors.h"
#include "volume/streamed.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace slicelens {

namespace {

template <class In, class Out>
void average(const Volume& source, Volume& result) {
  const In* in = reinterpret_cast<const In*>(source.voxels.data());
  Out* out = reinterpret_cast<Out*>(result.voxels.data());
  const auto& n = source.dims;
  const auto& m = result.dims;
  const auto value = [&](std::size_t index) {
    const double v = static_cast<double>(in[index]);
    return std::isfinite(v) ? v : source.min;
  };
  tbb::parallel_for(std::size_t{0}, m[2], [&](std::size_t k) {
    const std::size_t planes[2] = {2 * k, std::min(2 * k + 1, n[2] - 1)};
    for (std::size_t j = 0; j < m[1]; ++j) {
      const std::size_t rows[2] = {2 * j, std::min(2 * j + 1, n[1] - 1)};
      for (std::size_t i = 0; i < m[0]; ++i) {
        const std::size_t columns[2] = {2 * i, std::min(2 * i + 1, n[0] - 1)};
        double sum = 0;
        for (const std::size_t z : planes) {
          for (const std::size_t y : rows) {
            for (const std::size_t x : columns)
              sum += value((z * n[1] + y) * n[0] + x);
          }
        }
        out[(k * m[1] + j) * m[0] + i] = static_cast<Out>(sum / 8);
      }
    }
  });
}

} // namespace

std::array<std::size_t, 3> level_dims(const std::array<std::size_t, 3>& dims, std::size_t level) {
  std::array<std::size_t, 3> result = dims;
  for (std::size_t k = 0; k < level; ++k) {
    for (std::size_t& n : result)
      n = n / 2 + n % 2;
  }
  return result;
}

ScalarType coarser_type(ScalarType type) {
  return size_of(type) <= 2 || type == ScalarType::f32 ? ScalarType::f32 : ScalarType::f64;
}

Volume coarser_outline(const Volume& volume) {
  if (volume.components != 1)
    throw UsageError("a volume of several components has no coarser levels; choose volume.component");
  Volume result;
  result.dims = level_dims(volume.dims, 1);
  result.spacing = 2.0 * volume.spacing;
  result.origin = volume.origin + volume.direction * (0.5 * volume.spacing);
  result.direction = volume.direction;
  result.type = coarser_type(volume.type);
  result.min = volume.min;
  result.max = volume.max;
  result.mean = volume.mean;
  result.format = volume.format;
  return result;
}

Volume half_size(const Volume& volume) {
  Volume result = coarser_outline(volume);
  result.voxels.resize(voxel_bytes(result));
  visit_scalar_type(volume.type, [&](auto* tag) {
    using In = std::remove_pointer_t<decltype(tag)>;
    if (result.type == ScalarType::f32)
      average<In, float>(volume, result);
    else
      average<In, double>(volume, result);
  });
  return result;
}

Volume crop(const Volume& volume, const std::array<std::size_t, 3>& first,
            const std::array<std::size_t, 3>& size) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (size[axis] == 0 || first[axis] >= volume.dims[axis] || size[axis] > volume.dims[axis] - first[axis])
      throw UsageError("a part of a volume must lie inside it and hold at least one voxel on each axis");
  }
  Volume result;
  result.dims = size;
  result.spacing = volume.spacing;
  result.origin =
      volume.origin + volume.direction * (volume.spacing * glm::dvec3(first[0], first[1], first[2]));
  result.direction = volume.direction;
  result.type = volume.type;
  result.components = volume.components;
  result.min = volume.min;
  result.max = volume.max;
  result.mean = volume.mean;
  result.format = volume.format;
  result.voxels.resize(voxel_bytes(result));
  if (is_streamed(volume)) {
    volume.streamed->stream->read({first, size}, result.voxels);
    return result;
  }
  const std::size_t voxel = size_of(volume.type) * static_cast<std::size_t>(volume.components);
  const std::size_t row = size[0] * voxel;
  std::byte* out = result.voxels.data();
  for (std::size_t k = 0; k < size[2]; ++k) {
    for (std::size_t j = 0; j < size[1]; ++j, out += row) {
      const std::size_t at = ((first[2] + k) * volume.dims[1] + first[1] + j) * volume.dims[0] + first[0];
      std::memcpy(out, volume.voxels.data() + at * voxel, row);
    }
  }
  return result;
}

} // namespace slicelens
