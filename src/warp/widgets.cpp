#include "warp/widgets.h"

#include "warp/warp_limits.h"

#include <algorithm>
#include <numbers>

namespace slicelens {

using namespace limits;

namespace {

constexpr double degree = std::numbers::pi / 180;

using SpreaderMath = shared::SpreaderFunctions<double>;
using LeaferMath = shared::LeaferFunctions<double>;
using PeelerMath = shared::PeelerFunctions<double>;
using ExpanderMath = shared::ExpanderFunctions<double>;

} // namespace

void validate(const Spreader& spreader) {
  require_two_axes("spreader", "axis", index_of(spreader.axis), "toward", index_of(spreader.toward));
  require_within("spreader", "center", spreader.center, nearest_center, farthest_center);
  require_within("spreader", "angle", spreader.angle, 0, 170);
  require_within("spreader", "gap", spreader.gap, 0, 4);
}

void validate(const Leafer& leafer) {
  require_two_axes("leafer", "axis", index_of(leafer.axis), "toward", index_of(leafer.toward));
  require_within("leafer", "leaves", static_cast<double>(leafer.leaves), 2, 64);
  require_within("leafer", "angle", leafer.angle, 0, 180);
}

void validate(const Peeler& peeler) {
  require_two_axes("peeler", "axis", index_of(peeler.axis), "toward", index_of(peeler.toward));
  require_within("peeler", "center", peeler.center, nearest_center, farthest_center);
  require_within("peeler", "radius", peeler.radius, 1e-3, 1e3);
  require_within("peeler", "angle", peeler.angle, 0, 180);
}

void validate(const Expander& expander) {
  require_within("expander", "center", expander.center, nearest_center, farthest_center);
  require_within("expander", "radius", expander.radius, 1e-3, 4);
  require_within("expander", "opening", expander.opening, 0, 4);
  if (!(expander.opening < expander.radius)) {
    throw UsageError("warp 'expander': opening (" + number_text(expander.opening) +
                     ") must be smaller than radius (" + number_text(expander.radius) +
                     "), or nothing is left between them");
  }
}

SpreaderMap spreader_map(const Spreader& spreader, const BoxSpace& space) {
  const double half = spreader.angle / 2 * degree;
  return {box_from_texture(space, spreader.center),
          unit_vector(spreader.axis),
          unit_vector(spreader.toward),
          spreader.gap / 2,
          half,
          (std::numbers::pi / 2) / (std::numbers::pi / 2 - half)};
}

LeaferMap leafer_map(const Leafer& leafer, const BoxSpace& space) {
  const glm::dvec3 axis = unit_vector(leafer.axis);
  const glm::dvec3 toward = unit_vector(leafer.toward);
  const auto leaves = static_cast<double>(leafer.leaves);
  const double step = leafer.angle * degree / (leaves - 1);
  // The corner of the box from which both directions lead into it; the coordinate along the spine does not
  // matter.
  const glm::dvec3 spine = space.size * glm::max(-axis - toward, glm::dvec3(0));
  return {spine,
          axis,
          toward,
          static_cast<int>(leafer.leaves),
          space.size[index_of(leafer.axis)] / leaves,
          std::cos(step),
          std::sin(step)};
}

PeelerMap peeler_map(const Peeler& peeler, const BoxSpace& space) {
  const int across = index_of(peeler.toward);
  const double center = peeler.center[across];
  const double thickness =
      (unit_vector(peeler.toward)[across] > 0 ? 1 - center : center) * space.size[across];
  if (!(peeler.radius > thickness)) {
    throw UsageError("warp 'peeler': radius " + number_text(peeler.radius) + " folds the layer, which is " +
                     number_text(thickness) +
                     " thick; make it larger than that, or move center towards the surface");
  }
  const double angle = peeler.angle * degree;
  return {box_from_texture(space, peeler.center),
          unit_vector(peeler.axis),
          unit_vector(peeler.toward),
          peeler.radius,
          angle,
          std::cos(angle),
          std::sin(angle)};
}

ExpanderMap expander_map(const Expander& expander, const BoxSpace& space) {
  return {box_from_texture(space, expander.center), expander.opening, expander.radius};
}

glm::dvec3 texture_from_object(const SpreaderMap& map, const glm::dvec3& p) {
  return SpreaderMath().spreader_texture_from_object(map, p);
}
glm::dmat3 jacobian(const SpreaderMap& map, const glm::dvec3& p) {
  return SpreaderMath().spreader_jacobian(map, p);
}
glm::dvec3 texture_from_object(const LeaferMap& map, const glm::dvec3& p) {
  return LeaferMath().leafer_texture_from_object(map, p);
}
glm::dmat3 jacobian(const LeaferMap& map, const glm::dvec3& p) {
  return LeaferMath().leafer_jacobian(map, p);
}
glm::dvec3 texture_from_object(const PeelerMap& map, const glm::dvec3& p) {
  return PeelerMath().peeler_texture_from_object(map, p);
}
glm::dmat3 jacobian(const PeelerMap& map, const glm::dvec3& p) {
  return PeelerMath().peeler_jacobian(map, p);
}
glm::dvec3 texture_from_object(const ExpanderMap& map, const glm::dvec3& p) {
  return ExpanderMath().expander_texture_from_object(map, p);
}
glm::dmat3 jacobian(const ExpanderMap& map, const glm::dvec3& p) {
  return ExpanderMath().expander_jacobian(map, p);
}

glm::dvec3 object_from_texture(const SpreaderMap& map, const glm::dvec3& u) {
  const double x = glm::dot(u - map.center, map.toward);
  const double y = glm::dot(u - map.center, map.axis);
  if (x <= 0)
    return u;
  const double r = std::hypot(x, y);
  const double angle = map.half_angle + std::atan2(std::abs(y), x) / map.squeeze;
  const double beside = map.half_gap + r * std::sin(angle);
  return u + (r * std::cos(angle) - x) * map.toward + ((y < 0 ? -beside : beside) - y) * map.axis;
}

glm::dvec3 object_from_texture(const LeaferMap& map, const glm::dvec3& u) {
  const double x = glm::dot(u - map.spine, map.toward);
  const double y = glm::dot(u - map.spine, map.axis);
  const double last = map.leaves - 1;
  const auto leaf = static_cast<int>(std::clamp(std::floor(y / map.thickness), 0.0, last));
  const glm::dvec2 turn = LeaferMath().leafer_turn(map, leaf);
  return u + (x * turn.x - y * turn.y - x) * map.toward + (x * turn.y + y * turn.x - y) * map.axis;
}

glm::dvec3 object_from_texture(const PeelerMap& map, const glm::dvec3& u) {
  const double x = glm::dot(u - map.center, map.toward);
  const double y = glm::dot(u - map.center, map.axis);
  if (x < 0 || y < 0)
    return u;
  const double on_arc = std::min(y, map.radius * map.angle);
  const double beyond = y - on_arc;
  const double angle = on_arc / map.radius;
  const double arm = map.radius - x;
  // On the arc, then straight on.
  const double px = map.radius - arm * std::cos(angle) + beyond * std::sin(angle);
  const double py = arm * std::sin(angle) + beyond * std::cos(angle);
  return u + (px - x) * map.toward + (py - y) * map.axis;
}

glm::dvec3 object_from_texture(const ExpanderMap& map, const glm::dvec3& u) {
  const glm::dvec3 q = u - map.center;
  const double distance = glm::length(q);
  if (distance >= map.radius)
    return u;
  if (distance == 0)
    return map.center + glm::dvec3(map.opening, 0, 0); // the centre is the whole inner sphere
  const double r = map.opening + distance * (map.radius - map.opening) / map.radius;
  return map.center + (r / distance) * q;
}

int piece_of(const SpreaderMap& map, const glm::dvec3& p) { return SpreaderMath().spreader_piece(map, p); }
int piece_of(const LeaferMap& map, const glm::dvec3& p) { return LeaferMath().leafer_piece(map, p); }
int piece_of(const PeelerMap& map, const glm::dvec3& p) { return PeelerMath().peeler_piece(map, p); }
int piece_of(const ExpanderMap& map, const glm::dvec3& p) { return ExpanderMath().expander_piece(map, p); }

} // namespace slicelens
