// The OpenGL functions as one plain value per context.
//
// Written once per context by load_functions and passed around as `const Functions& gl`, so a call reads
// `gl.DrawElements(...)`. There is no global table: two contexts of different drivers can live side by side.
#pragma once

#include <GL/glcorearb.h>

#include <functional>
#include <string>
#include <vector>

namespace slicelens::gl {

/// Every core function of OpenGL 1.0 to 4.5, named as in the specification without the prefix `gl`. All
/// of 3.3 are set; a later one is null unless the context's version has it, so callers test before the call:
/// `if (gl.TexStorage3D != nullptr)`.
struct Functions {
#define SLICELENS_GL_FUNCTION(version, name, type) type name = nullptr;
#include <gl_function_list.inc>
#undef SLICELENS_GL_FUNCTION
};

using AnyFunction = void (*)();
/// Gives the address of a GL function by its full name ("glClear"), or null.
using GetProcAddress = std::function<AnyFunction(const char* name)>;

/// Fills the table for the context that is current on this thread. Versions above the context's own are left
/// null even where an address exists, because EGL and GLX hand out addresses for any name. Throws
/// GraphicsError when the context is older than 3.3 or lacks one of its functions, naming it.
Functions load_functions(const GetProcAddress& address);

/// Names of the table's functions of one version, for instance 33 for OpenGL 3.3, that are null in `gl`.
std::vector<std::string> missing_functions(const Functions& gl, int version);

} // namespace slicelens::gl
