// Uniforms that the GPU pipelines share.
#pragma once

#include "gl/program.h"
#include "render/gpu_scene.h"
#include "render/warp_glsl.h"

#include <string>
#include <vector>

namespace slicelens {

/// Macros for sampling, mode and shading, as shaders/ names them.
std::vector<std::string> common_macros(const PreparedScene& prepared);

/// Where one volume's textures are bound.
struct TextureUnits {
  GLenum volume = 0;
  GLenum transfer = 1;
  GLenum pages = 9;        ///< of a pool's page table: a level's, which a pool has not
  GLenum gradient = 10;    ///< the second texture that some gradients need
  GLenum transfer_2d = 11; ///< of value and gradient
  std::vector<GLenum> grids = grid_units;
};

/// Sets what shaders/gpu/warp.glsl declares. The program must be in use.
void set_warp_uniforms(const gl::Functions& gl, const gl::Uniforms& program, const PreparedScene& prepared,
                       const TextureUnits& units = {});

/// Binds the textures of one volume and sets what shaders/gpu/{volume,classify,warp,gradient,light}.glsl
/// declare.
void set_volume_uniforms(const gl::Functions& gl, const gl::Uniforms& program, const PreparedScene& prepared,
                         const GpuScene& scene, const TextureUnits& units = {});

/// Texture unit of the first of Cohen's tables: behind the volume, the transfer function, the maxima of MIP
/// and the levels of a pyramid.
inline constexpr GLenum axis_unit = 12;

/// Of the table of segments: that of MIP's maxima, which have none.
inline constexpr GLenum segment_unit = 2;

/// Planes as GLSL takes them: (normal, −offset).
std::vector<glm::vec4> plane_vectors(const std::vector<Plane>& planes);

/// Binds the textures of all volumes and sets what shaders/gpu/*.glsl declares. The program must be in use.
void set_common_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                         const GpuScene& scene);

} // namespace slicelens
