#include "render/pre_classification.h"

#include "render/gpu_scene.h"
#include "volume/streamed.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace slicelens {

namespace {

using Texel = std::array<std::uint8_t, classified_voxel_bytes>;

/// Δ/Δ₀ where opacities are corrected before they are stored, else 1.
double baked_ratio(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  const bool bakes = render.mode == Mode::dvr && render.opacity_correction != OpacityCorrection::none;
  return bakes ? axis_distance_ratio(prepared) : 1;
}

std::uint8_t eight_bits(double value) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0)));
}

Texel associated_texel(const glm::dvec4& color, double ratio) {
  const double alpha =
      color.a >= 1 || ratio == 1 ? std::min(color.a, 1.0) : -std::expm1(ratio * std::log1p(-color.a));
  return {eight_bits(color.r * alpha), eight_bits(color.g * alpha), eight_bits(color.b * alpha),
          eight_bits(alpha)};
}

Texel classify(const TransferFunction& transfer, double value, double ratio) {
  return associated_texel(evaluate(transfer, value), ratio);
}

/// Colours by code − smallest code, for types with few codes.
template <class T>
std::vector<Texel> table_of(const TransferFunction& transfer, double ratio) {
  constexpr int low = std::numeric_limits<T>::min();
  constexpr int count = std::numeric_limits<T>::max() - low + 1;
  std::vector<Texel> table(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count,
                    [&](int i) { table[static_cast<std::size_t>(i)] = classify(transfer, low + i, ratio); });
  return table;
}

/// `color_of` gives the texel of a voxel of type T.
template <class T, class ColorOf>
void fill(const T* voxels, std::span<std::byte> out, const ColorOf& color_of) {
  const std::size_t count = out.size() / classified_voxel_bytes;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 14), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Texel texel = color_of(voxels[i]);
      std::memcpy(out.data() + i * classified_voxel_bytes, texel.data(), classified_voxel_bytes);
    }
  });
}

/// Classifies ranges of voxels of type T; the table is made once.
template <class T>
class Classifier {
public:
  explicit Classifier(const PreparedScene& prepared) : prepared_(prepared), ratio_(baked_ratio(prepared)) {
    if constexpr (has_table)
      table_ = table_of<T>(prepared.transfer, ratio_);
  }

  void operator()(const Volume& volume, std::size_t first, std::span<std::byte> out) const {
    const T* voxels = reinterpret_cast<const T*>(volume.voxels.data()) + first;
    if constexpr (has_table) {
      fill(voxels, out,
           [&](T value) { return table_[static_cast<std::size_t>(value - std::numeric_limits<T>::min())]; });
    } else {
      fill(voxels, out, [&](T value) {
        const double number = static_cast<double>(value);
        return classify(prepared_.transfer, std::isfinite(number) ? number : volume.min, ratio_);
      });
    }
  }

private:
  static constexpr bool has_table = std::is_integral_v<T> && sizeof(T) <= 2;
  const PreparedScene& prepared_;
  double ratio_;
  std::vector<Texel> table_;
};

/// Voxels with colours of their own: with their own opacities, or those of their luminances.
class ColorClassifier {
public:
  explicit ColorClassifier(const PreparedScene& prepared)
      : prepared_(prepared), ratio_(baked_ratio(prepared)) {}

  void operator()(const Volume& volume, std::size_t first, std::span<std::byte> out) const {
    const VoxelColors& colors = volume.colors;
    const std::size_t count = out.size() / classified_voxel_bytes;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 14), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const std::size_t voxel = first + i;
        glm::dvec4 color;
        for (int c = 0; c < 4; ++c)
          color[c] = colors.rgba[4 * voxel + static_cast<std::size_t>(c)] / 255.0;
        if (!colors.has_opacity)
          color.a = evaluate(prepared_.transfer, scalar_at(volume, voxel)).a;
        const Texel texel = associated_texel(color, ratio_);
        std::memcpy(out.data() + i * classified_voxel_bytes, texel.data(), classified_voxel_bytes);
      }
    });
  }

private:
  const PreparedScene& prepared_;
  double ratio_;
};

/// Calls `use` with the classifier of the volume's colours, or of its type.
template <class Use>
void with_classifier(const PreparedScene& prepared, const Use& use) {
  if (!prepared.volume.colors.rgba.empty()) {
    use(ColorClassifier(prepared));
    return;
  }
  visit_scalar_type(prepared.volume.type,
                    [&](auto* tag) { use(Classifier<std::remove_pointer_t<decltype(tag)>>(prepared)); });
}

int texels(std::size_t n) { return static_cast<int>(std::min<std::size_t>(n, INT32_MAX)); }

} // namespace

void classify_voxels(const PreparedScene& prepared, std::size_t first, std::span<std::byte> out) {
  require_voxels(prepared.volume, "render.classification 'pre' in one texture");
  with_classifier(prepared, [&](const auto& classifier) { classifier(prepared.volume, first, out); });
}

VoxelClassifier voxel_classifier(const PreparedScene& prepared) {
  VoxelClassifier result;
  with_classifier(prepared, [&](const auto& classifier) { result = classifier; });
  return result;
}

std::vector<std::byte> classify_voxels(const PreparedScene& prepared) {
  std::vector<std::byte> out(classified_voxel_bytes * voxel_count(prepared.volume));
  classify_voxels(prepared, 0, out);
  return out;
}

gl::Texture upload_classified(const gl::Functions& gl, const PreparedScene& prepared,
                              const Progress& progress) {
  const auto& dims = prepared.volume.dims;
  gl::TextureSpec spec;
  spec.format = GL_RGBA8;
  spec.filter = texture_filter(prepared.scene.render.filter);
  gl::Texture texture;
  with_classifier(prepared, [&](const auto& classifier) {
    texture = gl::make_texture_3d(
        gl, spec, {texels(dims[0]), texels(dims[1]), texels(dims[2])},
        [&](int z0, int, std::span<std::byte> slab) {
          classifier(prepared.volume, static_cast<std::size_t>(z0) * dims[0] * dims[1], slab);
        },
        progress);
  });
  return texture;
}

} // namespace slicelens
