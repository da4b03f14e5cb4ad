#include "render/gradient_texture.h"

#include "core/errors.h"
#include "render/gpu_scene.h"
#include "scene/names.h"
#include "volume/gradient_volume.h"
#include "volume/streamed.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <climits>
#include <vector>

namespace slicelens {

namespace {

std::array<int, 3> texture_size(const std::array<std::size_t, 3>& dims) {
  std::array<int, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    size[axis] = static_cast<int>(std::min<std::size_t>(dims[axis], INT_MAX));
  return size;
}

void upload_copy(const gl::Functions& gl, const PreparedScene& prepared, GradientTexture& made) {
  const RenderSettings& render = prepared.scene.render;
  const Volume copy =
      gaussian_copy(prepared.volume, reduction_of(render.gradient_resolution), render.gradient_sigma);
  gl::TextureSpec spec;
  spec.format = GL_R32F;
  made.texture =
      gl::make_texture_3d(gl, spec, texture_size(copy.dims), std::span<const std::byte>(copy.voxels));
  made.voxel = glm::vec3(1.0 / glm::dvec3(copy.dims[0], copy.dims[1], copy.dims[2]));
  made.bytes = voxel_bytes(copy);
}

void upload_differences(const gl::Functions& gl, const PreparedScene& prepared, const Progress& progress,
                        GradientTexture& made) {
  const Volume& volume = prepared.volume;
  gl::TextureSpec spec;
  spec.format = GL_RGB16F;
  spec.source_type = GL_FLOAT;
  made.texture = gl::make_texture_3d(
      gl, spec, texture_size(volume.dims),
      [&](int z0, int z1, std::span<std::byte> slab) {
        central_differences(volume, static_cast<std::size_t>(z0), static_cast<std::size_t>(z1),
                            {reinterpret_cast<float*>(slab.data()), slab.size() / sizeof(float)});
      },
      progress);
  made.bytes = 6 * voxel_count(volume);
}

/// Appends to the three differences of each voxel of the planes from z0 on what the volume's texture holds.
void with_values(const Volume& volume, int z0, const glm::dvec2& value_from_texel,
                 std::span<const float> differences, std::span<float> out) {
  const std::size_t first = static_cast<std::size_t>(z0) * volume.dims[0] * volume.dims[1];
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, differences.size() / 3, std::size_t{1} << 16),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        std::copy_n(&differences[3 * i], 3, &out[4 * i]);
                        const double value = scalar_at(volume, first + i);
                        out[4 * i + 3] =
                            static_cast<float>((value - value_from_texel.y) / value_from_texel.x);
                      }
                    });
}

void upload_differences_and_values(const gl::Functions& gl, const PreparedScene& prepared,
                                   const glm::dvec2& value_from_texel, const Progress& progress,
                                   GradientTexture& made) {
  const Volume& volume = prepared.volume;
  gl::TextureSpec spec;
  spec.format = GL_RGBA32F;
  spec.filter = texture_filter(prepared.scene.render.filter);
  std::vector<float> differences;
  made.texture = gl::make_texture_3d(
      gl, spec, texture_size(volume.dims),
      [&](int z0, int z1, std::span<std::byte> slab) {
        const std::span<float> out(reinterpret_cast<float*>(slab.data()), slab.size() / sizeof(float));
        differences.resize(out.size() / 4 * 3);
        central_differences(volume, static_cast<std::size_t>(z0), static_cast<std::size_t>(z1), differences);
        with_values(volume, z0, value_from_texel, differences, out);
      },
      progress);
  made.bytes = 16 * voxel_count(volume);
}

void upload_precomputed(const gl::Functions& gl, const PreparedScene& prepared,
                        const glm::vec2& value_from_texel, const Progress& progress, GradientTexture& made) {
  if (prepared.scene.render.gradient_texture == GradientFormat::rgba32f)
    upload_differences_and_values(gl, prepared, value_from_texel, progress, made);
  else
    upload_differences(gl, prepared, progress, made);
  const Volume& volume = prepared.volume;
  made.scale =
      glm::vec3(0.5 * (volume.max - volume.min) * glm::dvec3(volume.dims[0], volume.dims[1], volume.dims[2]));
}

} // namespace

bool reads_value_with_gradient(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  return render.gradient == Gradient::precomputed && render.gradient_texture == GradientFormat::rgba32f &&
         (render.filter == Filter::linear || render.filter == Filter::linear_exact) &&
         render.volume_texture != VolumeTexture::r8 && render.mode == Mode::dvr && prepared.others.empty();
}

std::size_t reduction_of(GradientResolution resolution) {
  switch (resolution) {
  case GradientResolution::full:
    return 1;
  case GradientResolution::half:
    return 2;
  case GradientResolution::quarter:
    break;
  }
  return 4;
}

GradientTexture upload_gradients(const gl::Functions& gl, const PreparedScene& prepared,
                                 const glm::vec2& value_from_texel, const Progress& progress) {
  const RenderSettings& render = prepared.scene.render;
  const auto& dims = prepared.volume.dims;
  GradientTexture made;
  made.voxel = glm::vec3(1.0 / glm::dvec3(dims[0], dims[1], dims[2]));
  if (!uses_gradients(prepared.scene))
    return made;
  if (render.gradient == Gradient::prefiltered || render.gradient == Gradient::precomputed)
    require_voxels(prepared.volume, "render.gradient '" + word(render.gradient) + "'");
  if (render.gradient == Gradient::prefiltered)
    upload_copy(gl, prepared, made);
  else if (render.gradient == Gradient::precomputed)
    upload_precomputed(gl, prepared, value_from_texel, progress, made);
  return made;
}

} // namespace slicelens
