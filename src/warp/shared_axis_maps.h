// GLSL of the axes' maps compiled as C++ with scalars of type Real (float or double): see
// shaders/lib/axis_maps.glsl.
#pragma once

#include <glm/glm.hpp>

/// The names that shader functions expect, for scalars of type Real.
#define SLICELENS_SHARED_NAMES(Real)                                                                         \
  using real = Real;                                                                                         \
  using vec2 = glm::vec<2, Real>;                                                                            \
  using vec3 = glm::vec<3, Real>;                                                                            \
  using mat3 = glm::mat<3, 3, Real>;

namespace slicelens::shared {

using namespace glm;

template <class Real>
struct AxisMapFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "lib/axis_maps.glsl"
};

} // namespace slicelens::shared
