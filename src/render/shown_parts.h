// Where the picture shows parts of the data: empty cells, bricks.
#pragma once

#include "render/prepare.h"
#include "warp/shown_bounds.h"

namespace slicelens {

/// From a box of the data within [0, 1]³ to where the scene's pipeline shows it, both in texture coordinates,
/// of the data and of the displayed volume; nothing where it shows none of it. Conservative: what grids and
/// the tables of pipeline `axis` make of the warps is allowed for.
ShownBounds shown_parts(const PreparedScene& prepared);

/// A box of texture coordinates, for segments with all that its faces on the volume's stand for: ends beyond
/// the volume take the values of its edge. It reaches one volume farther there, more than half a sample
/// distance looks away.
Bounds with_edge(const Bounds& box);

} // namespace slicelens
