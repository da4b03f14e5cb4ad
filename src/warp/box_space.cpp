#include "warp/box_space.h"

#include <algorithm>

namespace slicelens {

BoxSpace box_space(const Box& box) {
  const glm::dvec3 edges = extent(box);
  const double longest = std::max({edges.x, edges.y, edges.z});
  BoxSpace space{edges / longest, longest};
  glm::dmat4 scaling(1);
  for (int axis = 0; axis < 3; ++axis)
    scaling[axis][axis] = space.size[axis];
  space.box_from_world = scaling * texture_from_world(box);
  return space;
}

glm::dvec3 box_from_texture(const BoxSpace& space, const glm::dvec3& t) { return t * space.size; }
glm::dvec3 texture_from_box(const BoxSpace& space, const glm::dvec3& b) { return b / space.size; }

WarpView warp_view(const View& view, const Box& box) {
  const BoxSpace space = box_space(box);
  const glm::dmat4 to_texture = texture_from_world(box);
  const auto direction = [&](const glm::dvec3& world) {
    return glm::normalize(box_from_texture(space, glm::dmat3(to_texture) * world));
  };
  WarpView result;
  result.perspective = view.projection == Projection::perspective;
  result.eye = box_from_texture(space, glm::dvec3(to_texture * glm::dvec4(view.eye, 1)));
  result.forward = direction(view.forward);
  result.right = direction(view.right);
  result.up = direction(view.up);
  return result;
}

} // namespace slicelens
