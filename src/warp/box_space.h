// Box space, in which warps are evaluated (docs/pipeline.md): the displayed volume scaled so that its longest
// edge is 1 and circles are circles, whatever the voxels' shape.
#pragma once

#include "core/box.h"
#include "core/view.h"

#include <glm/glm.hpp>

namespace slicelens {

/// b = t ∘ extent / longest edge. Its axes are the volume's own.
struct BoxSpace {
  glm::dvec3 size{1}; ///< extent / longest edge: the far corner of the box, each in (0, 1]
  double longest = 1; ///< world units in one unit of box space
  glm::dmat4 box_from_world{1};

  bool operator==(const BoxSpace&) const = default;
};

BoxSpace box_space(const Box& box);

glm::dvec3 box_from_texture(const BoxSpace& space, const glm::dvec3& t);
glm::dvec3 texture_from_box(const BoxSpace& space, const glm::dvec3& b);

/// A view seen in box space: directions are unit vectors there.
struct WarpView {
  bool perspective = false;
  glm::dvec3 eye{0};
  glm::dvec3 forward{0, 1, 0};
  glm::dvec3 right{1, 0, 0};
  glm::dvec3 up{0, 0, 1};
};

/// Boxes with right angles keep angles; for sheared ones the directions are those of the axes.
WarpView warp_view(const View& view, const Box& box);

} // namespace slicelens
