// Where a deformed volume lies.
#pragma once

#include "warp/warp.h"

namespace slicelens {

/// An axis-aligned box of box space.
struct Bounds {
  glm::dvec3 low{0};
  glm::dvec3 high{1};
};

/// Bounds of where the map shows the points of a box, conservative: nothing of them is shown outside. Exact
/// for shift, sine, twist, bend, leafer and peeler; a pulse and an expander move nothing out of the box and
/// their sphere together; what a spreader turns keeps its distance from the hinge. Cohen's maps keep every
/// box that holds the volume's own. A LaMar lens shows in its footprint what lies there, so the footprint is
/// added (src/tess/lens_footprint.h): here the box is kept.
Bounds object_bounds(const WarpMap& map, const Bounds& box);

/// The footprint of a lens over its whole depth: outside it shows what lies there, inside what lies inside.
Bounds footprint_bounds(const LamarMap& map);

} // namespace slicelens
