// Volume widgets after McGuffin, Tancau and Balakrishnan 2003, as Brunet, Nowak and Gleicher 2006 §5.3 draw
// them: maps with cuts. The definitions are our own (docs/papers/brunet.md). Positions are texture
// coordinates, lengths fractions of the box's longest edge, angles degrees.
#pragma once

#include "warp/box_space.h"
#include "warp/directions.h"
#include "warp/shared_axis_maps.h"

namespace slicelens {

/// Cuts the volume across `axis`, from its surface on the side of `toward` down to the centre, and opens the
/// cut.
struct Spreader {
  Axis axis = Axis::x;
  Direction toward = Direction::minus_y;
  glm::dvec3 center{0.5}; ///< on the hinge
  double angle = 60;      ///< of the opened wedge, from 0 to 170
  double gap = 0;         ///< by which both sides are pushed apart, from 0 to 4
};

/// Cuts the volume into leaves that are stacked along `axis`, and fans them out about an edge of the box.
struct Leafer {
  Direction axis =
      Direction::minus_y; ///< through the stack: the first leaf stays, the last one turns farthest this way
  Direction toward = Direction::x; ///< from the spine across the pages
  std::size_t leaves = 6;          ///< 2 to 64
  double angle = 90;               ///< between the first and the last leaf, from 0 to 180
};

/// Cuts a layer off the volume, from the centre on in the direction of `axis`, and rolls it up.
struct Peeler {
  Direction axis = Direction::z; ///< along the layer: what lies beyond the centre is peeled
  Direction toward =
      Direction::minus_y; ///< out of the layer: it reaches from the centre to the surface there
  glm::dvec3 center{0.5};
  double radius = 0.6; ///< of the roll, from 0.001 to 1000, larger than the layer is thick
  double angle = 90;   ///< of the roll; straight on after it; from 0 to 180
};

/// Pushes the volume open into an empty ball about the centre.
struct Expander {
  glm::dvec3 center{0.5};
  double opening = 0.15; ///< radius of the ball, 0 or more
  double radius = 0.4;   ///< beyond which nothing moves, larger than opening
};

/// Throw UsageError naming warp and key.
void validate(const Spreader& spreader);
void validate(const Leafer& leafer);
void validate(const Peeler& peeler);
void validate(const Expander& expander);

namespace shared {
template <class Real>
struct SpreaderFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "lib/plane_maps.glsl"
#include "warp/spreader.glsl"
};
template <class Real>
struct LeaferFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "lib/plane_maps.glsl"
#include "warp/leafer.glsl"
};
template <class Real>
struct PeelerFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "lib/plane_maps.glsl"
#include "warp/peeler.glsl"
};
template <class Real>
struct ExpanderFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "lib/plane_maps.glsl"
#include "warp/expander.glsl"
};
} // namespace shared

using SpreaderMap = shared::SpreaderFunctions<double>::SpreaderMap;
using LeaferMap = shared::LeaferFunctions<double>::LeaferMap;
using PeelerMap = shared::PeelerFunctions<double>::PeelerMap;
using ExpanderMap = shared::ExpanderFunctions<double>::ExpanderMap;

SpreaderMap spreader_map(const Spreader& spreader, const BoxSpace& space);
LeaferMap leafer_map(const Leafer& leafer, const BoxSpace& space);
/// Throws UsageError for a layer thicker than the radius, which would fold about the axis of the roll.
PeelerMap peeler_map(const Peeler& peeler, const BoxSpace& space);
ExpanderMap expander_map(const Expander& expander, const BoxSpace& space);

/// The inverse maps and their derivatives at p, box space, in double precision. Where a cut leaves a gap: far
/// outside the volume.
glm::dvec3 texture_from_object(const SpreaderMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const SpreaderMap& map, const glm::dvec3& p);
glm::dvec3 texture_from_object(const LeaferMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const LeaferMap& map, const glm::dvec3& p);
glm::dvec3 texture_from_object(const PeelerMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const PeelerMap& map, const glm::dvec3& p);
glm::dvec3 texture_from_object(const ExpanderMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const ExpanderMap& map, const glm::dvec3& p);

/// The forward maps, closed forms: where the point u of the volume is shown, box space.
glm::dvec3 object_from_texture(const SpreaderMap& map, const glm::dvec3& u);
glm::dvec3 object_from_texture(const LeaferMap& map, const glm::dvec3& u);
glm::dvec3 object_from_texture(const PeelerMap& map, const glm::dvec3& u);
glm::dvec3 object_from_texture(const ExpanderMap& map, const glm::dvec3& u);

/// Which piece shows p, from 0; −1: none. The map is continuous in a piece.
int piece_of(const SpreaderMap& map, const glm::dvec3& p);
int piece_of(const LeaferMap& map, const glm::dvec3& p);
int piece_of(const PeelerMap& map, const glm::dvec3& p);
int piece_of(const ExpanderMap& map, const glm::dvec3& p);

/// Calls set(name, value) for every field as GLSL takes it.
template <class Set>
void visit_fields(const SpreaderMap& map, const Set& set) {
  set("center", map.center);
  set("axis", map.axis);
  set("toward", map.toward);
  set("half_gap", map.half_gap);
  set("half_angle", map.half_angle);
  set("squeeze", map.squeeze);
}
template <class Set>
void visit_fields(const LeaferMap& map, const Set& set) {
  set("spine", map.spine);
  set("axis", map.axis);
  set("toward", map.toward);
  set("leaves", map.leaves);
  set("thickness", map.thickness);
  set("step_cos", map.step_cos);
  set("step_sin", map.step_sin);
}
template <class Set>
void visit_fields(const PeelerMap& map, const Set& set) {
  set("center", map.center);
  set("axis", map.axis);
  set("toward", map.toward);
  set("radius", map.radius);
  set("angle", map.angle);
  set("end_cos", map.end_cos);
  set("end_sin", map.end_sin);
}
template <class Set>
void visit_fields(const ExpanderMap& map, const Set& set) {
  set("center", map.center);
  set("opening", map.opening);
  set("radius", map.radius);
}

} // namespace slicelens
