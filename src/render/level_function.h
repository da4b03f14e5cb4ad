// shaders/lib/levels.glsl compiled as C++, in double.
#pragma once

#include <glm/glm.hpp>

#include <cmath>

namespace slicelens {

namespace level_names {
using namespace glm;
using real = double;
using vec3 = glm::dvec3;
using mat3 = glm::dmat3;
struct LevelFunction {
#include "lib/levels.glsl"
};
} // namespace level_names

using level_names::LevelFunction;

} // namespace slicelens
