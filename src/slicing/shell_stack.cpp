#include "slicing/shell_stack.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace slicelens {

namespace {

using SeenBox = std::array<glm::dvec3, 8>; ///< corner k: (k&1, k>>1&1, k>>2&1) of low and high

/// Corners as (right, up, forward) of the eye, world units.
SeenBox seen_box(const SliceRequest& request) {
  const View& view = request.view;
  SeenBox box;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 t = glm::mix(request.low, request.high, glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1));
    const glm::dvec3 to = world_from_texture(request.box, t) - view.eye;
    box[static_cast<std::size_t>(k)] = {glm::dot(to, view.right), glm::dot(to, view.up),
                                        glm::dot(to, view.forward)};
  }
  return box;
}

/// The corners of the part of the box between two depths, projected to (right, up)/forward. near > 0.
std::vector<glm::dvec3> slab_corners(const SeenBox& box, double near, double far) {
  std::vector<glm::dvec3> points;
  const auto add = [&](const glm::dvec3& p) { points.emplace_back(p.x / p.z, p.y / p.z, 0); };
  for (std::size_t k = 0; k < 8; ++k) {
    const glm::dvec3& a = box[k];
    if (a.z >= near && a.z <= far)
      add(a);
    for (std::size_t axis = 1; axis < 8; axis *= 2) {
      const glm::dvec3& b = box[k ^ axis];
      if ((k & axis) != 0)
        continue;
      for (const double depth : {near, far}) {
        if ((a.z < depth) != (b.z < depth))
          add(glm::mix(a, b, (depth - a.z) / (b.z - a.z)));
      }
    }
  }
  return points;
}

/// The hull of the points, wider by `margin`, within the picture.
Polygon covered(const std::vector<glm::dvec3>& points, const glm::dvec2& half, const glm::dvec2& margin) {
  std::vector<glm::dvec3> wider;
  wider.reserve(4 * points.size());
  for (const glm::dvec3& p : points) {
    for (const double x : {-margin.x, margin.x}) {
      for (const double y : {-margin.y, margin.y})
        wider.emplace_back(p.x + x, p.y + y, 0);
    }
  }
  Polygon polygon = convex_hull(std::move(wider));
  for (const Plane& edge : {Plane{{1, 0, 0}, -half.x - margin.x}, Plane{{-1, 0, 0}, -half.x - margin.x},
                            Plane{{0, 1, 0}, -half.y - margin.y}, Plane{{0, -1, 0}, -half.y - margin.y}})
    polygon = clip(polygon, edge);
  return polygon;
}

} // namespace

Polygon convex_hull(std::vector<glm::dvec3> points) {
  // Monotone chain (Andrew 1979).
  std::sort(points.begin(), points.end(),
            [](const glm::dvec3& a, const glm::dvec3& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto turn = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  };
  Polygon hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    if (!hull.empty())
      hull.pop_back(); // it begins the other chain
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull;
}

SliceStack make_shell_stack(const SliceRequest& request, double plane_depth) {
  const View& view = request.view;
  const SeenBox box = seen_box(request);
  const double anchor = glm::length(view.eye - center(request.box));
  const glm::dvec2 half(half_width(view), view.half_height);
  const glm::dvec2 pixel = 2.0 * half / glm::dvec2(view.width, view.height);
  const double cosine = 1 / std::sqrt(1 + glm::dot(half + pixel, half + pixel));
  Interval radii{std::numeric_limits<double>::infinity(), 0}; // what the box lies between, conservatively
  for (const glm::dvec3& corner : box) {
    radii.near = std::min(radii.near, std::max(corner.z, 1e-3 * request.spacing));
    radii.far = std::max(radii.far, glm::length(corner));
  }
  const PlaneRange shells = plane_range({radii.near - anchor, radii.far - anchor}, request.spacing);

  const glm::dmat4 to_texture = texture_from_world(request.box);
  SliceStack stack;
  const std::int64_t count = shells.last - shells.first + 1;
  for (std::int64_t i = 0; i < count; ++i) {
    Slice slice;
    slice.index = request.order == SliceOrder::front_to_back ? shells.first + i : shells.last - i;
    slice.distance = (static_cast<double>(slice.index) + 0.5) * request.spacing;
    const double radius = anchor + slice.distance;
    // A little wider than the slab, or rounding could lose a face of the box that is seen edge on.
    const Polygon polygon =
        covered(slab_corners(box, radius * cosine * (1 - 1e-9), radius * (1 + 1e-9)), half, pixel);
    if (polygon.empty())
      continue;
    slice.first = static_cast<std::uint32_t>(stack.corners.size());
    slice.count = static_cast<std::uint32_t>(polygon.size());
    for (const glm::dvec3& p : polygon) {
      const glm::dvec3 world = view.eye + plane_depth * (view.forward + p.x * view.right + p.y * view.up);
      stack.corners.emplace_back(to_texture * glm::dvec4(world, 1));
    }
    stack.slices.push_back(slice);
  }
  return stack;
}

} // namespace slicelens
