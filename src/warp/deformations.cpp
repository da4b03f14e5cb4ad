#include "warp/deformations.h"

#include "warp/warp_limits.h"

#include <algorithm>
#include <numbers>

namespace slicelens {

using namespace limits;

namespace {

constexpr double degree = std::numbers::pi / 180;

using ShiftMath = shared::ShiftFunctions<double>;
using SineMath = shared::SineFunctions<double>;
using TwistMath = shared::TwistFunctions<double>;
using BendMath = shared::BendFunctions<double>;
using PulseMath = shared::PulseFunctions<double>;

} // namespace

void validate(const Shift& shift) { require_within("shift", "offset", shift.offset, -4, 4); }

void validate(const Sine& sine) {
  require_two_axes("sine", "axis", index_of(sine.axis), "along", index_of(sine.along));
  require_within("sine", "amplitude", sine.amplitude, -2, 2);
  require_within("sine", "wavelength", sine.wavelength, 1e-3, 1e3);
  require_within("sine", "phase", sine.phase, -36000, 36000);
}

void validate(const Twist& twist) {
  require_within("twist", "center", twist.center, nearest_center, farthest_center);
  require_within("twist", "angle", twist.angle, -3600, 3600);
}

void validate(const Bend& bend) {
  require_two_axes("bend", "axis", index_of(bend.axis), "toward", index_of(bend.toward));
  require_within("bend", "center", bend.center, nearest_center, farthest_center);
  require_within("bend", "angle", bend.angle, -180, 180);
}

void validate(const Pulse& pulse) {
  require_within("pulse", "center", pulse.center, nearest_center, farthest_center);
  require_within("pulse", "radius", pulse.radius, 1e-3, 4);
  require_within("pulse", "phase", pulse.phase, 0, 1);
  if (pulse.magnification < 0.25) {
    throw UsageError("warp 'pulse': magnification " + number_text(pulse.magnification) +
                     " folds the sphere over itself; make it at least 0.25");
  }
  require_within("pulse", "magnification", pulse.magnification, 0.25, 1e4);
}

ShiftMap shift_map(const Shift& shift) { return {shift.offset}; }

SineMap sine_map(const Sine& sine) {
  return {unit_vector(sine.axis), unit_vector(sine.along), sine.amplitude,
          2 * std::numbers::pi / sine.wavelength, sine.phase * degree};
}

TwistMap twist_map(const Twist& twist, const BoxSpace& space) {
  return {box_from_texture(space, twist.center), unit_vector(twist.axis),
          twist.angle * degree / space.size[index_of(twist.axis)]};
}

BendMap bend_map(const Bend& bend, const BoxSpace& space) {
  const glm::dvec3 toward = unit_vector(bend.toward);
  const double length = space.size[index_of(bend.axis)];
  double k = bend.angle * degree / length;
  if (std::abs(k) < 1e-9)
    k = 0;
  // How far the box reaches from the centre to the side on which the arc's axis lies.
  const int across = index_of(bend.toward);
  const bool rising = toward[across] * k > 0;
  const double center = bend.center[across];
  const double reach = (rising ? 1 - center : center) * space.size[across];
  if (std::abs(k) * reach >= 1) {
    throw UsageError("warp 'bend': angle " + number_text(bend.angle) +
                     " folds the box: the axis of the arc would lie in it; make it smaller than " +
                     number_text(std::floor(10 * length / reach / degree) / 10) +
                     ", or move center towards the axis of the arc");
  }
  const double half = k * length / 2;
  return {box_from_texture(space, bend.center),
          unit_vector(bend.axis),
          toward,
          k,
          length / 2,
          std::cos(half),
          std::sin(half),
          k == 0 ? 0 : (1 - std::cos(half)) / k,
          k == 0 ? length / 2 : std::sin(half) / k};
}

PulseMap pulse_map(const Pulse& pulse, const BoxSpace& space) {
  const double wave = std::sin(std::numbers::pi * pulse.phase);
  return {box_from_texture(space, pulse.center), pulse.radius,
          1 / (1 + (pulse.magnification - 1) * wave * wave)};
}

glm::dvec3 texture_from_object(const ShiftMap& map, const glm::dvec3& p) {
  return ShiftMath().shift_texture_from_object(map, p);
}
glm::dmat3 jacobian(const ShiftMap& map, const glm::dvec3& p) { return ShiftMath().shift_jacobian(map, p); }
glm::dvec3 texture_from_object(const SineMap& map, const glm::dvec3& p) {
  return SineMath().sine_texture_from_object(map, p);
}
glm::dmat3 jacobian(const SineMap& map, const glm::dvec3& p) { return SineMath().sine_jacobian(map, p); }
glm::dvec3 texture_from_object(const TwistMap& map, const glm::dvec3& p) {
  return TwistMath().twist_texture_from_object(map, p);
}
glm::dmat3 jacobian(const TwistMap& map, const glm::dvec3& p) { return TwistMath().twist_jacobian(map, p); }
glm::dvec3 texture_from_object(const BendMap& map, const glm::dvec3& p) {
  return BendMath().bend_texture_from_object(map, p);
}
glm::dmat3 jacobian(const BendMap& map, const glm::dvec3& p) { return BendMath().bend_jacobian(map, p); }
glm::dvec3 texture_from_object(const PulseMap& map, const glm::dvec3& p) {
  return PulseMath().pulse_texture_from_object(map, p);
}
glm::dmat3 jacobian(const PulseMap& map, const glm::dvec3& p) { return PulseMath().pulse_jacobian(map, p); }

glm::dvec3 object_from_texture(const ShiftMap& map, const glm::dvec3& u) { return u + map.offset; }

glm::dvec3 object_from_texture(const SineMap& map, const glm::dvec3& u) {
  // The coordinate that the wave depends on does not move.
  return 2.0 * u - texture_from_object(map, u);
}

glm::dvec3 object_from_texture(const TwistMap& map, const glm::dvec3& u) {
  TwistMap back = map;
  back.turn = -map.turn;
  return texture_from_object(back, u);
}

glm::dvec3 object_from_texture(const BendMap& map, const glm::dvec3& u) {
  const double k = map.curvature;
  if (k == 0)
    return u;
  const double ux = glm::dot(u - map.center, map.toward);
  const double uy = glm::dot(u - map.center, map.axis);
  const double inside = std::clamp(uy, -map.half_length, map.half_length);
  const double beyond = uy - inside;
  const double c = std::cos(k * inside);
  const double s = std::sin(k * inside);
  // On the arc at `inside`, then straight on.
  const double x = 2 * std::pow(std::sin(k * inside / 2), 2) / k + ux * c + beyond * s;
  const double y = s / k - ux * s + beyond * c;
  return u + (x - ux) * map.toward + (y - uy) * map.axis;
}

int piece_of(const BendMap& map, const glm::dvec3& p) {
  const glm::dvec3 q = p - map.center;
  if (1 - map.curvature * glm::dot(q, map.toward) > 0)
    return 0;
  return glm::dot(q, map.axis) < 0 ? 2 : 1;
}

glm::dvec3 object_from_texture(const PulseMap& map, const glm::dvec3& u) {
  const glm::dvec3 q = u - map.center;
  const double distance = glm::length(q);
  if (distance == 0 || distance >= map.radius)
    return u;
  double low = 0;
  double high = map.radius;
  for (int i = 0; i < 60; ++i) {
    const double r = (low + high) / 2;
    const double rest = 1 - r / map.radius;
    (r * (1 + (map.minification - 1) * rest * rest) < distance ? low : high) = r;
  }
  return map.center + ((low + high) / 2 / distance) * q;
}

} // namespace slicelens
