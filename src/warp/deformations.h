// The continuous deformations of Brunet, Nowak and Gleicher 2006 as values: their parameters, their limits,
// their maps (docs/papers/brunet.md). Positions are texture coordinates, lengths fractions of the box's
// longest edge, angles degrees.
#pragma once

#include "warp/box_space.h"
#include "warp/directions.h"
#include "warp/shared_axis_maps.h"

namespace slicelens {

/// A translation, the paper's yardstick for the cost of any deformation (§6.2).
struct Shift {
  glm::dvec3 offset{0.1, 0, 0}; ///< of the displayed volume, each from −4 to 4
};

/// A sine wave (Figure 3): points move along `axis` by a sine of their place along another axis. A shear: it
/// never folds.
struct Sine {
  Axis axis = Axis::x;
  Axis along = Axis::z;
  double amplitude = 0.08; ///< from −2 to 2
  double wavelength = 0.5; ///< from 0.001 to 1000
  double phase = 0;        ///< degrees
};

/// Planes across `axis` turn about it, in proportion to their distance from the centre (§3.3).
struct Twist {
  Axis axis = Axis::z;
  glm::dvec3 center{0.5};
  double angle = 90; ///< over the box's length along the axis, right-handed, from −3600 to 3600
};

/// A piece along `axis`, of the box's length there and about the centre, becomes an arc whose ends go
/// `toward`; the rest goes on straight (§3.3).
struct Bend {
  Axis axis = Axis::z;
  Direction toward = Direction::x;
  glm::dvec3 center{0.5};
  double angle = 60; ///< of the arc, from −180 to 180
};

/// A fisheye in a sphere of influence that comes and goes (§5.2).
struct Pulse {
  glm::dvec3 center{0.5};
  double radius = 0.3;      ///< of the sphere of influence
  double magnification = 2; ///< at the centre, at the height of the pulse; from 1/4 to 10000
  double phase = 0.5;       ///< from 0 to 1; the pulse is highest at 1/2
};

/// Throw UsageError naming warp and key.
void validate(const Shift& shift);
void validate(const Sine& sine);
void validate(const Twist& twist);
void validate(const Bend& bend);
void validate(const Pulse& pulse);

namespace shared {
template <class Real>
struct ShiftFunctions {
  SLICELENS_SHARED_NAMES(Real)
// The derivative of a translation depends on nothing, and GLSL knows no parameters without names.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include "warp/shift.glsl"
#pragma GCC diagnostic pop
};
template <class Real>
struct SineFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "warp/sine.glsl"
};
template <class Real>
struct TwistFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "warp/twist.glsl"
};
template <class Real>
struct BendFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "lib/plane_maps.glsl"
#include "warp/bend.glsl"
};
template <class Real>
struct PulseFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "warp/pulse.glsl"
};
} // namespace shared

using ShiftMap = shared::ShiftFunctions<double>::ShiftMap;
using SineMap = shared::SineFunctions<double>::SineMap;
using TwistMap = shared::TwistFunctions<double>::TwistMap;
using BendMap = shared::BendFunctions<double>::BendMap;
using PulseMap = shared::PulseFunctions<double>::PulseMap;

ShiftMap shift_map(const Shift& shift);
SineMap sine_map(const Sine& sine);
TwistMap twist_map(const Twist& twist, const BoxSpace& space);
/// Throws UsageError for a bend so strong that the arc's axis lies in the box, which would fold there.
BendMap bend_map(const Bend& bend, const BoxSpace& space);
PulseMap pulse_map(const Pulse& pulse, const BoxSpace& space);

/// The inverse maps and their derivatives at p, box space, in double precision.
glm::dvec3 texture_from_object(const ShiftMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const ShiftMap& map, const glm::dvec3& p);
glm::dvec3 texture_from_object(const SineMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const SineMap& map, const glm::dvec3& p);
glm::dvec3 texture_from_object(const TwistMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const TwistMap& map, const glm::dvec3& p);
glm::dvec3 texture_from_object(const BendMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const BendMap& map, const glm::dvec3& p);
glm::dvec3 texture_from_object(const PulseMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const PulseMap& map, const glm::dvec3& p);

/// The forward maps: where the point u of the data is shown, box space. Closed forms; the pulse by bisection
/// to rounding. Of the bend for data on the box's side of the arc's axis.
glm::dvec3 object_from_texture(const ShiftMap& map, const glm::dvec3& u);
glm::dvec3 object_from_texture(const SineMap& map, const glm::dvec3& u);
glm::dvec3 object_from_texture(const TwistMap& map, const glm::dvec3& u);
glm::dvec3 object_from_texture(const BendMap& map, const glm::dvec3& u);
glm::dvec3 object_from_texture(const PulseMap& map, const glm::dvec3& u);

/// On which side of the bend's cut p lies. Behind the arc's axis the two straight parts meet: 1 and 2;
/// elsewhere 0. The volume's own piece, from end to end of the box, is never shown there.
int piece_of(const BendMap& map, const glm::dvec3& p);

/// Calls set(name, value) for every field as GLSL takes it.
template <class Set>
void visit_fields(const ShiftMap& map, const Set& set) {
  set("offset", map.offset);
}
template <class Set>
void visit_fields(const SineMap& map, const Set& set) {
  set("axis", map.axis);
  set("along", map.along);
  set("amplitude", map.amplitude);
  set("wave_number", map.wave_number);
  set("phase", map.phase);
}
template <class Set>
void visit_fields(const TwistMap& map, const Set& set) {
  set("center", map.center);
  set("axis", map.axis);
  set("turn", map.turn);
}
template <class Set>
void visit_fields(const BendMap& map, const Set& set) {
  set("center", map.center);
  set("axis", map.axis);
  set("toward", map.toward);
  set("curvature", map.curvature);
  set("half_length", map.half_length);
  set("end_cos", map.end_cos);
  set("end_sin", map.end_sin);
  set("end_rise", map.end_rise);
  set("end_run", map.end_run);
}
template <class Set>
void visit_fields(const PulseMap& map, const Set& set) {
  set("center", map.center);
  set("radius", map.radius);
  set("minification", map.minification);
}

} // namespace slicelens
