#include "volume/gradient_volume.h"

#include "core/errors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace slicelens {

namespace {

struct Tap {
  std::size_t voxel = 0;
  float weight = 0;
};

/// For each voxel of the copy the voxels that it is the mean of; those beyond the edge are added to the
/// edge's.
std::vector<std::vector<Tap>> taps_of_axis(std::size_t source, std::size_t copy, double sigma) {
  const double step = static_cast<double>(source) / static_cast<double>(copy);
  const double deviation = sigma * step;
  std::vector<std::vector<Tap>> all(copy);
  for (std::size_t i = 0; i < copy; ++i) {
    const double x = (static_cast<double>(i) + 0.5) * step;
    std::vector<double> weights(source, 0);
    double sum = 0;
    for (double j = std::ceil(x - 0.5 - 4 * deviation); j <= std::floor(x - 0.5 + 4 * deviation); ++j) {
      const double distance = (j + 0.5 - x) / deviation;
      const double weight = std::exp(-0.5 * distance * distance);
      weights[static_cast<std::size_t>(std::clamp(j, 0.0, static_cast<double>(source - 1)))] += weight;
      sum += weight;
    }
    for (std::size_t j = 0; j < source; ++j) {
      if (weights[j] > 0)
        all[i].push_back({j, static_cast<float>(weights[j] / sum)});
    }
  }
  return all;
}

/// The first pass, along i, from the volume's own scalars.
template <class T>
std::vector<float> smooth_rows(const Volume& volume, const std::vector<std::vector<Tap>>& taps) {
  const T* in = reinterpret_cast<const T*>(volume.voxels.data());
  const std::size_t n = volume.dims[0];
  const std::size_t m = taps.size();
  std::vector<float> result(m * volume.dims[1] * volume.dims[2]);
  tbb::parallel_for(std::size_t{0}, volume.dims[1] * volume.dims[2], [&](std::size_t row) {
    std::vector<float> values(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double value = static_cast<double>(in[row * n + i]);
      values[i] = static_cast<float>((std::isfinite(value) ? value : volume.min) - volume.min);
    }
    for (std::size_t i = 0; i < m; ++i) {
      float sum = 0;
      for (const Tap& tap : taps[i])
        sum += tap.weight * values[tap.voxel];
      result[row * m + i] = sum;
    }
  });
  return result;
}

/// The later passes: values in `blocks` blocks of `count` runs of `run` floats each, smoothed across the
/// runs.
std::vector<float> smooth_runs(const std::vector<float>& in, std::size_t run, std::size_t count,
                               std::size_t blocks, const std::vector<std::vector<Tap>>& taps) {
  const std::size_t m = taps.size();
  std::vector<float> result(run * m * blocks, 0.0F);
  tbb::parallel_for(std::size_t{0}, m * blocks, [&](std::size_t index) {
    float* out = result.data() + index * run;
    const float* block = in.data() + (index / m) * count * run;
    for (const Tap& tap : taps[index % m]) {
      const float* from = block + tap.voxel * run;
      for (std::size_t i = 0; i < run; ++i)
        out[i] += tap.weight * from[i];
    }
  });
  return result;
}

/// One plane of central differences.
template <class T>
void plane_differences(const Volume& volume, std::size_t k, float* out) {
  const T* in = reinterpret_cast<const T*>(volume.voxels.data());
  const auto& n = volume.dims;
  const double inverse = volume.max > volume.min ? 1 / (volume.max - volume.min) : 0;
  const auto value = [&](std::size_t i, std::size_t j, std::size_t l) {
    const double v = static_cast<double>(in[(l * n[1] + j) * n[0] + i]);
    return std::isfinite(v) ? v : volume.min;
  };
  const std::size_t below = k > 0 ? k - 1 : 0;
  const std::size_t above = std::min(k + 1, n[2] - 1);
  for (std::size_t j = 0; j < n[1]; ++j) {
    const std::size_t front = j > 0 ? j - 1 : 0;
    const std::size_t back = std::min(j + 1, n[1] - 1);
    for (std::size_t i = 0; i < n[0]; ++i, out += 3) {
      const std::size_t left = i > 0 ? i - 1 : 0;
      const std::size_t right = std::min(i + 1, n[0] - 1);
      out[0] = static_cast<float>((value(right, j, k) - value(left, j, k)) * inverse);
      out[1] = static_cast<float>((value(i, back, k) - value(i, front, k)) * inverse);
      out[2] = static_cast<float>((value(i, j, above) - value(i, j, below)) * inverse);
    }
  }
}

} // namespace

std::array<std::size_t, 3> reduced_dims(const std::array<std::size_t, 3>& dims, std::size_t reduction) {
  std::array<std::size_t, 3> result = dims;
  for (std::size_t& n : result)
    n = n / reduction + (n % reduction != 0 ? 1 : 0);
  return result;
}

Volume gaussian_copy(const Volume& volume, std::size_t reduction, double sigma) {
  if (volume.components != 1)
    throw UsageError("a volume of several components has no gradient; choose volume.component");
  Volume copy;
  copy.dims = reduced_dims(volume.dims, reduction);
  copy.type = ScalarType::f32;
  copy.origin = volume.origin;
  copy.direction = volume.direction;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    copy.spacing[axis] =
        volume.spacing[axis] * static_cast<double>(volume.dims[a]) / static_cast<double>(copy.dims[a]);
    copy.origin += volume.direction[axis] * (0.5 * (copy.spacing[axis] - volume.spacing[axis]));
  }
  copy.max = volume.max - volume.min;
  copy.format = volume.format;
  (void)voxel_bytes(copy); // refuses what cannot be addressed
  std::vector<std::vector<Tap>> taps[3];
  for (std::size_t axis = 0; axis < 3; ++axis)
    taps[axis] = taps_of_axis(volume.dims[axis], copy.dims[axis], sigma);
  std::vector<float> values = visit_scalar_type(volume.type, [&](auto* tag) {
    return smooth_rows<std::remove_pointer_t<decltype(tag)>>(volume, taps[0]);
  });
  values = smooth_runs(values, copy.dims[0], volume.dims[1], volume.dims[2], taps[1]);
  values = smooth_runs(values, copy.dims[0] * copy.dims[1], volume.dims[2], 1, taps[2]);
  const auto bytes = std::as_bytes(std::span<const float>(values));
  copy.voxels.assign(bytes.begin(), bytes.end());
  return copy;
}

void central_differences(const Volume& volume, std::size_t z0, std::size_t z1, std::span<float> out) {
  const std::size_t plane = 3 * volume.dims[0] * volume.dims[1];
  visit_scalar_type(volume.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    tbb::parallel_for(z0, z1,
                      [&](std::size_t k) { plane_differences<T>(volume, k, out.data() + (k - z0) * plane); });
  });
}

} // namespace slicelens
