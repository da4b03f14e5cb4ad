// Cohen's tables as textures.
#pragma once

#include "gl/texture.h"
#include "render/prepare.h"

#include <array>

namespace slicelens {

/// RGBA32F, one for each axis of the volume.
using AxisTextures = std::array<gl::Texture, 3>;

/// Cohen's tables as textures, or rewritten where `textures` has them in that size already: all that changes
/// with an effect or with the view (Cohen, Brodlie and Phillips 2008 §4). Returns the bytes uploaded.
std::size_t upload_axis_tables(const gl::Functions& gl, const PreparedScene& prepared,
                               AxisTextures& textures);

} // namespace slicelens
