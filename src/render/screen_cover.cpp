#include "render/screen_cover.h"

#include "render/stack_geometry.h"

#include <algorithm>

namespace slicelens {

namespace {

glm::dvec3 corner(const glm::dvec3& low, const glm::dvec3& high, int k) {
  return glm::mix(low, high, glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1));
}

} // namespace

bool is_cut_away(const std::vector<Plane>& planes, const glm::dvec3& low, const glm::dvec3& high) {
  return std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    const glm::dvec3 farthest = glm::mix(low, high, glm::greaterThan(plane.normal, glm::dvec3(0)));
    return signed_value(plane, farthest) < -1e-9 * glm::length(plane.normal);
  });
}

ScreenProjector::ScreenProjector(const PreparedScene& prepared)
    : clip_from_texture_(slicelens::clip_from_texture(prepared)),
      size_(prepared.view.width, prepared.view.height) {
  const View& view = prepared.view;
  const glm::dmat4& world_from_texture = prepared.box.world_from_texture;
  const glm::dvec3 slope = glm::transpose(glm::dmat3(world_from_texture)) * view.forward;
  const double offset = depth(view, glm::dvec3(world_from_texture[3])) - depth(view, center(prepared.box));
  distance_ = glm::dvec4(slope, offset) / prepared.spacing;
  eye_ = view.projection == Projection::perspective ? -depth(view, center(prepared.box)) / prepared.spacing
                                                    : -std::numeric_limits<double>::infinity();
}

ScreenCover ScreenProjector::cover(const glm::dvec3& low, const glm::dvec3& high) const {
  ScreenCover cover;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec4 point(corner(low, high, k), 1);
    const double distance = glm::dot(distance_, point);
    cover.near = std::min(cover.near, distance);
    cover.far = std::max(cover.far, distance);
    const glm::dvec4 clip = clip_from_texture_ * point;
    const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size_;
    cover.low = glm::min(cover.low, pixel);
    cover.high = glm::max(cover.high, pixel);
  }
  // At the eye and behind it corners say nothing about what is seen.
  if (cover.near <= eye_ + 1e-3) {
    cover.low = glm::dvec2(0);
    cover.high = size_;
  }
  return cover;
}

} // namespace slicelens
