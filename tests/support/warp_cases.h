// Random warps of every kind, for laws that all of them keep.
#pragma once

#include "lens_cases.h"
#include "warp/warp.h"

namespace warp_cases {

using namespace slicelens;
using lens_cases::random_in;

/// A region at least .1 wide and .05 from the faces: slopes stay below 20.
inline AxisRanges random_region() {
  AxisRanges ranges;
  for (glm::dvec2& range : ranges) {
    range.x = random_in(0.05, 0.8);
    range.y = random_in(range.x + 0.1, 0.95);
  }
  return ranges;
}

/// `weakest`, `strongest`: magnification. Borders are at least a quarter of the half-width.
inline LensBox random_lens_box(double weakest, double strongest) {
  LensBox box;
  for (int a = 0; a < 3; ++a) {
    box.center[a] = random_in(0.2, 0.8);
    box.outer[a] = random_in(0.1, 1) * std::min(box.center[a], 1 - box.center[a]);
    box.inner[a] = box.outer[a] * random_in(0.05, 0.75);
  }
  box.magnification = random_in(weakest, strongest);
  return box;
}

inline Axis random_axis() { return static_cast<Axis>(*rc::gen::inRange(0, 3)); }
inline Direction random_sense() { return static_cast<Direction>(*rc::gen::inRange(0, 6)); }
/// Any direction but along the axis of that number.
inline Direction random_sense_beside(int axis) {
  return static_cast<Direction>((axis + *rc::gen::inRange(1, 3)) % 3 + 3 * *rc::gen::inRange(0, 2));
}
inline glm::dvec3 random_place() { return {random_in(0.2, 0.8), random_in(0.2, 0.8), random_in(0.2, 0.8)}; }

/// A bend whose arc's axis stays a third of its radius away from the box and a tenth of that around it.
inline Bend random_bend(const BoxSpace& space) {
  Bend bend;
  bend.axis = random_axis();
  bend.toward = random_sense_beside(index_of(bend.axis));
  bend.center = random_place();
  const double across = 1.1 * space.size[index_of(bend.toward)];
  const double most = glm::degrees(0.66 * space.size[index_of(bend.axis)] / across);
  bend.angle = random_in(-1, 1) * std::min(most, 175.0);
  return bend;
}

/// One of Brunet's deformations or widgets, of moderate slope in the box.
inline Warp random_deformation(const std::string& kind, const BoxSpace& space) {
  if (kind == "shift")
    return Shift{{random_in(-0.3, 0.3), random_in(-0.3, 0.3), random_in(-0.3, 0.3)}};
  if (kind == "sine") {
    const Axis axis = random_axis();
    const auto along = static_cast<Axis>((index_of(axis) + *rc::gen::inRange(1, 3)) % 3);
    return Sine{axis, along, random_in(-0.1, 0.1), random_in(0.3, 2), random_in(-180, 180)};
  }
  if (kind == "twist") {
    const Axis axis = random_axis();
    const double most = std::min(270.0, glm::degrees(10 * space.size[index_of(axis)]));
    return Twist{axis, random_place(), random_in(-most, most)};
  }
  if (kind == "bend")
    return random_bend(space);
  if (kind == "pulse")
    return Pulse{random_place(), random_in(0.2, 0.6), random_in(0.4, 6), random_in(0, 1)};
  if (kind == "spreader") {
    const Axis axis = random_axis();
    return Spreader{axis, random_sense_beside(index_of(axis)), random_place(), random_in(0, 120),
                    random_in(0, 0.3)};
  }
  if (kind == "leafer") {
    const Direction axis = random_sense();
    return Leafer{axis, random_sense_beside(index_of(axis)),
                  static_cast<std::size_t>(*rc::gen::inRange(2, 9)), random_in(0, 180)};
  }
  if (kind == "peeler") {
    const Direction axis = random_sense();
    const Direction toward = random_sense_beside(index_of(axis));
    return Peeler{axis, toward, random_place(), 1.2 * space.size[index_of(toward)] + random_in(0.02, 0.5),
                  random_in(0, 180)};
  }
  if (kind == "expander") {
    const double radius = random_in(0.2, 0.6);
    return Expander{random_place(), random_in(0, 0.7) * radius, radius};
  }
  return make_warp(kind).value();
}

/// Any valid warp of the kind; its defaults for a kind that is not known here.
inline Warp random_warp(const std::string& kind, const BoxSpace& space = {}) {
  if (kind == "lamar")
    return lens_cases::random_lens(0.4);
  if (kind == "bifocal")
    return Bifocal{random_region(), random_region()};
  if (kind == "fisheye") {
    return Fisheye{{random_in(0.05, 0.95), random_in(0.05, 0.95), random_in(0.05, 0.95)},
                   {random_in(0, 8), random_in(0, 8), random_in(0, 8)}};
  }
  if (kind == "volume-lens")
    return VolumeLens{random_lens_box(1, 8)};
  if (kind == "connected-lens")
    return ConnectedLens{random_lens_box(1, 8)};
  return random_deformation(kind, space);
}

/// A warp seen in a box from a view.
struct WarpCase {
  Warp warp;
  BoxSpace space;
  WarpMap map;
};

/// The default warp of the kind in the unit box half of the times, a random one in a random box otherwise.
inline WarpCase random_case(const std::string& kind) {
  const bool plain = lens_cases::random_bool();
  const Box box = plain ? Box{} : lens_cases::random_box();
  WarpCase c{plain ? make_warp(kind).value() : random_warp(kind, box_space(box)), box_space(box), {}};
  validate(c.warp);
  c.map = map_of(c.warp, c.space,
                 warp_view(plain ? lens_cases::front_view() : lens_cases::random_view(box), box));
  return c;
}

/// In the box or up to a tenth of it beside it.
inline glm::dvec3 random_point(const BoxSpace& space) {
  return space.size * glm::dvec3(random_in(-0.1, 1.1), random_in(-0.1, 1.1), random_in(-0.1, 1.1));
}

/// Nothing is shown at the point that looks there.
inline bool is_nowhere(const glm::dvec3& u) { return glm::length(u) > 100; }

inline bool in_box(const BoxSpace& space, const glm::dvec3& u) {
  return glm::all(glm::greaterThanEqual(u, glm::dvec3(0))) && glm::all(glm::lessThanEqual(u, space.size));
}

} // namespace warp_cases
