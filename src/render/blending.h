// How samples that follow each other become a picture: what slices, and rays that are drawn in parts, share.
#pragma once

#include "gl/program.h"
#include "gl/target.h"
#include "render/gpu_scene.h"

namespace slicelens {

/// Enables blending of what is drawn with what is there: the larger value (modes `mip` and `minip`), the sum
/// (`xray`, `average`), else associated colours in this order.
void set_blending(const gl::Functions& gl, Mode mode, Order order);

/// Draws the colours of a picture of extremes or sums into `target` with a program of classify_maximum.frag.
/// `value_from_unit`: data value = x · what `gathered` holds + y. A vertex array without attributes is bound.
void classify_gathered(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared,
                       const GpuScene& scene, const gl::Target& gathered, const glm::dvec2& value_from_unit,
                       const gl::Target& target);

} // namespace slicelens
