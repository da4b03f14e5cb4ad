// Where parts of the data are shown: what empty cells (render.skip) and bricks ask, many times for each
// picture.
#pragma once

#include "warp/object_bounds.h"

#include <functional>
#include <optional>
#include <vector>

namespace slicelens {

/// Where the map shows the points of a box of any size, box space, conservative: no point outside shows any
/// of them. Nothing where no point does. As tight as a box can be for a shift, a bifocal display and a
/// fisheye; see object_bounds for the rest. A grid is arranged anew for each call: shown_bounds_of does that
/// once.
std::optional<Bounds> shown_bounds(const WarpMap& map, const Bounds& box);

/// From a box of the data to where it is shown, box space; from several threads at a time.
using ShownBounds = std::function<std::optional<Bounds>(const Bounds& box)>;

/// The same for a list of maps in forward order, for many boxes: with a grid some microseconds each, once its
/// cells are arranged by what they show (64³: 50 ms on a busy machine).
ShownBounds shown_bounds_of(const std::vector<WarpMap>& maps);

} // namespace slicelens
