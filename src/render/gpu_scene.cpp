#include "render/gpu_scene.h"

#include "render/grid_textures.h"
#include "render/pre_classification.h"
#include "scene/names.h"
#include "volume/pyramid.h"
#include "volume/segment_table.h"

#include <algorithm>
#include <cstdint>

namespace slicelens {

namespace {

gl::Texture upload_volume(const gl::Functions& gl, const Volume& volume, Filter filter,
                          const TexelCoding& coding, const Progress& progress) {
  gl::TextureSpec spec;
  spec.format = coding.gl_format;
  spec.filter = texture_filter(filter);
  const std::array<int, 3> size = {static_cast<int>(std::min<std::size_t>(volume.dims[0], INT32_MAX)),
                                   static_cast<int>(std::min<std::size_t>(volume.dims[1], INT32_MAX)),
                                   static_cast<int>(std::min<std::size_t>(volume.dims[2], INT32_MAX))};
  const std::size_t plane = volume.dims[0] * volume.dims[1];
  return gl::make_texture_3d(
      gl, spec, size,
      [&](int z0, int z1, std::span<std::byte> slab) {
        encode_voxels(volume, coding, static_cast<std::size_t>(z0) * plane,
                      static_cast<std::size_t>(z1 - z0) * plane, slab);
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

/// One texture, those of the brick plan, or a pool that is filled while it is drawn.
void upload_all(const gl::Functions& gl, const PreparedScene& prepared, const TexelCoding& coding,
                GpuScene& scene, const Progress& progress) {
  const RenderSettings& render = prepared.scene.render;
  if (is_paged(prepared)) {
    scene.pool = std::make_unique<BrickPool>(gl, prepared);
    return;
  }
  if (!is_bricked(prepared)) {
    scene.volume = upload_volume(gl, prepared.volume, render.filter, coding, progress);
    return;
  }
  scene.plan = plan_bricks(prepared);
  for (const Brick& brick : scene.plan.bricks) {
    const Volume& level = brick.level == 0 ? prepared.volume : prepared.pyramid[brick.level - 1];
    scene.bricks.push_back(brick.size == level.dims ? upload_volume(gl, level, render.filter, coding, {})
                                                    : upload_volume(gl, crop(level, brick.first, brick.size),
                                                                    render.filter, coding, {}));
    report_progress(progress, "upload",
                    static_cast<double>(scene.bricks.size()) / static_cast<double>(scene.plan.bricks.size()));
  }
}

} // namespace

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
    scene.texture = "rgba8, classified";
    scene.whole_bytes = voxel_count(volume) * classified_voxel_bytes;
    if (is_paged(prepared)) {
      scene.pool = std::make_unique<BrickPool>(gl, prepared);
      scene.bytes = scene.pool->counts().texture_bytes + grid_bytes(maps);
      return scene;
    }
    scene.volume = upload_classified(gl, prepared, progress);
    scene.bytes = scene.whole_bytes + grid_bytes(maps);
    return scene;
  }
  const TexelCoding coding = texel_coding(prepared);
  scene.format = coding.format;
  upload_all(gl, prepared, coding, scene, progress);
  scene.gradients = upload_gradients(gl, prepared, coding.value_from_texel, progress);
  scene.value_from_texel = coding.value_from_texel;
  scene.texture = word(scene.format);
  scene.transfer = upload_transfer(gl, prepared, scene);
  const std::size_t transfer_bytes =
      scene.transfer_texels * (prepared.scene.render.transfer_texture == TransferTexture::rgba8 ? 4 : 16);
  scene.whole_bytes = voxel_count(volume) * coding.bytes + transfer_bytes;
  scene.bytes = scene.pool             ? scene.pool->counts().texture_bytes + transfer_bytes
                : is_bricked(prepared) ? brick_voxels(scene.plan) * coding.bytes + transfer_bytes
                                       : scene.whole_bytes;
  scene.bytes += scene.gradients.bytes;
  scene.bytes += grid_bytes(maps);
  if (!prepared.scene.transfer.shapes.empty())
    upload_transfer_2d(gl, prepared, scene);
  scene.bytes += upload_segments(gl, prepared, scene);
  scene.occupancy = upload_occupancy(gl, prepared);
  scene.bytes += scene.occupancy.bytes;
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
