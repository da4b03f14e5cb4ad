#include "render/tiled_draw.h"

#include "gl/check.h"
#include "gl/timer.h"

#include <algorithm>

namespace slicelens {

namespace {

/// Unit 1 is the transfer function's, 2 that of MIP's second pass.
int unit_of(std::size_t level) { return level == 0 ? 0 : 2 + static_cast<int>(level); }

} // namespace

void set_level_samplers(const gl::Functions& gl, const gl::Program& program, const GpuScene& scene) {
  for (std::size_t level = 0; level < scene.plan.levels; ++level) {
    const std::string name = "level_texture_" + std::to_string(level);
    set_uniform(gl, program, name.c_str(), unit_of(level));
  }
}

void bind_tile(const gl::Functions& gl, const gl::Program& program, const GpuScene& scene, std::size_t tile) {
  std::vector<glm::vec4> scales;
  std::vector<glm::vec4> offsets;
  const std::vector<std::size_t>& bricks = scene.plan.of_tile[tile];
  for (std::size_t level = 0; level < bricks.size(); ++level) {
    const Brick& brick = scene.plan.bricks[bricks[level]];
    gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit_of(level)));
    gl.BindTexture(GL_TEXTURE_3D, scene.bricks[bricks[level]].name());
    scales.emplace_back(brick.scale, 0);
    offsets.emplace_back(brick.offset, 0);
  }
  set_uniform(gl, program, "level_scale", std::span<const glm::vec4>(scales));
  set_uniform(gl, program, "level_offset", std::span<const glm::vec4>(offsets));
}

void draw_batches(const gl::Functions& gl, const gl::Program& program, const GpuScene& scene,
                  std::span<const TileBatch> batches, const Progress& progress) {
  const std::size_t step = std::max<std::size_t>(1, batches.size() / 50);
  std::size_t begin = 0;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    bind_tile(gl, program, scene, batches[i].tile);
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(batches[i].end - begin), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(begin * sizeof(std::uint32_t)));
    begin = batches[i].end;
    if (progress.advance && ((i + 1) % step == 0 || i + 1 == batches.size())) {
      gl::finish(gl);
      report_progress(progress, "draw", static_cast<double>(i + 1) / static_cast<double>(batches.size()));
    }
  }
}

} // namespace slicelens
