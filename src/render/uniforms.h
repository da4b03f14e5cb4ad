// Uniforms that the GPU pipelines share.
#pragma once

#include "gl/program.h"
#include "render/gpu_scene.h"

#include <string>
#include <vector>

namespace slicelens {

/// Macros for sampling, mode and shading, as shaders/ names them.
std::vector<std::string> common_macros(const PreparedScene& prepared);

/// Sets what shaders/gpu/warp.glsl declares. The program must be in use.
void set_warp_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared);

/// Texture unit of the first of Cohen's tables: behind the volume, the transfer function, the maxima of MIP
/// and the levels of a pyramid.
inline constexpr GLenum axis_unit = 12;

/// Texture unit of the second texture that some gradients need.
inline constexpr GLenum gradient_unit = 10;

/// Planes as GLSL takes them: (normal, −offset).
std::vector<glm::vec4> plane_vectors(const std::vector<Plane>& planes);

/// Binds both textures (units 0 and 1) and sets what shaders/gpu/*.glsl declares. The program must be in use.
void set_common_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                         const GpuScene& scene);

} // namespace slicelens
