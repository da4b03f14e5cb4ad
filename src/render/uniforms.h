// Uniforms that the GPU pipelines share.
#pragma once

#include "gl/program.h"
#include "render/gpu_scene.h"

#include <string>
#include <vector>

namespace slicelens {

/// Macros for sampling, mode and shading, as shaders/ names them.
std::vector<std::string> common_macros(const PreparedScene& prepared);

/// Sets `lenses` and `box_size` of shaders/gpu/warp.glsl. The program must be in use.
void set_lens_uniforms(const gl::Functions& gl, const gl::Program& program,
                       const std::vector<LensTessellation>& lenses, const BoxSpace& space);

/// Sets what shaders/gpu/warp.glsl declares. The program must be in use.
void set_warp_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared);

/// Planes as GLSL takes them: (normal, −offset).
std::vector<glm::vec4> plane_vectors(const std::vector<Plane>& planes);

/// Binds both textures (units 0 and 1) and sets what shaders/gpu/*.glsl declares. The program must be in use.
void set_common_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                         const GpuScene& scene);

} // namespace slicelens
