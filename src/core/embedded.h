// Texts compiled into the program (shaders, scenes): see cmake/SlicelensEmbed.cmake.
#pragma once

#include <string>
#include <vector>

namespace slicelens {

struct EmbeddedFile {
  std::string name; ///< path relative to the embedded folder, for instance "lib/composite.glsl"
  std::string text;
};

} // namespace slicelens
