#include "render/slabs.h"

#include "core/stopwatch.h"
#include "render/occupancy.h"
#include "render/pass_tiles.h"
#include "render/ray_uniforms.h"
#include "slicing/slice_stack.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

/// The planes of the stack as make_stack_geometry cuts them, but wherever the displayed volume may be: which
/// samples are in it is for the fragments to decide.
SliceRequest plane_request(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  SliceRequest request;
  request.box = prepared.box;
  request.view = prepared.view;
  request.spacing = prepared.spacing;
  request.order =
      render.order == Order::front_to_back ? SliceOrder::front_to_back : SliceOrder::back_to_front;
  const bool moved = render.jitter > 0;
  if (!moved) {
    request.clip = prepared.object_clip;
    if (!is_warped(prepared))
      request.clip.insert(request.clip.end(), prepared.data_clip.begin(), prepared.data_clip.end());
  }
  const glm::dvec3 margin = (moved ? 2 * prepared.spacing : 0) / extent(prepared.box);
  request.low = prepared.object_low - margin;
  request.high = prepared.object_high + margin;
  return request;
}

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Andrew's monotone chain, counter-clockwise.
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::sort(points.begin(), points.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<glm::dvec2> hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const glm::dvec2& point : points) {
      while (hull.size() >= start + 2 && cross(hull[hull.size() - 2], hull.back(), point) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back(); // the other half begins with it
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

/// The slices of one pass.
struct Slab {
  std::size_t begin = 0; ///< in SliceStack::slices
  std::size_t end = 0;
  std::int64_t first = 0; ///< plane numbers
  std::int64_t last = -1;
};

/// Passes hold the same planes whichever comes first: plane k is in pass floor(k / planes).
std::vector<Slab> slabs_of(const SliceStack& stack, std::size_t planes) {
  std::vector<Slab> slabs;
  for (std::size_t i = 0; i < stack.slices.size(); ++i) {
    const std::int64_t k = stack.slices[i].index;
    if (slabs.empty() || pass_of(slabs.back().first, planes) != pass_of(k, planes))
      slabs.push_back({i, i, k, k});
    Slab& slab = slabs.back();
    slab.end = i + 1;
    slab.first = std::min(slab.first, k);
    slab.last = std::max(slab.last, k);
  }
  return slabs;
}

void append_polygon(StackGeometry& geometry, const std::vector<glm::dvec2>& polygon, std::int64_t first,
                    std::int64_t last) {
  const auto start = static_cast<std::uint32_t>(geometry.vertices.size());
  for (const glm::dvec2& point : polygon)
    geometry.vertices.push_back({glm::vec3(glm::dvec3(point, 0)), glm::vec4(first, last, 0, 1)});
  for (std::uint32_t i = 1; i + 1 < polygon.size(); ++i)
    geometry.indices.insert(geometry.indices.end(), {start, start + i, start + i + 1});
}

/// Where the slab's polygons are seen, wider by a pixel and a half: the fragments on their outline are the
/// shader's to choose.
std::vector<glm::dvec2> outline(const PreparedScene& prepared, const glm::dmat4& clip_from_texture,
                                const SliceStack& stack, const Slab& slab) {
  const glm::dvec2 margin = 3.0 / glm::dvec2(prepared.view.width, prepared.view.height);
  std::vector<glm::dvec2> points;
  for (std::size_t i = slab.begin; i < slab.end; ++i) {
    const Slice& slice = stack.slices[i];
    for (std::uint32_t c = 0; c < slice.count; ++c) {
      const glm::dvec4 clip = clip_from_texture * glm::dvec4(stack.corners[slice.first + c], 1);
      const glm::dvec2 place = glm::dvec2(clip) / clip.w;
      for (int side = 0; side < 4; ++side)
        points.push_back(place + margin * glm::dvec2(side & 1 ? 1 : -1, side & 2 ? 1 : -1));
    }
  }
  return convex_hull(std::move(points));
}

/// The tiles of a pass that show something.
void append_tiles(StackGeometry& geometry, const PassTiles& tiles, const Slab& slab, std::size_t pass) {
  const glm::dvec2 size(tiles.columns, tiles.rows);
  const PlaneSpan* spans = tiles.spans.data() + pass * static_cast<std::size_t>(tiles.columns * tiles.rows);
  for (int row = 0; row < tiles.rows; ++row) {
    for (int column = 0; column < tiles.columns; ++column) {
      const PlaneSpan span = *spans++;
      const auto first = std::max<std::int64_t>(span.first, slab.first);
      const auto last = std::min<std::int64_t>(span.last, slab.last);
      if (first > last)
        continue;
      const glm::dvec2 middle = (glm::dvec2(column, row) + 0.5) / size * 2.0 - 1.0;
      geometry.indices.push_back(static_cast<std::uint32_t>(geometry.vertices.size()));
      geometry.vertices.push_back({glm::vec3(glm::dvec3(middle, 0)), glm::vec4(first, last, 0, 1)});
    }
  }
}

} // namespace

bool draws_slabs(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  return draws_slices(render.pipeline) &&
         (render.planes_per_pass > 1 || prepared.skipping.empty || marks_hidden(prepared));
}

bool marks_hidden(const PreparedScene& prepared) {
  const glm::dvec3 size = (prepared.object_high - prepared.object_low) * extent(prepared.box);
  return prepared.skipping.opaque_after < glm::length(size) / prepared.spacing;
}

StackGeometry make_slab_geometry(const PreparedScene& prepared) {
  const Stopwatch watch;
  const SliceStack stack = make_slice_stack(plane_request(prepared));
  StackGeometry geometry;
  geometry.planes = stack.slices.size();
  geometry.cut_seconds = watch.seconds();
  const glm::dmat4 to_clip = clip_from_texture(prepared);
  const std::size_t per_pass = prepared.scene.render.planes_per_pass;
  const std::vector<Slab> slabs = slabs_of(stack, per_pass);
  PassTiles tiles;
  if (prepared.skipping.empty && !slabs.empty()) {
    tiles = tiles_of_passes(prepared, std::min(slabs.front().first, slabs.back().first),
                            std::max(slabs.front().last, slabs.back().last));
  }
  geometry.tile_edge = tiles.passes > 0 ? tile_edge : 0;
  for (const Slab& slab : slabs) {
    if (tiles.passes > 0) {
      append_tiles(geometry, tiles, slab,
                   static_cast<std::size_t>(pass_of(slab.first, per_pass) - tiles.first_pass));
    } else {
      append_polygon(geometry, outline(prepared, to_clip, stack, slab), slab.first, slab.last);
    }
    geometry.index_ends.push_back(geometry.indices.size());
    geometry.numbers.push_back({slab.first, slab.last});
  }
  return geometry;
}

void set_slab_uniforms(const gl::Functions& gl, const gl::Program& program, const PreparedScene& prepared) {
  set_ray_uniforms(gl, program, prepared);
  const View& view = prepared.view;
  // Distances along the view axis count from the plane through the box centre, as those of the stack do.
  const double plane_depth = depth(view, center(prepared.box));
  const glm::dvec3 anchor = view.eye + plane_depth * view.forward;
  set_uniform(gl, program, "plane_center",
              glm::vec3(texture_from_world(prepared.box) * glm::dvec4(anchor, 1)));
  set_uniform(gl, program, "plane_depth", static_cast<float>(plane_depth));
  set_uniform(gl, program, "nothing_behind", static_cast<float>(opaque_enough));
  set_uniform(gl, program, "place_from_pixel", 2.0F / glm::vec2(view.width, view.height));
}

} // namespace slicelens
