// The cells that show nothing, where fragments can look them up (render.skip). docs/skipping.md.
#pragma once

#include "gl/program.h"
#include "gl/texture.h"
#include "render/prepare.h"

namespace slicelens {

struct OccupancyTexture {
  /// 3D, R8, one texel a cell: cells to the nearest that shows something; for what shows between samples
  /// Occupancy::stretches.
  gl::Texture texture;
  glm::vec3 cells_from_texture{1}; ///< cells in one unit of texture coordinates, also fractions
  std::size_t bytes = 0;
};

/// Whether fragments look at it: rays, and passes of several planes, that have something to pass over.
bool uses_occupancy(const PreparedScene& prepared);

/// Empty where nothing uses it. Throws LimitError where the driver has no room.
OccupancyTexture upload_occupancy(const gl::Functions& gl, const PreparedScene& prepared);

/// Binds it and sets what shaders/gpu/occupancy.glsl declares, if there is one. The program must be in use.
void set_occupancy(const gl::Functions& gl, const gl::Program& program, const OccupancyTexture& occupancy);

} // namespace slicelens
