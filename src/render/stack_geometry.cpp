#include "render/stack_geometry.h"

#include "core/errors.h"
#include "core/stopwatch.h"
#include "render/bricks.h"
#include "slicing/shell_stack.h"
#include "slicing/slice_stack.h"
#include "tess/subdivided_slice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slicelens {

namespace {

void append_mesh(StackGeometry& geometry, const LensMesh& mesh) {
  if (geometry.vertices.size() + mesh.vertices.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw LimitError(
        "the lens has too many triangles for one picture; use fewer segments or a larger spacing");
  }
  const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
  for (const LensVertex& vertex : mesh.vertices)
    geometry.vertices.push_back({glm::vec3(vertex.position), glm::vec4(vertex.texture)});
  for (const std::uint32_t index : mesh.triangles)
    geometry.indices.push_back(first + index);
  geometry.regions.insert(geometry.regions.end(), mesh.regions.begin(), mesh.regions.end());
}

void append_tiles(StackGeometry& geometry, const LensMesh& mesh, const TileCuts& cuts) {
  const std::vector<LensMesh> parts = split_by_tiles(mesh, cuts);
  const bool backwards = geometry.index_ends.size() % 2 == 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const std::size_t tile = backwards ? parts.size() - 1 - i : i;
    if (parts[tile].triangles.empty())
      continue;
    append_mesh(geometry, parts[tile]);
    if (geometry.batches.empty() || geometry.batches.back().tile != tile)
      geometry.batches.push_back({tile, 0});
    geometry.batches.back().end = geometry.indices.size();
  }
}

/// Near and far of what is displayed, along the view axis. Depth is not used; they need only hold everything.
Interval drawn_depths(const PreparedScene& prepared) {
  const double middle = depth(prepared.view, center(prepared.box));
  double radius = bounding_radius(prepared.box);
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 corner =
        glm::mix(prepared.object_low, prepared.object_high, glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1));
    radius =
        std::max(radius, std::abs(depth(prepared.view, world_from_texture(prepared.box, corner)) - middle));
  }
  double near = middle - 1.01 * radius;
  const double far = std::max(middle + 1.01 * radius, near + radius);
  if (prepared.view.projection == Projection::perspective)
    near = std::max(near, 1e-6 * far);
  return {near, far};
}

/// All shells are drawn in one plane; the fragments find their samples themselves (gpu/ray.glsl), each vertex
/// says of which shell.
StackGeometry shell_geometry(const PreparedScene& prepared, SliceRequest request) {
  request.low = prepared.object_low;
  request.high = prepared.object_high;
  const Interval depths = drawn_depths(prepared);
  const Stopwatch watch;
  const SliceStack stack = make_shell_stack(request, (depths.near + depths.far) / 2);
  StackGeometry geometry;
  geometry.cut_seconds = watch.seconds();
  for (const Slice& slice : stack.slices) {
    const auto first = static_cast<std::uint32_t>(geometry.vertices.size());
    for (std::uint32_t i = 0; i < slice.count; ++i) {
      geometry.vertices.push_back(
          {glm::vec3(stack.corners[slice.first + i]), glm::vec4(slice.index, 0, 0, 1)});
    }
    for (std::uint32_t i = 1; i + 1 < slice.count; ++i)
      geometry.indices.insert(geometry.indices.end(), {first, first + i, first + i + 1});
    geometry.index_ends.push_back(geometry.indices.size());
    geometry.numbers.push_back({slice.index, slice.index});
  }
  return geometry;
}

/// Refuses meshes that would take gigabytes before they are made.
void check_cells(const SliceStack& stack, std::size_t subdivision) {
  constexpr double most = 3e7;
  const auto edge = static_cast<double>(subdivision);
  const double cells = static_cast<double>(stack.slices.size()) * edge * edge;
  if (cells > most) {
    throw LimitError("render.subdivision " + std::to_string(subdivision) +
                     " makes more than 30 million cells of " + std::to_string(stack.slices.size()) +
                     " slices; make it smaller or render.spacing larger");
  }
}

} // namespace

bool is_subdivided(const PreparedScene& prepared) {
  return prepared.scene.render.pipeline == Pipeline::tessellated && is_warped(prepared) &&
         prepared.lenses.size() != prepared.maps.size();
}

StackGeometry make_stack_geometry(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  const bool warped = is_warped(prepared);
  // A lens whose footprint no later warp moves is covered tightly, a list of others by the box that holds
  // all.
  const bool lenses_only = prepared.lenses.size() == prepared.maps.size() && prepared.others.empty();
  SliceRequest request;
  request.box = prepared.box;
  request.view = prepared.view;
  request.spacing = prepared.spacing;
  request.order =
      render.order == Order::front_to_back ? SliceOrder::front_to_back : SliceOrder::back_to_front;
  if (render.proxy == Proxy::shells)
    return shell_geometry(prepared, request);
  // Samples that jitter moves off their slice may come back into the volume: fragments test where they are.
  const bool moved = render.jitter > 0;
  if (!moved && (!lenses_only || !warped))
    request.clip = prepared.object_clip;
  if (!moved && !warped)
    request.clip.insert(request.clip.end(), prepared.data_clip.begin(), prepared.data_clip.end());
  if (!lenses_only || moved) {
    const glm::dvec3 margin = (moved ? 2 * prepared.spacing : 0) / extent(prepared.box);
    request.low = prepared.object_low - margin;
    request.high = prepared.object_high + margin;
  }
  const Stopwatch watch;
  const SliceStack stack = make_slice_stack(request);
  StackGeometry geometry;
  geometry.cut_seconds = watch.seconds();
  if (is_subdivided(prepared))
    check_cells(stack, render.subdivision);

  const LensClip clip{prepared.data_clip, prepared.object_clip};
  const TileCuts cuts = is_bricked(prepared) ? plan_bricks(prepared).cuts : TileCuts{};
  for (const Slice& slice : stack.slices) {
    const Polygon polygon(stack.corners.begin() + slice.first,
                          stack.corners.begin() + slice.first + slice.count);
    LensMesh mesh;
    if (is_subdivided(prepared)) {
      mesh = subdivide_slice(polygon, prepared.maps, prepared.space, prepared.warp_view, render.subdivision);
    } else if (!warped || !lenses_only) {
      mesh = cover_slice(polygon, {}, prepared.space, {});
    } else if (render.pipeline == Pipeline::fragment || render.pipeline == Pipeline::grid) {
      mesh = cover_slice(polygon, prepared.lenses, prepared.space, prepared.object_clip);
    } else {
      mesh = tessellate_slice(polygon, prepared.lenses, prepared.space, clip);
    }
    if (tile_count(cuts) > 1)
      append_tiles(geometry, mesh, cuts);
    else
      append_mesh(geometry, mesh);
    geometry.index_ends.push_back(geometry.indices.size());
    geometry.numbers.push_back({slice.index, slice.index});
  }
  return geometry;
}

glm::dmat4 clip_from_texture(const PreparedScene& prepared) {
  const auto [near, far] = drawn_depths(prepared);
  return clip_from_world(prepared.view, near, far) * prepared.box.world_from_texture;
}

} // namespace slicelens
