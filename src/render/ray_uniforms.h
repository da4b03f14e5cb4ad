// The uniforms of shaders/gpu/ray.glsl.
#pragma once

#include "gl/program.h"
#include "render/prepare.h"

namespace slicelens {

/// Where rays run; where they end is set_common_uniforms'. The program must be in use.
void set_ray_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared);

} // namespace slicelens
