// Lens triangles cut at the boundaries of tiles, for volumes held in several textures: the hurdle that LaMar,
// Hamann and Joy leave open (2001, §6). No OpenGL.
#pragma once

#include "tess/lens_mesh.h"

#include <array>
#include <vector>

namespace slicelens {

/// Where tiles meet: on each axis the texture coordinates of the inner boundaries, ascending, in (0, 1). Tile
/// (x, y, z) has number (z·ny + y)·nx + x.
struct TileCuts {
  std::array<std::vector<double>, 3> planes;
};

std::size_t tile_count(const TileCuts& cuts);

/// The parts of a slice's triangles that look into each tile, tile by number. A boundary c is the half-space
/// S ≤ c·q of the homogeneous coordinates, so the cut is exact wherever the lens bends it (LaMar §4.2).
///
/// Pieces are cut one boundary after the other, each from what the one before left, so an edge that two
/// pieces share is cut into the same corners, to the last bit, whichever tiles lie beside it. Needs what
/// tessellate_slice and cover_slice give: the triangles of a convex piece follow each other as a fan.
std::vector<LensMesh> split_by_tiles(const LensMesh& mesh, const TileCuts& cuts);

} // namespace slicelens
