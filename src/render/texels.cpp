#include "render/texels.h"

#include "gl/texture.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace slicelens {

namespace {

/// value = scale · code + offset, for texels stored as `code`.
struct Coding {
  double scale = 1;
  double offset = 0;
};

/// How values of a volume are stored in normalised texels of type U: exactly where an integer type fits, else
/// spread over the volume's range.
template <class U>
Coding coding_of(const Volume& volume) {
  const bool integer = volume.type != ScalarType::f32 && volume.type != ScalarType::f64;
  const double levels = std::numeric_limits<U>::max();
  if (integer && volume.max - volume.min <= levels)
    return {1, volume.min};
  const double range = volume.max - volume.min;
  return {range > 0 ? range / levels : 1, volume.min};
}

/// The nearest code to a value ≥ 0. Not std::lround: a call per voxel made this most of an upload's time.
template <class Texel>
Texel nearest_code(double code) {
  return static_cast<Texel>(static_cast<std::int32_t>(code + 0.5));
}

/// Converts `count` scalars to texels.
template <class T, class Texel>
void encode_scalars(const T* in, Texel* out, std::size_t count, const Coding& coding, double smallest) {
  const double inverse = 1 / coding.scale;
  if constexpr (std::is_floating_point_v<Texel>) {
    for (std::size_t i = 0; i < count; ++i) {
      const double value = static_cast<double>(in[i]);
      out[i] = static_cast<Texel>((std::isfinite(value) ? value : smallest) - coding.offset);
    }
  } else if constexpr (std::is_floating_point_v<T>) {
    for (std::size_t i = 0; i < count; ++i) {
      const double value = static_cast<double>(in[i]);
      out[i] = nearest_code<Texel>(((std::isfinite(value) ? value : smallest) - coding.offset) * inverse);
    }
  } else if (sizeof(T) <= 4 && coding.scale == 1) {
    // The difference fits the texel, so it may be taken modulo its range.
    const auto low = static_cast<Texel>(static_cast<std::int64_t>(coding.offset));
    for (std::size_t i = 0; i < count; ++i)
      out[i] = static_cast<Texel>(static_cast<Texel>(in[i]) - low);
  } else {
    for (std::size_t i = 0; i < count; ++i)
      out[i] = nearest_code<Texel>((static_cast<double>(in[i]) - coding.offset) * inverse);
  }
}

/// Codes between whole numbers, for the means of coarser levels: as many as the type has to spare. Whole
/// numbers stay exact where coding_of holds them exactly.
template <class U>
Coding finer(const Coding& coding, const Volume& volume) {
  const double range = volume.max - volume.min;
  const double codes = std::floor(std::numeric_limits<U>::max() * coding.scale / std::max(range, 1.0));
  return coding.scale == 1 && codes > 1 ? Coding{1 / codes, coding.offset} : coding;
}

template <class Texel>
Coding chosen_coding(const PreparedScene& prepared) {
  const Coding coding = coding_of<Texel>(prepared.volume);
  return prepared.levels > 1 ? finer<Texel>(coding, prepared.volume) : coding;
}

} // namespace

TexelCoding texel_coding(const PreparedScene& prepared) {
  const Volume& volume = prepared.volume;
  TexelCoding result;
  result.format = chosen_texture(prepared.scene.render.volume_texture, volume.type);
  Coding coding;
  double levels = 1;
  if (result.format == VolumeTexture::r8) {
    coding = chosen_coding<std::uint8_t>(prepared);
    levels = 255;
    result.gl_format = GL_R8;
    result.bytes = 1;
  } else if (result.format == VolumeTexture::r16) {
    coding = chosen_coding<std::uint16_t>(prepared);
    levels = 65535;
    result.gl_format = GL_R16;
    result.bytes = 2;
  } else {
    // Floats keep 24 bits of the distance from the smallest value, which saves large offsets (and 64-bit
    // integers).
    coding = {1, volume.type == ScalarType::f32 ? 0 : volume.min};
    result.gl_format = GL_R32F;
  }
  result.scale = coding.scale;
  result.offset = coding.offset;
  result.value_from_texel = glm::vec2(coding.scale * levels, coding.offset);
  return result;
}

void encode_run(const Volume& volume, const TexelCoding& coding, std::size_t first, std::size_t count,
                std::byte* out) {
  const Coding codes{coding.scale, coding.offset};
  visit_scalar_type(volume.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    const T* in = reinterpret_cast<const T*>(volume.voxels.data()) + first;
    if (coding.bytes == 1)
      encode_scalars(in, reinterpret_cast<std::uint8_t*>(out), count, codes, volume.min);
    else if (coding.bytes == 2)
      encode_scalars(in, reinterpret_cast<std::uint16_t*>(out), count, codes, volume.min);
    else
      encode_scalars(in, reinterpret_cast<float*>(out), count, codes, volume.min);
  });
}

void encode_voxels(const Volume& volume, const TexelCoding& coding, std::size_t first, std::size_t count,
                   std::span<std::byte> out) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::size_t{1} << 18),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      encode_run(volume, coding, first + range.begin(), range.size(),
                                 out.data() + range.begin() * coding.bytes);
                    });
}

} // namespace slicelens
