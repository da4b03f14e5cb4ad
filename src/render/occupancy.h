// Which cells of the volume show anything under the transfer function (render.skip). docs/skipping.md.
#pragma once

#include "render/prepare.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace slicelens {

/// One entry for each cell of CellRanges, x fastest.
struct Occupancy {
  std::array<std::size_t, 3> size{0, 0, 0};
  std::vector<std::uint8_t> shows; ///< 0 or 1
  std::size_t count = 0;           ///< of those that show something
  /// What textures hold: 255 where a cell shows something, else the number of the stretch of values without
  /// opacity that all of its values lie in. Between two cells of one stretch nothing shows either.
  std::vector<std::uint8_t> stretches;
};

/// Cells in which a sample may have opacity: where the table of the transfer function, as the driver filters
/// it, is above 0 anywhere between the smallest and the largest value that the filter may read, widened by
/// what textures round values by. Modes `mip` and `minip`: anywhere up to the largest, down to the smallest
/// value: a ray whose extreme value shows nothing is as empty as one without a sample. Mode `iso`: where the
/// isovalue is among the values. Mode `two-level`: where a label that is there shows any of them; a label
/// whose runs count as a whole shows all. Classifications `pre` and `preintegrated`: by the function itself,
/// which has no table, the latter up to the next texels of its own. Conservative, never wrong. Needs
/// prepared.cells.
Occupancy occupancy_of(const PreparedScene& prepared);
/// The same of other cells of the same volume; mode `two-level` knows the labels in prepared.cells only.
Occupancy occupancy_of(const PreparedScene& prepared, const CellRanges& cells);

/// Whether samples show what lies between two places: surfaces, and segments that are integrated beforehand.
bool looks_between_samples(const RenderSettings& render);

/// Share of occupied cells from which on looking at cells costs more than it saves (docs/skipping.md).
inline constexpr double too_many_occupied = 0.7;

/// The opacity behind which nothing is drawn. What could come through is at most 1/512 of a colour, half of
/// what an 8-bit picture can show, so colours up to 2 (light may add to them) stay within 1/255.
inline constexpr double opaque_enough = 1 - 1.0 / 512;

/// Needs prepared.cells and everything but the view's own geometry.
Skipping skipping_of(const PreparedScene& prepared);

/// The texture coordinates of cell `index` of `cells`: its lowest corner and its highest, at most 1.
struct CellBox {
  glm::dvec3 low{0};
  glm::dvec3 high{1};
};
CellBox cell_box(const PreparedScene& prepared, const CellRanges& cells, std::size_t index);

} // namespace slicelens
