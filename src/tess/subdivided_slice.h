// Slices on a regular grid whose corners carry a map: deformations per vertex, which Brunet, Nowak and
// Gleicher 2006 §6.1 set against their own method. No OpenGL.
#pragma once

#include "tess/lens_mesh.h"
#include "warp/warp.h"

namespace slicelens {

/// The slice `polygon` (convex, at least 3 corners, in texture coordinates of the displayed volume) in square
/// cells along the view's axes, `cells` of them along its longest edge (1 or more). Every corner of a cell
/// looks at texture_from_object of itself, with weight 1: in between, coordinates are interpolated linearly
/// in each of a cell's two triangles. Cells on the outline are cut there. Corners of one cell are corners of
/// its neighbours, to the last bit. What looks beyond the volume is not clipped: each fragment must test
/// where it looks.
LensMesh subdivide_slice(const Polygon& polygon, const std::vector<WarpMap>& maps, const BoxSpace& space,
                         const WarpView& view, std::size_t cells);

} // namespace slicelens
