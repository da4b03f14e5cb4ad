// What part of the data a lens shows magnified.
#pragma once

#include "tess/lens_mesh.h"

#include <optional>

namespace slicelens {

/// An axis-aligned part of texture space; may reach beyond [0,1]³.
struct TextureBox {
  glm::dvec3 low{0};
  glm::dvec3 high{1};
};

/// Bounds of the data that the lens shows magnified by more than q ≥ 1, by the exact profile or by the
/// tessellation, whichever reaches farther; nothing where the lens does not magnify that much. Conservative:
/// contains all of it, at most a little more (the depth is taken in 64 steps).
std::optional<TextureBox> magnified_data(const LensTessellation& lens, const BoxSpace& space, double q);

} // namespace slicelens
