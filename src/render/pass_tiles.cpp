#include "render/pass_tiles.h"

#include "render/occupancy.h"
#include "render/screen_cover.h"
#include "render/shown_parts.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slicelens {

namespace {

class TileMarker {
public:
  TileMarker(const PreparedScene& prepared, std::int64_t first, std::int64_t last)
      : per_pass_(prepared.scene.render.planes_per_pass), first_(first), last_(last),
        jitter_(prepared.scene.render.jitter), half_(looks_between_samples(prepared.scene.render) ? 0.5 : 0) {
    tiles_.columns = (prepared.view.width + tile_edge - 1) / tile_edge;
    tiles_.rows = (prepared.view.height + tile_edge - 1) / tile_edge;
    tiles_.first_pass = pass_of(first, per_pass_);
    tiles_.passes = static_cast<std::size_t>(pass_of(last, per_pass_) - tiles_.first_pass + 1);
    tiles_.spans.assign(tiles_.passes * static_cast<std::size_t>(tiles_.rows * tiles_.columns),
                        {std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()});
  }

  /// A thousandth of a slice distance and a hundredth of a pixel allow for the shader's rounding.
  void mark(const ScreenCover& cover) {
    const auto first = std::max(first_, number(std::ceil(cover.near - 0.5 - half_ - jitter_ - 1e-3)));
    const auto last = std::min(last_, number(std::floor(cover.far - 0.5 + half_ + 1e-3)));
    const int left = tile(cover.low.x - 0.01, tiles_.columns);
    const int right = tile(cover.high.x + 0.01, tiles_.columns);
    const int bottom = tile(cover.low.y - 0.01, tiles_.rows);
    const int top = tile(cover.high.y + 0.01, tiles_.rows);
    for (std::int64_t begin = first; begin <= last;) {
      const std::int64_t pass = pass_of(begin, per_pass_);
      const std::int64_t end = std::min(last, (pass + 1) * static_cast<std::int64_t>(per_pass_) - 1);
      const auto low = static_cast<std::int32_t>(begin);
      const auto high = static_cast<std::int32_t>(end);
      for (int y = std::max(bottom, 0); y <= std::min(top, tiles_.rows - 1); ++y) {
        PlaneSpan* row = tiles_.spans.data() + (static_cast<std::size_t>(pass - tiles_.first_pass) *
                                                    static_cast<std::size_t>(tiles_.rows) +
                                                static_cast<std::size_t>(y)) *
                                                   static_cast<std::size_t>(tiles_.columns);
        for (int x = std::max(left, 0); x <= std::min(right, tiles_.columns - 1); ++x) {
          row[x].first = std::min(row[x].first, low);
          row[x].last = std::max(row[x].last, high);
        }
      }
      begin = end + 1;
    }
  }

  PassTiles take() { return std::move(tiles_); }

private:
  std::int64_t number(double k) const {
    return static_cast<std::int64_t>(
        std::clamp(k, static_cast<double>(first_) - 1, static_cast<double>(last_) + 1));
  }
  static int tile(double pixel, int count) {
    return static_cast<int>(std::floor(std::clamp(pixel / tile_edge, -1.0, static_cast<double>(count))));
  }

  PassTiles tiles_;
  std::size_t per_pass_;
  std::int64_t first_;
  std::int64_t last_;
  double jitter_;
  double half_; ///< the part of a segment before its sample, slice distances
};

/// Whether the picture may jump from one value to another without those between: nothing can then be said of
/// the segment between two samples by the cells that it passes.
bool may_jump(const PreparedScene& prepared) {
  const std::vector<WarpMap> maps = drawn_maps(prepared);
  return std::any_of(maps.begin(), maps.end(), [](const WarpMap& map) { return has_cuts(map); }) ||
         (prepared.scene.render.pipeline == Pipeline::axis &&
          prepared.scene.render.axis_filter == AxisFilter::nearest);
}

} // namespace

std::int64_t pass_of(std::int64_t plane, std::size_t planes_per_pass) {
  const auto count = static_cast<std::int64_t>(planes_per_pass);
  return plane >= 0 ? plane / count : -((count - 1 - plane) / count);
}

PassTiles tiles_of_passes(const PreparedScene& prepared, std::int64_t first, std::int64_t last) {
  const ScreenProjector projector(prepared);
  const ShownBounds shown_part = shown_parts(prepared);
  const Occupancy occupancy = occupancy_of(prepared);
  // A segment may show what lies beside its sample, also beyond what cuts the sample away.
  const bool between = looks_between_samples(prepared.scene.render);
  std::vector<std::optional<Bounds>> shown(occupancy.shows.size());
  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
    if (occupancy.shows[i] == 0)
      return;
    const CellBox cell = cell_box(prepared, *prepared.cells, i);
    if (between)
      shown[i] = shown_part(with_edge({cell.low, cell.high}));
    else if (!is_cut_away(prepared.data_clip, cell.low, cell.high))
      shown[i] = shown_part({cell.low, cell.high});
  });
  TileMarker marker(prepared, first, last);
  if (between && may_jump(prepared) && occupancy.count > 0)
    marker.mark(projector.cover(prepared.object_low, prepared.object_high));
  for (const std::optional<Bounds>& bounds : shown) {
    if (bounds && (between || !is_cut_away(prepared.object_clip, bounds->low, bounds->high)))
      marker.mark(projector.cover(bounds->low, bounds->high));
  }
  return marker.take();
}

} // namespace slicelens
