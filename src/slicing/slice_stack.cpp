#include "slicing/slice_stack.h"

#include "core/errors.h"
#include "core/text.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace slicelens {

PlaneRange plane_range(const Interval& distance_range, double spacing) {
  if (!(spacing > 0) || !std::isfinite(spacing)) {
    throw UsageError("the slice distance must be positive and finite, not " + number_text(spacing));
  }
  const double first = std::ceil(distance_range.near / spacing - 0.5);
  const double last = std::floor(distance_range.far / spacing - 0.5);
  if (!(last - first < static_cast<double>(max_planes)) || !(std::abs(first) < 1e15)) {
    throw UsageError("render.spacing is too fine: it would take more than " + std::to_string(max_planes) +
                     " slices; make it larger");
  }
  return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(last)};
}

SliceStack make_slice_stack(const SliceRequest& request) {
  const View& view = request.view;
  const double anchor = depth(view, center(request.box));
  const bool whole = request.low == glm::dvec3(0) && request.high == glm::dvec3(1);
  const glm::dmat4 texture_from_region =
      glm::scale(glm::translate(glm::dmat4(1), request.low), request.high - request.low);
  const Box region{whole ? request.box.world_from_texture
                         : request.box.world_from_texture * texture_from_region};
  Interval range{0, 0};
  for (const glm::dvec3& corner : corners(region)) {
    const double distance = depth(view, corner) - anchor;
    range.near = std::min(range.near, distance);
    range.far = std::max(range.far, distance);
  }
  if (view.projection == Projection::perspective) {
    range.near = std::max(range.near, -anchor + 1e-3 * request.spacing);
  }
  const PlaneRange planes = plane_range(range, request.spacing);

  SliceStack stack;
  const std::int64_t count = planes.last - planes.first + 1;
  for (std::int64_t i = 0; i < count; ++i) {
    Slice slice;
    slice.index = request.order == SliceOrder::front_to_back ? planes.first + i : planes.last - i;
    slice.distance = (static_cast<double>(slice.index) + 0.5) * request.spacing;
    const Plane world{view.forward, glm::dot(view.forward, view.eye) + anchor + slice.distance};
    Polygon polygon = cut_unit_cube(pull_back(world, region.world_from_texture));
    if (!whole) {
      for (glm::dvec3& corner : polygon)
        corner = request.low + corner * (request.high - request.low);
    }
    for (const Plane& plane : request.clip)
      polygon = clip(polygon, plane);
    if (polygon.empty())
      continue;
    slice.first = static_cast<std::uint32_t>(stack.corners.size());
    slice.count = static_cast<std::uint32_t>(polygon.size());
    stack.corners.insert(stack.corners.end(), polygon.begin(), polygon.end());
    stack.slices.push_back(slice);
  }
  return stack;
}

double sample_distance_ratio(const View& view, double x, double y) {
  return 1.0 / glm::dot(ray_from_pixel(view, x, y).direction, view.forward);
}

} // namespace slicelens
