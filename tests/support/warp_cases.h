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

/// Landmarks that move a few points of the unit cube by up to a twentieth and hold its corners.
inline Landmarks random_landmarks() {
  Landmarks landmarks;
  landmarks.space = LandmarkSpace::texture;
  landmarks.resolution = 16;
  landmarks.pairs.emplace();
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 c(corner & 1, corner >> 1 & 1, corner >> 2);
    landmarks.pairs->push_back({c, c});
  }
  for (int i = 0; i < 4; ++i) { // a quarter of the box apart and more
    const glm::dvec3 p(0.25 + 0.5 * (i & 1), 0.25 + 0.5 * (i >> 1), random_in(0.2, 0.8));
    const glm::dvec3 step(random_in(-1, 1), random_in(-1, 1), random_in(-1, 1));
    landmarks.pairs->push_back({p, p + 0.05 * step});
  }
  return landmarks;
}

/// A field of smooth waves over the box and beyond, of slopes below a half.
inline Field random_field(const BoxSpace& space) {
  DisplacementField field;
  field.dims = {9, 10, 11};
  glm::dmat4 box_from_index(0.25);
  box_from_index[3] = {-0.6, -0.7, -0.8, 1};
  const glm::dmat4 world_from_box = glm::inverse(space.box_from_world);
  field.world_from_index = world_from_box * box_from_index;
  const double phase = random_in(0, 6);
  for (std::size_t i = 0; i < 990; ++i) {
    const glm::dvec3 x = 0.25 * glm::dvec3(i % 9, i / 9 % 10, i / 90);
    const glm::dvec3 d(0.05 * std::sin(4 * x.y + phase), 0.05 * std::cos(3 * x.z + phase), 0.04 * x.x);
    field.vectors.emplace_back(glm::dmat3(world_from_box) * d);
  }
  Field warp;
  warp.file = "waves";
  warp.resolution = 16;
  warp.loaded = std::make_shared<const DisplacementField>(std::move(field));
  return warp;
}

/// Whether the kind needs points or a file.
inline bool has_no_defaults(const std::string& kind) { return kind == "landmarks" || kind == "field"; }

/// The warp with its defaults; landmarks and fields, which have none, as the test's own.
inline Warp default_warp(const std::string& kind, const BoxSpace& space = {}) {
  if (kind == "landmarks")
    return random_landmarks();
  if (kind == "field")
    return random_field(space);
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
  if (has_no_defaults(kind))
    return default_warp(kind, space);
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
  WarpCase c{
      plain ? default_warp(kind, box_space(box)) : random_warp(kind, box_space(box)), box_space(box), {}};
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
