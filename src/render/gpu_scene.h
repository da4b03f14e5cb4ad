// The volume and the transfer function as textures.
#pragma once

#include "gl/texture.h"
#include "render/axis_textures.h"
#include "render/brick_pool.h"
#include "render/bricks.h"
#include "render/gradient_texture.h"
#include "render/label_textures.h"
#include "render/occupancy_texture.h"
#include "render/prepare.h"
#include "render/texels.h"

#include <memory>

namespace slicelens {

/// Textures of a prepared scene, shared by the GPU pipelines.
struct GpuScene {
  gl::Texture volume;      ///< 3D, one channel, or associated RGBA of 8 bits under classification `pre`
  gl::Texture transfer;    ///< 1D, straight RGBA; none under classification `pre`
  gl::Texture transfer_2d; ///< 2D, associated RGBA, of value and gradient; where the scene has shapes
  glm::vec4 transfer_2d_place{1, 1, 0, 0}; ///< table coordinates = xy · (value, gradient) + zw
  glm::vec2 value_from_texel{1, 0};        ///< data value = x · texel + y
  glm::vec2 transfer_from_value{1, 0};     ///< table coordinate = x · value + y
  glm::vec2 transfer_from_texel{1, 0};     ///< table coordinate = x · texel + y
  gl::Texture segments;               ///< 2D, classification `preintegrated` only (volume/segment_table.h)
  glm::vec2 segment_from_texel{1, 0}; ///< its coordinate = x · texel + y
  VolumeTexture format = VolumeTexture::r32f; ///< what `automatic` became
  std::string texture;                        ///< what holds the volume, in words: "r16"
  std::size_t bytes = 0;                      ///< of all textures
  std::size_t whole_bytes = 0; ///< of the volume in one texture at full resolution, and the transfer function
  BrickPlan plan;              ///< where the volume is bricked (render.tiles, render.levels)
  std::vector<gl::Texture> bricks; ///< of plan.bricks; `volume` is empty then
  std::unique_ptr<BrickPool> pool; ///< where the volume is paged (pages.h); `volume` is empty then
  std::size_t transfer_texels = 0;
  GradientTexture gradients;      ///< for shading
  AxisTextures axis;              ///< empty but under pipeline `axis`
  std::vector<gl::Texture> grids; ///< of the maps that are held in grids, in their order
  OccupancyTexture occupancy;     ///< render.skip
  LabelTextures labels;           ///< mode `two-level` only
  std::vector<GpuScene> others;   ///< of the volumes after the first
};

/// The transfer function as the GPU reads it: the papers' 256 texels for an 8-bit texture, else as many as it
/// needs.
TransferTable drawn_table(const PreparedScene& prepared);

/// How the driver filters the texture of a volume for render.filter: linearly as well where shaders build the
/// cubic B-spline from linear fetches (shaders/gpu/volume.glsl).
GLenum texture_filter(Filter filter);

/// Uploads both. Voxels without a value have been filled before
/// (volume/missing.h). Throws LimitError where the driver has no room.
GpuScene upload(const gl::Functions& gl, const PreparedScene& prepared, const Progress& progress);

} // namespace slicelens
