// The triangles of a whole stack in drawing order, as the GPU takes them.
#pragma once

#include "render/prepare.h"

#include <cstdint>
#include <vector>

namespace slicelens {

/// One corner, 7 floats.
struct StackVertex {
  glm::vec3 position; ///< where it is shown: texture coordinates of the displayed volume
  glm::vec4 texture;  ///< (s·q, t·q, r·q, q) of the data looked at; read by pipeline `tessellated` only.
                      ///< Shells: x is the number k of the shell
};

/// The numbers k of the slices or samples that one entry of a drawing covers.
struct SliceNumbers {
  std::int64_t first = 0;
  std::int64_t last = -1;
};

/// Triangles that follow each other and read the same tile.
struct TileBatch {
  std::size_t tile = 0;
  std::size_t end = 0; ///< of its indices; they begin where the batch before ends
};

struct StackGeometry {
  std::vector<StackVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< three a triangle
  std::vector<std::size_t> index_ends; ///< of each slice
  std::vector<SliceNumbers> numbers;   ///< of each slice or pass
  std::vector<LensRegion> regions;     ///< of each triangle
  /// Where the volume is held in several tiles, else empty. Drawing is by slice, and by tile within a slice,
  /// where tiles share no more than edges: so blending is in order. Every other slice goes through its tiles
  /// backwards, so that a slice begins with the tile that the one before ended with.
  std::vector<TileBatch> batches;
  /// Of passes that are drawn in tiles: each corner is the middle of a square tile of so many pixels, in clip
  /// coordinates of a viewport of whole tiles (render/pass_tiles.h), and `indices` are single corners. Else
  /// 0.
  int tile_edge = 0;
  std::size_t planes = 0; ///< of all passes, where a pass draws several (render/slabs.h); else 0
  double cut_seconds = 0; ///< wall clock of cutting planes with the box; what else the call takes is making
                          ///< triangles
};

/// Whether pipeline `tessellated` cuts slices into regular cells: for every list of warps but LaMar's lenses,
/// which have a mesh of their own.
bool is_subdivided(const PreparedScene& prepared);

/// Cuts the stack for the scene's view and pipeline: plain polygons, lens triangles, or covers for lenses
/// evaluated at each fragment. Throws UsageError for a spacing that is too fine, LimitError for too many
/// cells.
StackGeometry make_stack_geometry(const PreparedScene& prepared);

/// Where the corners land: OpenGL clip coordinates of texture coordinates of the displayed volume.
glm::dmat4 clip_from_texture(const PreparedScene& prepared);

} // namespace slicelens
