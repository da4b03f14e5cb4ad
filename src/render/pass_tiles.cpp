#include "render/pass_tiles.h"

#include "render/occupancy.h"
#include "render/stack_geometry.h"
#include "warp/object_bounds.h"

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
        jitter_(prepared.scene.render.jitter) {
    tiles_.columns = (prepared.view.width + tile_edge - 1) / tile_edge;
    tiles_.rows = (prepared.view.height + tile_edge - 1) / tile_edge;
    tiles_.first_pass = pass_of(first, per_pass_);
    tiles_.passes = static_cast<std::size_t>(pass_of(last, per_pass_) - tiles_.first_pass + 1);
    tiles_.spans.assign(tiles_.passes * static_cast<std::size_t>(tiles_.rows * tiles_.columns),
                        {std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()});
  }

  /// A thousandth of a slice distance and a hundredth of a pixel allow for the shader's rounding.
  void mark(const Cover& cover) {
    const auto first = std::max(first_, number(std::ceil(cover.near - 0.5 - jitter_ - 1e-3)));
    const auto last = std::min(last_, number(std::floor(cover.far - 0.5 + 1e-3)));
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
};

/// Where the data of a cell are shown, texture coordinates of the displayed volume; nothing where only the
/// whole displayed volume is known to hold them.
std::optional<Bounds> shown_cell(const PreparedScene& prepared, const std::vector<WarpMap>& maps,
                                 const CellBox& cell) {
  if (maps.empty())
    return Bounds{cell.low, cell.high};
  Bounds bounds{box_from_texture(prepared.space, cell.low), box_from_texture(prepared.space, cell.high)};
  for (const WarpMap& map : maps) {
    const auto shown = shown_bounds(map, bounds);
    if (!shown)
      return std::nullopt;
    bounds = *shown;
  }
  return Bounds{texture_from_box(prepared.space, bounds.low), texture_from_box(prepared.space, bounds.high)};
}

} // namespace

std::int64_t pass_of(std::int64_t plane, std::size_t planes_per_pass) {
  const auto count = static_cast<std::int64_t>(planes_per_pass);
  return plane >= 0 ? plane / count : -((count - 1 - plane) / count);
}

PassTiles tiles_of_passes(const PreparedScene& prepared, std::int64_t first, std::int64_t last) {
  const Projector projector(prepared);
  const std::vector<WarpMap> maps = drawn_maps(prepared);
  const Occupancy occupancy = occupancy_of(prepared);
  TileMarker marker(prepared, first, last);
  for (std::size_t i = 0; i < occupancy.shows.size(); ++i) {
    if (occupancy.shows[i] == 0)
      continue;
    const CellBox cell = cell_box(prepared, i);
    if (is_cut_away(prepared.data_clip, cell.low, cell.high))
      continue;
    const auto shown = shown_cell(prepared, maps, cell);
    if (!shown) {
      marker.mark(projector.cover(prepared.object_low, prepared.object_high));
      break;
    }
    if (!is_cut_away(prepared.object_clip, shown->low, shown->high))
      marker.mark(projector.cover(shown->low, shown->high));
  }
  return marker.take();
}

} // namespace slicelens
