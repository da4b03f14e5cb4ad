// LaMar's magnification lens as a value: its parameters, their limits, its maps.
#pragma once

#include "warp/box_space.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>

namespace slicelens {

enum class LensShape { circle, square };
enum class LensBorder { simple, linear, cubic };

/// The lens of LaMar, Hamann and Joy 2001 (docs/papers/lamar.md). Lengths are fractions of the box's longest
/// edge, measured across the viewing direction at the centre's depth (inner, outer) or along it (depth_inner,
/// depth_outer).
struct LamarLens {
  LensShape shape = LensShape::circle;
  LensBorder border = LensBorder::cubic;
  double zoom = 4;        ///< Q
  glm::dvec3 center{0.5}; ///< texture coordinates
  double inner = 0.12;    ///< r_i: radius of the zoom region (half edge for squares)
  double outer = 0.2;     ///< r_o: where the volume is undisturbed again
  std::optional<double> depth_inner = std::nullopt; ///< d_i; none: inner
  std::optional<double> depth_outer = std::nullopt; ///< d_o; none: outer
  std::size_t angular_segments = 32;                ///< of a circle; a square has four
  std::optional<std::size_t> radial_segments = 8;   ///< none: adaptive. `simple` always has one
  bool homogeneous = true; ///< false: affine texture coordinates, the wrong picture of LaMar Fig. 2(a)
  bool bounded = true;     ///< tessellate inside the bounding square only (LaMar §4.1)
};

inline constexpr std::size_t max_angular_segments = 4096;
inline constexpr std::size_t max_radial_segments = 1024;

/// Throws UsageError naming the key for values that make no lens: not finite or positive radii and zoom,
/// inner ≥ outer, depth_inner ≥ depth_outer, segments of 0 or beyond the maxima, a minifying zoom whose
/// border would fold (inner/zoom ≥ outer, or a cubic or simple profile whose slope turns negative).
void validate(const LamarLens& lens);

/// Throws UsageError when the lens touches nothing: its centre is farther from the box than its outer extent.
void validate_place(const LamarLens& lens, const BoxSpace& space);

/// GLSL of the lens compiled as C++ with scalars of type Real (float or double): see shaders/warp/lamar.glsl.
namespace shared {

using namespace glm;

template <class Real>
struct LamarFunctions {
  using real = Real;
  using vec2 = glm::vec<2, Real>;
  using vec3 = glm::vec<3, Real>;
  using mat3 = glm::mat<3, 3, Real>;
#include "warp/lamar.glsl"
};

} // namespace shared

using LamarMap = shared::LamarFunctions<double>::LamarMap;

/// The lens' numbers for a view: what shaders/warp/lamar.glsl takes, in box space. Under perspective the lens
/// axis is the line from the eye through the centre and the radii grow with depth, so that the lens is one
/// circle in the picture.
LamarMap lamar_map(const LamarLens& lens, const BoxSpace& space, const WarpView& view);

/// The inverse map and its derivative at p, box space, in double precision.
glm::dvec3 texture_from_object(const LamarMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const LamarMap& map, const glm::dvec3& p);

/// Local tangential magnification q = r/f(r) at p, box space: the homogeneous weight; 1 outside the lens.
double magnification(const LamarMap& map, const glm::dvec3& p);

/// The forward map: where the point u of the data is shown (the profile inverted by bisection to 1e-14). The
/// planes across the view stay where they are.
glm::dvec3 object_from_texture(const LamarMap& map, const glm::dvec3& u);

/// Calls set(name, value) for every field as GLSL takes it.
template <class Set>
void visit_fields(const LamarMap& map, const Set& set) {
  set("center", map.center);
  set("axis", map.axis);
  set("forward", map.forward);
  set("right", map.right);
  set("up", map.up);
  set("center_depth", map.center_depth);
  set("square", map.square);
  set("border", map.border);
  set("minification", map.minification);
  set("inner", map.inner);
  set("outer", map.outer);
  set("depth_inner", map.depth_inner);
  set("depth_outer", map.depth_outer);
}

/// The profile f(r) and f'(r) for minification m = 1/Q.
struct RadialProfile {
  double value = 0;
  double slope = 0;
};
RadialProfile radial_profile(LensBorder border, double minification, double inner, double outer, double r);

/// m = 1/Q on the plane at depth distance d from the centre.
double minification_at(const LamarMap& map, double d);

/// The lens on the plane at signed depth z from its centre: axis point and scale of the radii, box space.
struct LensPlane {
  glm::dvec3 axis_point{0};
  double scale = 1;
  double minification = 1;
  bool touched = false; ///< |z| < d_o: the plane is warped somewhere
};
LensPlane lens_plane(const LamarMap& map, double z);

} // namespace slicelens
