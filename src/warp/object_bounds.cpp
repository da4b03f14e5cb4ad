#include "warp/object_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

namespace slicelens {

namespace {

/// Nothing.
Bounds empty_bounds() {
  return {glm::dvec3(std::numeric_limits<double>::infinity()),
          glm::dvec3(-std::numeric_limits<double>::infinity())};
}

void include(Bounds& bounds, const glm::dvec3& point) {
  bounds.low = glm::min(bounds.low, point);
  bounds.high = glm::max(bounds.high, point);
}

Bounds joined(const Bounds& a, const Bounds& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

glm::dvec3 corner(const Bounds& box, int k) {
  return glm::mix(box.low, box.high, glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1));
}

/// [least, largest] of cos over [low, high], low ≤ high.
glm::dvec2 cosine_range(double low, double high) {
  constexpr double turn = 2 * std::numbers::pi;
  const double a = std::cos(low);
  const double b = std::cos(high);
  const bool peak = std::ceil(low / turn) * turn <= high;
  const bool valley = std::ceil((low - turn / 2) / turn) * turn + turn / 2 <= high;
  return {valley ? -1 : std::min(a, b), peak ? 1 : std::max(a, b)};
}

/// Extent of the box along a direction that is an axis with a sense, from `origin`.
glm::dvec2 extent_along(const Bounds& box, const glm::dvec3& origin, const glm::dvec3& direction) {
  const double a = glm::dot(box.low - origin, direction);
  const double b = glm::dot(box.high - origin, direction);
  return {std::min(a, b), std::max(a, b)};
}

/// Adds the points origin + x·e + y·f of the box with those coordinates along e and f, and the box's own
/// across them.
void include_plane(Bounds& bounds, const Bounds& box, const glm::dvec3& origin, const glm::dvec3& e,
                   const glm::dvec3& f, const glm::dvec2& xs, const glm::dvec2& ys) {
  const glm::dvec3 across = glm::dvec3(1) - glm::abs(e) - glm::abs(f);
  for (const double x : {xs.x, xs.y}) {
    for (const double y : {ys.x, ys.y}) {
      const glm::dvec3 point = origin * (glm::dvec3(1) - across) + x * e + y * f;
      include(bounds, point + box.low * across);
      include(bounds, point + box.high * across);
    }
  }
}

/// Adds an arc about the axis (radius, 0): the points (radius − arm·cos θ, arm·sin θ) for arms and angles in
/// ranges. All four are extreme where the arm is.
void include_arc(Bounds& bounds, const Bounds& box, const glm::dvec3& origin, const glm::dvec3& e,
                 const glm::dvec3& f, double radius, const glm::dvec2& arms, const glm::dvec2& angles) {
  const glm::dvec2 c = cosine_range(angles.x, angles.y);
  const glm::dvec2 s = cosine_range(angles.x - std::numbers::pi / 2, angles.y - std::numbers::pi / 2);
  for (const double arm : {arms.x, arms.y}) {
    include_plane(bounds, box, origin, e, f, {radius - arm * c.x, radius - arm * c.y},
                  {arm * s.x, arm * s.y});
  }
}

template <class Map>
void include_corners(Bounds& bounds, const Map& map, const Bounds& box) {
  for (int k = 0; k < 8; ++k)
    include(bounds, object_from_texture(map, corner(box, k)));
}

Bounds bounds_of(const ShiftMap& map, const Bounds& box) {
  return {box.low + map.offset, box.high + map.offset};
}

Bounds bounds_of(const SineMap& map, const Bounds& box) {
  const glm::dvec3 reach = std::abs(map.amplitude) * map.axis;
  return {box.low - reach, box.high + reach};
}

/// Each corner of the cross-section goes along a circle.
Bounds bounds_of(const TwistMap& map, const Bounds& box) {
  const glm::dvec2 along = extent_along(box, map.center, map.axis);
  const double a = map.turn * along.x;
  const double b = map.turn * along.y;
  const glm::dvec2 angles(std::min(a, b), std::max(a, b));
  Bounds bounds = empty_bounds();
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 point = corner(box, k);
    const glm::dvec3 level = map.center + map.axis * glm::dot(point - map.center, map.axis);
    const glm::dvec3 arm = point - level;
    const glm::dvec3 side = glm::cross(map.axis, arm);
    glm::dvec3 low = level;
    glm::dvec3 high = level;
    for (int i = 0; i < 3; ++i) {
      // arm·cos + side·sin = |(arm, side)|·cos(angle − start).
      const double start = std::atan2(side[i], arm[i]);
      const glm::dvec2 range = std::hypot(arm[i], side[i]) * cosine_range(angles.x - start, angles.y - start);
      low[i] += range.x;
      high[i] += range.y;
    }
    include(bounds, low);
    include(bounds, high);
  }
  return bounds;
}

Bounds bounds_of(const BendMap& map, const Bounds& box) {
  if (map.curvature == 0)
    return box;
  Bounds bounds = empty_bounds();
  include_corners(bounds, map, box); // of the straight parts
  const glm::dvec2 x = extent_along(box, map.center, map.toward);
  const glm::dvec2 y = glm::clamp(extent_along(box, map.center, map.axis), -map.half_length, map.half_length);
  const double radius = 1 / map.curvature;
  const double a = y.x / radius;
  const double b = y.y / radius;
  include_arc(bounds, box, map.center, map.toward, map.axis, radius, {radius - x.x, radius - x.y},
              {std::min(a, b), std::max(a, b)});
  return bounds;
}

Bounds with_sphere(const Bounds& box, const glm::dvec3& center, double radius) {
  const glm::dvec3 nearest = glm::clamp(center, box.low, box.high);
  if (glm::distance(nearest, center) >= radius)
    return box;
  return joined(box, {center - radius, center + radius});
}

Bounds bounds_of(const PulseMap& map, const Bounds& box) { return with_sphere(box, map.center, map.radius); }
Bounds bounds_of(const ExpanderMap& map, const Bounds& box) {
  return with_sphere(box, map.center, map.radius);
}

Bounds bounds_of(const SpreaderMap& map, const Bounds& box) {
  const glm::dvec2 x = extent_along(box, map.center, map.toward);
  const glm::dvec2 y = extent_along(box, map.center, map.axis);
  if (x.y <= 0)
    return box;
  // Angles from `toward` grow, so x shrinks, down to 0; distances from the hinge stay.
  const auto reach = [&](double side) { return map.half_gap + std::hypot(x.y, std::max(side, 0.0)); };
  Bounds bounds = box;
  include_plane(bounds, box, map.center, map.toward, map.axis, {std::min(x.x, 0.0), x.y},
                {y.x < 0 ? -reach(-y.x) : y.x, y.y > 0 ? reach(y.y) : y.y});
  return bounds;
}

/// Leaves move rigidly: their corners bound them.
Bounds bounds_of(const LeaferMap& map, const Bounds& box) {
  const glm::dvec2 x = glm::max(extent_along(box, map.spine, map.toward), 0.0);
  const glm::dvec2 y = glm::clamp(extent_along(box, map.spine, map.axis), 0.0, map.thickness * map.leaves);
  Bounds bounds = empty_bounds();
  shared::LeaferFunctions<double> functions;
  for (int leaf = 0; leaf < map.leaves; ++leaf) {
    const double low = std::max(y.x, map.thickness * leaf);
    const double high = std::min(y.y, map.thickness * (leaf + 1));
    if (low > high)
      continue;
    const glm::dvec2 turn = functions.leafer_turn(map, leaf);
    for (const double px : {x.x, x.y}) {
      for (const double py : {low, high}) {
        const glm::dvec2 shown(px * turn.x - py * turn.y, px * turn.y + py * turn.x);
        include_plane(bounds, box, map.spine, map.toward, map.axis, glm::dvec2(shown.x), glm::dvec2(shown.y));
      }
    }
  }
  return bounds.low.x <= bounds.high.x ? bounds : box;
}

Bounds bounds_of(const PeelerMap& map, const Bounds& box) {
  const glm::dvec2 x = glm::clamp(extent_along(box, map.center, map.toward), 0.0, map.radius);
  const glm::dvec2 y = glm::max(extent_along(box, map.center, map.axis), 0.0);
  Bounds bounds = box;
  const glm::dvec2 angles(std::min(y.x / map.radius, map.angle), std::min(y.y / map.radius, map.angle));
  include_arc(bounds, box, map.center, map.toward, map.axis, map.radius, {map.radius - x.x, map.radius - x.y},
              angles);
  // The end of the straight part.
  for (const double ux : {x.x, x.y}) {
    const glm::dvec3 u = map.center + ux * map.toward + y.y * map.axis;
    const glm::dvec3 shown = object_from_texture(map, u) - map.center;
    include_plane(bounds, box, map.center, map.toward, map.axis, glm::dvec2(glm::dot(shown, map.toward)),
                  glm::dvec2(glm::dot(shown, map.axis)));
  }
  return bounds;
}

template <class Map, class... Maps>
constexpr bool is_one_of = (std::is_same_v<Map, Maps> || ...);

Bounds bounds_of(const GridMap& map, const Bounds& box) {
  Bounds bounds;
  grid_bounds(*map.grid, box.low, box.high, bounds.low, bounds.high);
  // What is shown may end within the box; slices and rays still cover all of it.
  return {glm::min(bounds.low, box.low), glm::max(bounds.high, box.high)};
}

/// Maps that take every box which holds the volume's own onto itself, and a lens whose footprint the caller
/// adds. A new map has to say what it does.
template <class Map>
requires is_one_of<Map, LamarMap, BifocalMap, FisheyeMap, VolumeLensMap, ConnectedLensMap>
    Bounds bounds_of(const Map&, const Bounds& box) {
  return box;
}

} // namespace

Bounds object_bounds(const WarpMap& map, const Bounds& box) {
  return std::visit([&](const auto& value) { return bounds_of(value, box); }, map);
}

// Outer radius (a square's corners reach √2 farther) at the deeper end, where perspective makes it largest.
Bounds footprint_bounds(const LamarMap& map) {
  Bounds bounds = empty_bounds();
  for (const double z : {-map.depth_outer, map.depth_outer}) {
    const LensPlane plane = lens_plane(map, z);
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        include(bounds,
                plane.axis_point + (map.outer * std::max(plane.scale, 0.0)) * (x * map.right + y * map.up));
      }
    }
  }
  return bounds;
}

} // namespace slicelens
