// GLSL programs from the texts in shaders/.
#pragma once

#include "core/embedded.h"
#include "gl/program.h"

#include <string>
#include <vector>

namespace slicelens {

/// One stage: an entry file of shaders/ and the macros it is compiled with ("NAME" or "NAME value").
/// `generated`: files that the host writes (render/warp_glsl.h), found before those of shaders/. Includes are
/// expanded, so that the driver sees #version, the macros, `#define real float`, and the texts. Throws
/// GraphicsError when a file does not exist in the program.
std::vector<gl::ShaderSource> shader_stage(GLenum stage, const std::string& entry,
                                           const std::vector<std::string>& macros,
                                           const std::vector<EmbeddedFile>& generated = {});

} // namespace slicelens
