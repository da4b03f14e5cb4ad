// Internal to src/gl: the makers of the native contexts. Each returns a context that is not yet current, or
// throws GraphicsError with one line that says why there is none.
#pragma once

#include "gl/context.h"

#include <array>
#include <utility>

namespace slicelens::gl {

std::unique_ptr<NativeContext> open_osmesa(Profile profile);
std::unique_ptr<NativeContext> open_egl_surfaceless(Profile profile);
std::unique_ptr<NativeContext> open_egl_device(Profile profile);
std::unique_ptr<NativeContext> open_window(Profile profile);

/// Versions asked for, best first: some drivers give exactly what is asked, and most refuse what they lack.
inline constexpr std::array<std::pair<int, int>, 5> wanted_versions = {
    {{4, 6}, {4, 5}, {4, 3}, {4, 1}, {3, 3}}};

} // namespace slicelens::gl
