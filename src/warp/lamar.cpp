#include "warp/lamar.h"

#include "core/errors.h"
#include "core/text.h"

#include <cmath>

namespace slicelens {

namespace {

using Functions = shared::LamarFunctions<double>;

void require(bool holds, const std::string& what) {
  if (!holds)
    throw UsageError("warp 'lamar': " + what);
}

bool positive(double value) { return std::isfinite(value) && value > 0; }

int border_code(LensBorder border) {
  const Functions functions;
  switch (border) {
  case LensBorder::simple:
    return functions.lamar_simple;
  case LensBorder::linear:
    return functions.lamar_linear;
  case LensBorder::cubic:
    break;
  }
  return functions.lamar_cubic;
}

/// Smallest slope of the border's profile, sampled densely; the profiles are smooth, so 1000 steps find a
/// fold.
double smallest_slope(const LamarLens& lens) {
  double smallest = 1;
  for (int i = 1; i < 1000; ++i) {
    const double r = lens.inner + (lens.outer - lens.inner) * i / 1000;
    smallest =
        std::min(smallest, radial_profile(lens.border, 1 / lens.zoom, lens.inner, lens.outer, r).slope);
  }
  return smallest;
}

} // namespace

void validate(const LamarLens& lens) {
  require(positive(lens.zoom) && lens.zoom <= 1e4,
          "zoom must be above 0 and at most 10000, not " + number_text(lens.zoom));
  require(positive(lens.inner), "inner must be a radius above 0, not " + number_text(lens.inner));
  require(positive(lens.outer) && lens.outer <= 100,
          "outer must be a radius above 0, not " + number_text(lens.outer));
  require(lens.inner < lens.outer, "inner (" + number_text(lens.inner) + ") must be smaller than outer (" +
                                       number_text(lens.outer) + ")");
  const double depth_inner = lens.depth_inner.value_or(lens.inner);
  const double depth_outer = lens.depth_outer.value_or(lens.outer);
  require(std::isfinite(depth_inner) && depth_inner >= 0,
          "depth_inner must be 0 or more, not " + number_text(depth_inner));
  require(positive(depth_outer), "depth_outer must be above 0, not " + number_text(depth_outer));
  require(depth_inner < depth_outer, "depth_inner (" + number_text(depth_inner) +
                                         ") must be smaller than depth_outer (" + number_text(depth_outer) +
                                         ")");
  for (int axis = 0; axis < 3; ++axis)
    require(std::isfinite(lens.center[axis]), "center must be three finite numbers");
  require(lens.angular_segments >= 3 && lens.angular_segments <= max_angular_segments,
          "angular_segments must be from 3 to " + std::to_string(max_angular_segments) + ", not " +
              std::to_string(lens.angular_segments));
  if (lens.radial_segments) {
    require(*lens.radial_segments >= 1 && *lens.radial_segments <= max_radial_segments,
            "radial_segments must be \"adaptive\" or from 1 to " + std::to_string(max_radial_segments) +
                ", not " + std::to_string(*lens.radial_segments));
  }
  require(lens.inner / lens.zoom < lens.outer,
          "zoom " + number_text(lens.zoom) +
              " would squeeze more into inner than outer holds; raise zoom or outer");
  require(smallest_slope(lens) >= 0,
          "zoom " + number_text(lens.zoom) + " folds the " +
              (lens.border == LensBorder::cubic ? std::string("cubic") : std::string("simple")) +
              " border over itself; raise zoom, widen the border or use border linear");
}

void validate_place(const LamarLens& lens, const BoxSpace& space) {
  const glm::dvec3 center = box_from_texture(space, lens.center);
  const glm::dvec3 outside = glm::max(glm::max(-center, center - space.size), glm::dvec3(0));
  const double reach =
      std::sqrt(2 * lens.outer * lens.outer + std::pow(lens.depth_outer.value_or(lens.outer), 2));
  require(glm::length(outside) < reach, "center lies so far outside the volume that the lens touches "
                                        "nothing; texture coordinates run from 0 to 1");
}

LamarMap lamar_map(const LamarLens& lens, const BoxSpace& space, const WarpView& view) {
  LamarMap map;
  map.center = box_from_texture(space, lens.center);
  map.forward = view.forward;
  map.right = view.right;
  map.up = view.up;
  map.axis = view.forward;
  map.center_depth = 0;
  if (view.perspective) {
    map.center_depth = glm::dot(map.center - view.eye, view.forward);
    require(map.center_depth > 0, "center lies behind the eye; move the camera or the lens");
    map.axis = (map.center - view.eye) / map.center_depth;
  }
  map.square = lens.shape == LensShape::square;
  map.border = border_code(lens.border);
  map.minification = 1 / lens.zoom;
  map.inner = lens.inner;
  map.outer = lens.outer;
  map.depth_inner = lens.depth_inner.value_or(lens.inner);
  map.depth_outer = lens.depth_outer.value_or(lens.outer);
  return map;
}

double magnification(const LamarMap& map, const glm::dvec3& p) {
  return Functions().lamar_magnification(map, p);
}

glm::dvec3 texture_from_object(const LamarMap& map, const glm::dvec3& p) {
  return Functions().lamar_texture_from_object(map, p);
}

glm::dmat3 jacobian(const LamarMap& map, const glm::dvec3& p) { return Functions().lamar_jacobian(map, p); }

glm::dvec3 object_from_texture(const LamarMap& map, const glm::dvec3& u) {
  Functions functions;
  const Functions::LamarPlace place = functions.lamar_place(map, u);
  if (place.radius >= map.outer || std::abs(place.depth) >= map.depth_outer || place.radius == 0)
    return u;
  const double m = functions.lamar_minification(map, std::abs(place.depth)).x;
  double low = 0;
  double high = map.outer;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (functions.lamar_profile(map.border, m, map.inner, map.outer, middle).value < place.radius ? low : high) =
        middle;
  }
  return place.axis_point + place.offset * (0.5 * (low + high) / place.radius);
}

RadialProfile radial_profile(LensBorder border, double minification, double inner, double outer, double r) {
  const Functions::LamarProfile f =
      Functions().lamar_profile(border_code(border), minification, inner, outer, r);
  return {f.value, f.by_radius};
}

double minification_at(const LamarMap& map, double d) { return Functions().lamar_minification(map, d).x; }

LensPlane lens_plane(const LamarMap& map, double z) {
  LensPlane plane;
  plane.axis_point = map.center + z * map.axis;
  plane.scale = map.center_depth > 0 ? 1 + z / map.center_depth : 1;
  plane.touched = std::abs(z) < map.depth_outer && plane.scale > 0;
  plane.minification = plane.touched ? minification_at(map, std::abs(z)) : 1;
  return plane;
}

} // namespace slicelens
