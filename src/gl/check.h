// OpenGL's error flag, turned into exceptions.
#pragma once

#include "gl/functions.h"

namespace slicelens::gl {

/// "GL_INVALID_OPERATION" for GL_INVALID_OPERATION; a number in hexadecimal for what glGetError does not
/// give.
std::string error_name(GLenum error);

/// Throws GraphicsError "<where>: GL_…" when an error is pending, and clears all pending ones. `where` says
/// what was being done ("draw slices"). glGetError waits for nothing, but call it per pass, not per draw.
void check_errors(const Functions& gl, const std::string& where);

/// Discards pending errors, so that the next check sees only its own.
void clear_errors(const Functions& gl);

} // namespace slicelens::gl
