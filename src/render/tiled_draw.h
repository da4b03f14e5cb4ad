// Drawing from a volume held in several textures.
#pragma once

#include "gl/program.h"
#include "render/gpu_scene.h"
#include "render/stack_geometry.h"

#include <span>

namespace slicelens {

/// Names the texture units of the levels: unit 0 for level 0 and 2 + k for level k. The program must be in
/// use.
void set_level_samplers(const gl::Functions& gl, const gl::Program& program, const GpuScene& scene);

/// Binds a tile's bricks and sets where they lie. The program must be in use.
void bind_tile(const gl::Functions& gl, const gl::Program& program, const GpuScene& scene, std::size_t tile);

/// Draws the batches in order from the bound vertex array. Reports the stage "draw" as SliceRenderer::draw
/// does.
void draw_batches(const gl::Functions& gl, const gl::Program& program, const GpuScene& scene,
                  std::span<const TileBatch> batches, const Progress& progress);

} // namespace slicelens
