#include "render/occupancy_texture.h"

#include "render/occupancy.h"
#include "volume/empty_distance.h"

#include <algorithm>
#include <span>

namespace slicelens {

namespace {

/// Behind those of labels, of a pyramid's levels, beside which render.skip is refused.
constexpr GLenum occupancy_unit = 6;

} // namespace

bool uses_occupancy(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  const bool passes = render.planes_per_pass > 1 && !looks_between_samples(render);
  return prepared.skipping.empty && (render.pipeline == Pipeline::rays || passes);
}

OccupancyTexture upload_occupancy(const gl::Functions& gl, const PreparedScene& prepared) {
  OccupancyTexture made;
  if (!uses_occupancy(prepared))
    return made;
  const RenderSettings& render = prepared.scene.render;
  const bool between = looks_between_samples(render);
  const bool small = prepared.small_cells && !between && render.mode != Mode::two_level;
  const CellRanges& cells = small ? *prepared.small_cells : *prepared.cells;
  const Occupancy occupancy = occupancy_of(prepared, cells);
  const std::vector<std::uint8_t> texels =
      between ? occupancy.stretches : empty_distances(occupancy.size, occupancy.shows);
  gl::TextureSpec spec;
  spec.format = GL_R8;
  spec.filter = GL_NEAREST;
  const auto& size = occupancy.size;
  made.texture = gl::make_texture_3d(
      gl, spec, {static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])},
      std::as_bytes(std::span(texels)));
  const auto& dims = prepared.volume.dims;
  made.cells_from_texture = glm::vec3(dims[0], dims[1], dims[2]) / static_cast<float>(cells.edge);
  made.bytes = texels.size();
  return made;
}

void set_occupancy(const gl::Functions& gl, const gl::Program& program, const OccupancyTexture& occupancy) {
  if (!occupancy.texture)
    return;
  gl.ActiveTexture(GL_TEXTURE0 + occupancy_unit);
  gl.BindTexture(GL_TEXTURE_3D, occupancy.texture.name());
  set_uniform(gl, program, "occupancy", static_cast<int>(occupancy_unit));
  set_uniform(gl, program, "cells_from_texture", occupancy.cells_from_texture);
}

} // namespace slicelens
