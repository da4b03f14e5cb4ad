#include "render/pass_tiles.h"

#include "render/occupancy.h"
#include "render/shown_parts.h"
#include "render/stack_geometry.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slicelens {

namespace {

glm::dvec3 corner(const glm::dvec3& low, const glm::dvec3& high, int k) {
  return glm::mix(low, high, glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1));
}

/// Whether some half-space leaves nothing of a box.
bool is_cut_away(const std::vector<Plane>& planes, const glm::dvec3& low, const glm::dvec3& high) {
  return std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
    const glm::dvec3 farthest = glm::mix(low, high, glm::greaterThan(plane.normal, glm::dvec3(0)));
    return signed_value(plane, farthest) < -1e-9 * glm::length(plane.normal);
  });
}

/// What a box of texture coordinates of the displayed volume covers: pixels from the bottom left corner, and
/// depths in slice distances from the plane between planes −1 and 0.
struct Cover {
  glm::dvec2 low{std::numeric_limits<double>::infinity()};
  glm::dvec2 high{-std::numeric_limits<double>::infinity()};
  double near = std::numeric_limits<double>::infinity();
  double far = -std::numeric_limits<double>::infinity();
};

class Projector {
public:
  explicit Projector(const PreparedScene& prepared)
      : clip_from_texture_(slicelens::clip_from_texture(prepared)),
        size_(prepared.view.width, prepared.view.height) {
    const View& view = prepared.view;
    const glm::dmat4& world_from_texture = prepared.box.world_from_texture;
    const glm::dvec3 slope = glm::transpose(glm::dmat3(world_from_texture)) * view.forward;
    const double offset = depth(view, glm::dvec3(world_from_texture[3])) - depth(view, center(prepared.box));
    distance_ = glm::dvec4(slope, offset) / prepared.spacing;
    eye_ = view.projection == Projection::perspective ? -depth(view, center(prepared.box)) / prepared.spacing
                                                      : -std::numeric_limits<double>::infinity();
  }

  Cover cover(const glm::dvec3& low, const glm::dvec3& high) const {
    Cover cover;
    for (int k = 0; k < 8; ++k) {
      const glm::dvec4 point(corner(low, high, k), 1);
      const double distance = glm::dot(distance_, point);
      cover.near = std::min(cover.near, distance);
      cover.far = std::max(cover.far, distance);
      const glm::dvec4 clip = clip_from_texture_ * point;
      const glm::dvec2 pixel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * size_;
      cover.low = glm::min(cover.low, pixel);
      cover.high = glm::max(cover.high, pixel);
    }
    // At the eye and behind it corners say nothing about what is seen.
    if (cover.near <= eye_ + 1e-3) {
      cover.low = glm::dvec2(0);
      cover.high = size_;
    }
    return cover;
  }

private:
  glm::dmat4 clip_from_texture_;
  glm::dvec2 size_;
  glm::dvec4 distance_{0};
  double eye_ = 0;
};

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
  void mark(const Cover& cover) {
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

/// A cell, for segments with all that its faces on the volume's stand for: ends beyond the volume take the
/// values of its edge. As much as the volume again is more than half a sample distance looks away from it.
Bounds with_edge(const CellBox& cell) {
  const glm::dvec3 zero(0);
  const glm::dvec3 one(1);
  return {glm::mix(cell.low, zero - 1.0, glm::equal(cell.low, zero)),
          glm::mix(cell.high, one + 1.0, glm::equal(cell.high, one))};
}

} // namespace

std::int64_t pass_of(std::int64_t plane, std::size_t planes_per_pass) {
  const auto count = static_cast<std::int64_t>(planes_per_pass);
  return plane >= 0 ? plane / count : -((count - 1 - plane) / count);
}

PassTiles tiles_of_passes(const PreparedScene& prepared, std::int64_t first, std::int64_t last) {
  const Projector projector(prepared);
  const ShownBounds shown_part = shown_parts(prepared);
  const Occupancy occupancy = occupancy_of(prepared);
  // A segment may show what lies beside its sample, also beyond what cuts the sample away.
  const bool between = looks_between_samples(prepared.scene.render);
  std::vector<std::optional<Bounds>> shown(occupancy.shows.size());
  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
    if (occupancy.shows[i] == 0)
      return;
    const CellBox cell = cell_box(prepared, i);
    if (between)
      shown[i] = shown_part(with_edge(cell));
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
