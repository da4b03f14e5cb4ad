// Which planes show anything in which part of the picture (render.skip).
#pragma once

#include "render/prepare.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace slicelens {

/// Pixels along the edge of a tile.
inline constexpr int tile_edge = 16;

/// Pixels of the least number of tiles that cover `pixels`.
constexpr int whole_tiles(int pixels, int edge) { return (pixels + edge - 1) / edge * edge; }

/// Plane numbers, first ≤ last; none: first > last.
struct PlaneSpan {
  std::int32_t first = 0;
  std::int32_t last = -1;
};

/// Planes in passes of `planes_per_pass`: plane k is in pass ⌊k/planes_per_pass⌋.
struct PassTiles {
  int columns = 0; ///< tiles across the picture, ⌈width/tile_edge⌉
  int rows = 0;    ///< tiles up the picture, row 0 at its bottom
  std::int64_t first_pass = 0;
  std::size_t passes = 0;
  std::vector<PlaneSpan> spans; ///< (pass − first_pass)·rows·columns + row·columns + column
};

std::int64_t pass_of(std::int64_t plane, std::size_t planes_per_pass);

/// The planes from `first` to `last` whose samples in a tile may show something: those that cut the place
/// where an occupied cell is shown. Conservative. Needs prepared.cells.
PassTiles tiles_of_passes(const PreparedScene& prepared, std::int64_t first, std::int64_t last);

} // namespace slicelens
