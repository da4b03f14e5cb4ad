#include "render/gpu_scene.h"

#include "render/grid_textures.h"
#include "render/occupancy.h"
#include "render/pre_classification.h"
#include "scene/names.h"
#include "volume/pyramid.h"
#include "volume/segment_table.h"

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
void encode_run(const T* in, Texel* out, std::size_t count, const Coding& coding, double smallest) {
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

/// Converts the scalars from number `first` on to the texels of a slab, on all cores.
template <class T, class Texel>
void encode(const Volume& volume, const Coding& coding, std::size_t first, std::span<std::byte> slab) {
  const T* in = reinterpret_cast<const T*>(volume.voxels.data()) + first;
  Texel* out = reinterpret_cast<Texel*>(slab.data());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, slab.size() / sizeof(Texel), std::size_t{1} << 18),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      encode_run(in + range.begin(), out + range.begin(), range.size(), coding, volume.min);
                    });
}

template <class Texel>
gl::Texture upload_volume(const gl::Functions& gl, const Volume& volume, Filter filter, GLenum format,
                          const Coding& coding, const Progress& progress) {
  gl::TextureSpec spec;
  spec.format = format;
  spec.filter = texture_filter(filter);
  const std::array<int, 3> size = {static_cast<int>(std::min<std::size_t>(volume.dims[0], INT32_MAX)),
                                   static_cast<int>(std::min<std::size_t>(volume.dims[1], INT32_MAX)),
                                   static_cast<int>(std::min<std::size_t>(volume.dims[2], INT32_MAX))};
  const std::size_t plane = volume.dims[0] * volume.dims[1];
  return gl::make_texture_3d(
      gl, spec, size,
      [&](int z0, int, std::span<std::byte> slab) {
        visit_scalar_type(volume.type, [&](auto* tag) {
          using T = std::remove_pointer_t<decltype(tag)>;
          encode<T, Texel>(volume, coding, static_cast<std::size_t>(z0) * plane, slab);
        });
      },
      progress);
}

/// Needs scene.value_from_texel. A table is uploaded as floats; an 8-bit one has the 256 texels of the
/// papers' hardware.
gl::Texture upload_transfer(const gl::Functions& gl, const PreparedScene& prepared, GpuScene& scene) {
  const bool eight_bit = prepared.scene.render.transfer_texture == TransferTexture::rgba8;
  const TransferTable table = drawn_table(prepared);
  const double count = static_cast<double>(texel_count(table));
  const double scale = (count - 1) / (count * (table.last - table.first));
  scene.transfer_from_value = glm::vec2(scale, 0.5 / count - scale * table.first);
  const glm::dvec2 value(scene.value_from_texel);
  scene.transfer_from_texel = glm::vec2(scale * value.x, 0.5 / count + scale * (value.y - table.first));
  scene.transfer_texels = texel_count(table);
  gl::TextureSpec spec;
  spec.format = eight_bit ? GL_RGBA8 : GL_RGBA32F;
  spec.source_type = GL_FLOAT;
  return gl::make_texture_1d(gl, spec, static_cast<int>(texel_count(table)),
                             std::as_bytes(std::span(table.rgba)));
}

void upload_transfer_2d(const gl::Functions& gl, const PreparedScene& prepared, GpuScene& scene) {
  const TransferTable2D table =
      make_table(prepared.scene.transfer.shapes, prepared.volume.min, prepared.volume.max);
  gl::TextureSpec spec;
  spec.format = GL_RGBA32F;
  scene.transfer_2d =
      gl::make_texture_2d(gl, spec, {table.width, table.height}, std::as_bytes(std::span(table.rgba)));
  const glm::dvec2 size(table.width, table.height);
  const glm::dvec2 scale = (size - 1.0) / (size * (table.last - table.first));
  const glm::dvec2 offset = 0.5 / size - scale * table.first;
  scene.transfer_2d_place = glm::vec4(glm::dvec4(scale, offset));
  scene.bytes += table.rgba.size() * sizeof(float);
}

/// The table of classification `preintegrated`. Needs scene.value_from_texel. Returns its bytes.
std::size_t upload_segments(const gl::Functions& gl, const PreparedScene& prepared, GpuScene& scene) {
  if (prepared.scene.render.classification != Classification::preintegrated)
    return 0;
  const bool corrected = prepared.scene.render.opacity_correction != OpacityCorrection::none;
  const SegmentTable table = make_segment_table(prepared.transfer, prepared.volume.min, prepared.volume.max,
                                                corrected ? axis_distance_ratio(prepared) : 1);
  const auto count = static_cast<double>(table.texels);
  const double scale = (count - 1) / (count * (table.last - table.first));
  const glm::dvec2 value(scene.value_from_texel);
  scene.segment_from_texel = glm::vec2(scale * value.x, 0.5 / count + scale * (value.y - table.first));
  gl::TextureSpec spec;
  spec.format = GL_RGBA32F;
  const int side = static_cast<int>(table.texels);
  scene.segments = gl::make_texture_2d(gl, spec, {side, side}, std::as_bytes(std::span(table.rgba)));
  return table.rgba.size() * sizeof(float);
}

/// Codes between whole numbers, for the means of coarser levels: as many as the type has to spare. Whole
/// numbers stay exact where coding_of holds them exactly.
template <class U>
Coding finer(const Coding& coding, const Volume& volume) {
  const double range = volume.max - volume.min;
  const double codes = std::floor(std::numeric_limits<U>::max() * coding.scale / std::max(range, 1.0));
  return coding.scale == 1 && codes > 1 ? Coding{1 / codes, coding.offset} : coding;
}

/// One texture, or those of the brick plan.
template <class Texel>
void upload_all(const gl::Functions& gl, const PreparedScene& prepared, GLenum format, const Coding& coding,
                GpuScene& scene, const Progress& progress) {
  const RenderSettings& render = prepared.scene.render;
  if (!is_bricked(prepared)) {
    scene.volume = upload_volume<Texel>(gl, prepared.volume, render.filter, format, coding, progress);
    return;
  }
  scene.plan = plan_bricks(prepared);
  for (const Brick& brick : scene.plan.bricks) {
    const Volume& level = brick.level == 0 ? prepared.volume : prepared.pyramid[brick.level - 1];
    scene.bricks.push_back(brick.size == level.dims
                               ? upload_volume<Texel>(gl, level, render.filter, format, coding, {})
                               : upload_volume<Texel>(gl, crop(level, brick.first, brick.size), render.filter,
                                                      format, coding, {}));
    report_progress(progress, "upload",
                    static_cast<double>(scene.bricks.size()) / static_cast<double>(scene.plan.bricks.size()));
  }
}

/// What rays pass over. Slices know it before they are drawn (render/pass_tiles.h).
void upload_occupancy(const gl::Functions& gl, const PreparedScene& prepared, GpuScene& scene) {
  const RenderSettings& render = prepared.scene.render;
  if (!prepared.skipping.empty || render.pipeline != Pipeline::rays)
    return;
  const Occupancy occupancy = occupancy_of(prepared);
  gl::TextureSpec spec;
  spec.format = GL_R8;
  spec.filter = GL_NEAREST;
  const auto& size = occupancy.size;
  scene.occupancy = gl::make_texture_3d(
      gl, spec, {static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])},
      std::as_bytes(std::span(occupancy.stretches)));
  scene.bytes += occupancy.stretches.size();
}

} // namespace

VolumeTexture chosen_texture(VolumeTexture wish, ScalarType type) {
  if (wish != VolumeTexture::automatic)
    return wish;
  return size_of(type) <= 2 ? VolumeTexture::r16 : VolumeTexture::r32f;
}

TransferTable drawn_table(const PreparedScene& prepared) {
  const bool eight_bit = prepared.scene.render.transfer_texture == TransferTexture::rgba8;
  return make_table(prepared.transfer, eight_bit ? 256 : 0, prepared.volume.min, prepared.volume.max);
}

GLenum texture_filter(Filter filter) {
  return filter == Filter::linear || filter == Filter::cubic ? GL_LINEAR : GL_NEAREST;
}

GpuScene upload(const gl::Functions& gl, const PreparedScene& prepared, const Progress& progress) {
  const Volume& volume = prepared.volume;
  GpuScene scene;
  if (prepared.scene.render.pipeline == Pipeline::axis)
    (void)upload_axis_tables(gl, prepared, scene.axis);
  const std::vector<WarpMap> maps = drawn_maps(prepared);
  scene.grids = upload_grids(gl, maps);
  if (prepared.scene.render.classification == Classification::pre) {
    scene.volume = upload_classified(gl, prepared, progress);
    scene.texture = "rgba8, classified";
    scene.bytes = voxel_count(volume) * classified_voxel_bytes + grid_bytes(maps);
    return scene;
  }
  scene.format = chosen_texture(prepared.scene.render.volume_texture, volume.type);
  Coding coding;
  double levels = 1;
  std::size_t texel_bytes = 4;
  if (scene.format == VolumeTexture::r8) {
    coding = coding_of<std::uint8_t>(volume);
    levels = 255;
    texel_bytes = 1;
    if (prepared.levels > 1)
      coding = finer<std::uint8_t>(coding, volume);
    upload_all<std::uint8_t>(gl, prepared, GL_R8, coding, scene, progress);
  } else if (scene.format == VolumeTexture::r16) {
    coding = coding_of<std::uint16_t>(volume);
    levels = 65535;
    texel_bytes = 2;
    if (prepared.levels > 1)
      coding = finer<std::uint16_t>(coding, volume);
    upload_all<std::uint16_t>(gl, prepared, GL_R16, coding, scene, progress);
  } else {
    // Floats keep 24 bits of the distance from the smallest value, which saves large offsets (and 64-bit
    // integers).
    coding = {1, volume.type == ScalarType::f32 ? 0 : volume.min};
    upload_all<float>(gl, prepared, GL_R32F, coding, scene, progress);
  }
  scene.gradients = upload_gradients(gl, prepared, progress);
  scene.value_from_texel = glm::vec2(coding.scale * levels, coding.offset);
  scene.texture = word(scene.format);
  scene.transfer = upload_transfer(gl, prepared, scene);
  const std::size_t transfer_bytes =
      scene.transfer_texels * (prepared.scene.render.transfer_texture == TransferTexture::rgba8 ? 4 : 16);
  scene.whole_bytes = voxel_count(volume) * texel_bytes + transfer_bytes;
  scene.bytes =
      is_bricked(prepared) ? brick_voxels(scene.plan) * texel_bytes + transfer_bytes : scene.whole_bytes;
  scene.bytes += scene.gradients.bytes;
  scene.bytes += grid_bytes(maps);
  if (!prepared.scene.transfer.shapes.empty())
    upload_transfer_2d(gl, prepared, scene);
  scene.bytes += upload_segments(gl, prepared, scene);
  upload_occupancy(gl, prepared, scene);
  scene.labels = upload_labels(gl, prepared, progress);
  scene.bytes += scene.labels.bytes;
  for (const PreparedScene& other : prepared.others) {
    scene.others.push_back(upload(gl, other, progress));
    scene.bytes += scene.others.back().bytes;
    scene.whole_bytes += scene.others.back().whole_bytes;
  }
  return scene;
}

} // namespace slicelens
