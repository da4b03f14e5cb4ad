// Grids of displacements as 3D textures.
#pragma once

#include "gl/texture.h"
#include "render/warp_glsl.h"
#include "warp/warp.h"

#include <vector>

namespace slicelens {

/// RGBA32F, one for each grid among the maps, in their order. Throws LimitError where the driver has no room,
/// UsageError for more than max_grids.
std::vector<gl::Texture> upload_grids(const gl::Functions& gl, const std::vector<WarpMap>& maps);

/// Binds them to the units that set_warp_maps names.
void bind_grids(const gl::Functions& gl, const std::vector<gl::Texture>& grids,
                const std::vector<GLenum>& units = grid_units);

/// Bytes of all of them.
std::size_t grid_bytes(const std::vector<WarpMap>& maps);

} // namespace slicelens
