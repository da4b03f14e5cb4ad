// What the driver can do at best on this machine: squares drawn over a whole picture and blended.
#pragma once

#include "gl/program.h"
#include "gl/target.h"
#include "gl/texture.h"

#include <array>
#include <memory>
#include <vector>

namespace slicelens {

/// Fragments a second, into a target of RGBA32F.
struct FillRates {
  double untextured = 0; ///< a constant colour
  double textured = 0;   ///< a trilinear fetch of R16
  double classified = 0; ///< and its colour from a table of RGBA32F: the inner loop of every slice
};

/// Programs and textures of the three fills. `gl` must outlive it.
class FillLimits {
public:
  /// Throws GraphicsError.
  explicit FillLimits(const gl::Functions& gl);

  /// Draws each fill twice and times the second, 16.8 million fragments each.
  FillRates measure() const;

private:
  const gl::Functions* gl_;
  std::array<gl::Program, 3> programs_;
  gl::Texture volume_;
  gl::Texture table_;
  gl::Target target_;
  gl::VertexArray no_vertices_;
};

} // namespace slicelens
