// The volume held in several textures: render.tiles and render.levels. What each texture holds, without
// OpenGL.
#pragma once

#include "render/prepare.h"
#include "tess/tile_mesh.h"
#include "warp/object_bounds.h"

#include <array>
#include <optional>
#include <vector>

namespace slicelens {

/// Whether the volume is held in several textures: render.tiles and render.levels of one that fits
/// render.memory (pages.h).
bool is_bricked(const PreparedScene& prepared);

/// The voxels [first, first + size) of one level (volume/pyramid.h) as a texture.
struct Brick {
  std::size_t level = 0; ///< 0: full resolution
  std::array<std::size_t, 3> first{0, 0, 0};
  std::array<std::size_t, 3> size{1, 1, 1};
  glm::dvec3 scale{1}; ///< the brick's texture coordinate = scale · volume's texture coordinate + offset
  glm::dvec3 offset{0};
};

struct BrickPlan {
  TileCuts cuts;
  std::size_t levels = 1;
  std::vector<Brick> bricks;
  /// For each tile the brick of each level, as an index of `bricks`. A level that the tile is never seen at
  /// names the tile's coarsest brick.
  std::vector<std::vector<std::size_t>> of_tile;
};

/// Tiles meet at voxel centres, texture coordinate (b + ½)/N with b = ⌊N·i/n⌋, so linear interpolation on
/// either side needs voxel b and none beyond: neighbours overlap by that one voxel. Shading reaches farther:
/// by the gradient's step on both sides (central differences) or on the upper one (forward), one voxel
/// without levels; the cubic filter by one voxel on both sides.
///
/// Of the coarsest level every tile holds its whole part; of a finer one only the box that lenses show
/// magnified enough to be seen at it (level_of in shaders/lib/levels.glsl).
///
/// Throws UsageError naming render.tiles or render.levels where the volume has too few voxels for them.
BrickPlan plan_bricks(const PreparedScene& prepared);

/// The box of the data that lenses show magnified enough to be seen at `level`, texture coordinates, empty
/// (low > high) for nothing of it; no value for the coarsest level and under render.footprint `mip`, where
/// any data may be.
std::optional<Bounds> finer_level_data(const PreparedScene& prepared, std::size_t level);

/// Voxels of all bricks together. Throws LimitError on overflow.
std::size_t brick_voxels(const BrickPlan& plan);

/// level_of: the level that data shown magnified by q is seen at (shaders/lib/levels.glsl), in double.
double level_of(double q, double coarsest, double log_zoom);

} // namespace slicelens
