// What a lens and its mesh look like as lines, for overlays in 2D and 3D. Points are texture coordinates of
// the displayed volume (of the picture in 2D). No OpenGL.
#pragma once

#include "tess/lens_mesh.h"

namespace slicelens {

using Polyline = std::vector<glm::dvec3>;

/// Edges of the zoom and of the border region on the plane at signed depth z from the lens centre (box
/// space), closed: the first point is repeated at the end. Circles are round, whatever the lens' angular
/// segments.
struct LensOutline {
  Polyline inner; ///< at radius r_i
  Polyline outer; ///< at radius r_o
};
LensOutline lens_outline(const LensTessellation& lens, const BoxSpace& space, double z);

/// The edges of a mesh, each once. With `diagonals` those of all triangles; without, only those of the
/// polygons that the triangles were made from: the borders of the segments and what clipping cut. (Triangles
/// of one polygon share indices, polygons do not: tessellate_slice gives each its own corners.)
std::vector<Polyline> mesh_edges(const LensMesh& mesh, bool diagonals);

/// A regular lattice of the data on the plane at depth coordinate t_z = `plane` (texture space), carried
/// through the lenses: the lines t_x = i·c and t_y = j·c with c = 1/`cells` of the longer of both edges, each
/// as `steps` pieces. Where the lens has the line run across it, it is drawn where the data is shown. Lenses
/// must look along the third axis.
std::vector<Polyline> lattice_lines(const std::vector<LensTessellation>& lenses, const BoxSpace& space,
                                    double plane, std::size_t cells, std::size_t steps);

} // namespace slicelens
