// What boxes of the displayed volume cover of the picture, and between which depths.
#pragma once

#include "render/prepare.h"

#include <limits>
#include <vector>

namespace slicelens {

/// What a box of texture coordinates of the displayed volume covers: pixels from the bottom left corner, and
/// depths in slice distances from the plane between planes −1 and 0.
struct ScreenCover {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
  double near = std::numeric_limits<double>::infinity();
  double far = -std::numeric_limits<double>::infinity();
};

class ScreenProjector {
public:
  explicit ScreenProjector(const PreparedScene& prepared);
  ScreenCover cover(const glm::dvec3& low, const glm::dvec3& high) const;

private:
  glm::dmat4 clip_from_texture_;
  glm::dvec2 size_;
  glm::dvec4 distance_{0};
  double eye_ = 0;
};

/// Whether some half-space leaves nothing of a box.
bool is_cut_away(const std::vector<Plane>& planes, const glm::dvec3& low, const glm::dvec3& high);

} // namespace slicelens
