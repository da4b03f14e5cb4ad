// Random lenses and views, and LaMar's lens written a second time from docs/papers/lamar.md, to hold the
// program to.
#pragma once

#include "warp/lamar.h"

#include <glm/gtc/matrix_transform.hpp>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

namespace lens_cases {

using namespace slicelens;

inline double random_in(double low, double high) {
  return low + (high - low) * static_cast<double>(*rc::gen::inRange(0, 1'000'001)) / 1e6;
}

inline bool random_bool() { return *rc::gen::inRange(0, 2) == 1; }

/// Uniform on the sphere. Without rejection: a failing case is shrunk towards equal numbers, for ever if
/// refused.
inline glm::dvec3 random_direction() {
  const double z = random_in(-1, 1);
  const double angle = random_in(0, 6.28);
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// A lens seen in a box: everything that a map is made from.
struct LensCase {
  LamarLens lens;
  Box box;
  View view;
  BoxSpace space;
  WarpView warp;
  LamarMap map;
};

inline LensCase make_case(const LamarLens& lens, const Box& box, const View& view) {
  LensCase c{lens, box, view, box_space(box), warp_view(view, box), {}};
  c.map = lamar_map(lens, c.space, c.warp);
  return c;
}

/// Looks along +y, x to the right and z up, at the unit box.
inline View front_view() {
  View view;
  view.eye = {0.5, -3, 0.5};
  return view;
}

inline View random_view(const Box& box) {
  View view;
  view.forward = random_direction();
  // Any axis away from the viewing direction, then a turn about it.
  const glm::dvec3 axis = std::abs(view.forward.z) < 0.8 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(view.forward, axis));
  const double turn = random_in(0, 6.28);
  view.right = std::cos(turn) * side + std::sin(turn) * glm::cross(side, view.forward);
  view.up = glm::cross(view.right, view.forward);
  view.projection = random_bool() ? Projection::perspective : Projection::orthographic;
  // Near enough for radii to change much over the box, with every lens in front of the eye.
  view.eye = center(box) - view.forward * (random_in(1.6, 4) * bounding_radius(box)) +
             0.2 * bounding_radius(box) * view.right;
  view.half_height = 0.4;
  return view;
}

/// Right angles, any proportions and turn.
inline Box random_box() {
  const glm::dvec3 dims(*rc::gen::inRange(4, 40), *rc::gen::inRange(4, 40), *rc::gen::inRange(4, 40));
  const glm::dvec3 spacing(random_in(0.5, 2), random_in(0.5, 2), random_in(0.5, 2));
  const glm::dmat3 turn(glm::rotate(glm::dmat4(1), random_in(0, 3), random_direction()));
  return make_box(dims, spacing, {1, 2, 3}, turn);
}

/// `widest`: largest outer radius. Borders are at least .05 wide.
inline LamarLens random_lens(double widest) {
  LamarLens lens;
  lens.shape = random_bool() ? LensShape::circle : LensShape::square;
  lens.border = *rc::gen::element(LensBorder::simple, LensBorder::linear, LensBorder::cubic);
  lens.zoom = random_in(1, 8);
  lens.outer = random_in(0.1, widest);
  lens.inner = random_in(0.03, lens.outer - 0.05);
  if (random_bool()) {
    lens.depth_inner = random_in(0, 0.2);
    lens.depth_outer = *lens.depth_inner + random_in(0.05, 0.3);
  }
  lens.center = {random_in(0, 1), random_in(0, 1), random_in(0, 1)};
  lens.angular_segments = static_cast<std::size_t>(*rc::gen::element(3, 4, 5, 8, 13, 32));
  lens.radial_segments = static_cast<std::size_t>(*rc::gen::inRange(1, 7));
  lens.bounded = random_bool();
  return lens;
}

inline LensCase random_case(double widest) {
  const Box box = random_box();
  return make_case(random_lens(widest), box, random_view(box));
}

inline double depth_inner(const LamarLens& lens) { return lens.depth_inner.value_or(lens.inner); }
inline double depth_outer(const LamarLens& lens) { return lens.depth_outer.value_or(lens.outer); }

/// Q on the plane at depth distance d (docs/papers/lamar.md, "3D").
inline double zoom_at(const LamarLens& lens, double d) {
  if (d <= depth_inner(lens))
    return lens.zoom;
  if (d >= depth_outer(lens))
    return 1;
  const double x = (d - depth_inner(lens)) / (depth_outer(lens) - depth_inner(lens));
  const double w = lens.border == LensBorder::cubic ? 3 * x * x - 2 * x * x * x : x;
  return 1 / (1 / lens.zoom + (1 - 1 / lens.zoom) * w);
}

/// f(r); the cubic as a Bézier curve by de Casteljau's construction, as the paper has it (§3.4).
inline double profile(const LamarLens& lens, double zoom, double r) {
  const double width = lens.outer - lens.inner;
  const double x = (r - lens.inner) / width;
  if (x <= 0)
    return r / zoom;
  if (x >= 1)
    return r;
  if (lens.border == LensBorder::simple)
    return r / (zoom + (1 - zoom) * x);
  const double first = lens.inner / zoom;
  const double last = lens.outer;
  if (lens.border == LensBorder::linear)
    return first + (last - first) * x;
  const double a = first;
  const double b = first + width / (3 * zoom);
  const double c = last - width / 3;
  const auto mix = [x](double p, double q) { return p + (q - p) * x; };
  return mix(mix(mix(a, b), mix(b, c)), mix(mix(b, c), mix(c, last)));
}

/// A point of box space as the lens sees it: (x, y) in radii at the centre's depth.
struct Across {
  glm::dvec3 axis_point{0};
  double x = 0;
  double y = 0;
  double depth = 0; ///< signed, from the centre
  double scale = 1; ///< of the radii
};

inline Across across_of(const LensCase& c, const glm::dvec3& p) {
  const glm::dvec3 center = c.lens.center * c.space.size;
  Across a;
  a.depth = glm::dot(p - center, c.warp.forward);
  if (c.warp.perspective) {
    const double d = glm::dot(center - c.warp.eye, c.warp.forward);
    a.scale = (d + a.depth) / d;
    a.axis_point = c.warp.eye + (center - c.warp.eye) * a.scale; // on the line of sight through the centre
  } else {
    a.axis_point = center + a.depth * c.warp.forward;
  }
  a.x = glm::dot(p - a.axis_point, c.warp.right) / a.scale;
  a.y = glm::dot(p - a.axis_point, c.warp.up) / a.scale;
  return a;
}

inline double radius_of(const LensCase& c, const Across& a) {
  return c.lens.shape == LensShape::square ? std::max(std::abs(a.x), std::abs(a.y)) : std::hypot(a.x, a.y);
}

/// A point of box space from depth and (x, y) in radii.
inline glm::dvec3 point_at(const LensCase& c, double depth, double x, double y) {
  const glm::dvec3 center = c.lens.center * c.space.size;
  glm::dvec3 axis = center + depth * c.warp.forward;
  double scale = 1;
  if (c.warp.perspective) {
    const double d = glm::dot(center - c.warp.eye, c.warp.forward);
    scale = (d + depth) / d;
    axis = c.warp.eye + (center - c.warp.eye) * scale;
  }
  return axis + scale * (x * c.warp.right + y * c.warp.up);
}

/// A point in or a little beside the lens.
inline glm::dvec3 random_point(const LensCase& c) {
  const double reach = 1.2 * c.lens.outer;
  return point_at(c, random_in(-1.2, 1.2) * depth_outer(c.lens), random_in(-reach, reach),
                  random_in(-reach, reach));
}

/// The inverse map by docs/papers/lamar.md.
inline glm::dvec3 expected_texture(const LensCase& c, const glm::dvec3& p) {
  const Across a = across_of(c, p);
  const double r = radius_of(c, a);
  if (r == 0 || r >= c.lens.outer || std::abs(a.depth) >= depth_outer(c.lens))
    return p;
  const double ratio = profile(c.lens, zoom_at(c.lens, std::abs(a.depth)), r) / r;
  return a.axis_point + ratio * (p - a.axis_point);
}

} // namespace lens_cases
