#include "render/ray_frame.h"

#include "slicing/slice_stack.h"

namespace slicelens {

RayFrameValues ray_frame(const PreparedScene& prepared) {
  const View& view = prepared.view;
  const glm::dmat4 texture_from_world = slicelens::texture_from_world(prepared.box);
  const glm::dmat3 turn(texture_from_world);
  const glm::dvec3 middle = center(prepared.box);
  RayFrameValues frame;
  frame.forward = turn * view.forward;
  frame.right = turn * (half_width(view) * view.right);
  frame.up = turn * (view.half_height * view.up);
  frame.half_width = half_width(view);
  frame.half_height = view.half_height;
  frame.anchor = glm::length(view.eye - middle);
  // Orthographic anchors lie on the plane through the box centre, perspective ones on the sphere about the
  // eye through it, so that sample distances stay small.
  const double to_anchor = view.projection == Projection::perspective ? frame.anchor : depth(view, middle);
  const glm::dvec3 anchor = view.eye + to_anchor * view.forward;
  frame.center = glm::dvec3(texture_from_world * glm::dvec4(anchor, 1));
  return frame;
}

void check_sample_count(const PreparedScene& prepared) {
  // Rays are at most as long as the displayed volume's diagonal.
  const glm::dvec3 size = (prepared.object_high - prepared.object_low) * extent(prepared.box);
  plane_range({0, glm::length(size)}, prepared.spacing);
}

} // namespace slicelens
