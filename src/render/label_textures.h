// The labels of a scene as textures (shaders/gpu/labels.glsl).
#pragma once

#include "gl/program.h"
#include "gl/texture.h"
#include "render/prepare.h"

namespace slicelens {

struct LabelTextures {
  gl::Texture labels; ///< 3D, unsigned integers of 8 bits: the row of each voxel
  gl::Texture table;  ///< 2D, straight RGBA: the transfer function of each row
  gl::Texture rows;   ///< 2D, two texels of four floats for each row
  std::size_t bytes = 0;
};

/// Nothing under other modes than `two-level`. Throws LimitError where the driver has no room.
LabelTextures upload_labels(const gl::Functions& gl, const PreparedScene& prepared, const Progress& progress);

/// Binds them and sets what shaders/gpu/labels.glsl declares. The program must be in use. `rows_of_voxels`:
/// textures.labels, or the labels beside the bricks of a pool.
void set_labels(const gl::Functions& gl, const gl::Program& program, const LabelTextures& textures,
                const gl::Texture& rows_of_voxels);

} // namespace slicelens
