#include "render/pages.h"

#include "core/errors.h"
#include "render/bricks.h"
#include "render/occupancy.h"
#include "render/pre_classification.h"
#include "render/shown_parts.h"
#include "render/texels.h"
#include "scene/names.h"
#include "volume/pyramid.h"
#include "volume/streamed.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace slicelens {

namespace {

bool is_textured(const PreparedScene& prepared) {
  return prepared.scene.render.pipeline != Pipeline::reference;
}

std::size_t texel_bytes(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  if (render.classification == Classification::pre)
    return classified_voxel_bytes;
  return texel_bytes(render.volume_texture, prepared.volume.type);
}

/// Whether taps of gradients go through the warp and may look anywhere.
bool looks_anywhere(const PreparedScene& prepared) {
  return uses_gradients(prepared.scene) && prepared.gradient_space == GradientSpace::object;
}

} // namespace

std::size_t texture_budget(const RenderSettings& render) {
  return checked_product(render.memory.value_or(default_memory), std::size_t{1} << 20, "render.memory");
}

bool is_paged(const PreparedScene& prepared) {
  if (!is_textured(prepared))
    return false;
  if (is_streamed(prepared.volume))
    return true;
  const auto& dims = prepared.volume.dims;
  return std::max({dims[0], dims[1], dims[2]}) > most_texture_voxels ||
         voxel_count(prepared.volume) > texture_budget(prepared.scene.render) / texel_bytes(prepared);
}

bool any_paged(const PreparedScene& prepared) {
  return is_paged(prepared) || std::any_of(prepared.others.begin(), prepared.others.end(), is_paged);
}

void refuse_unpaged_settings(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  const auto refuse = [&](const std::string& what, const std::string& instead) {
    const auto& dims = prepared.volume.dims;
    if (is_streamed(prepared.volume)) {
      throw UsageError("the volume's voxels stay on disk (" + prepared.volume.streamed->where + "), and " +
                       what + " in one texture; " + instead + ", with volume.access set to memory");
    }
    throw UsageError("a volume of " + std::to_string(dims[0]) + " x " + std::to_string(dims[1]) + " x " +
                     std::to_string(dims[2]) + " voxels does not fit render.memory (" +
                     std::to_string(render.memory.value_or(default_memory)) + " MiB, edges of at most " +
                     std::to_string(most_texture_voxels) + "), and " + what + " in one texture; " + instead);
  };
  if (render.pipeline == Pipeline::fixed_function)
    refuse("pipeline 'fixed-function' holds it", "take another pipeline or raise render.memory");
  if (render.tiles != std::array<std::size_t, 3>{1, 1, 1})
    refuse("render.tiles cut what is held", "set render.tiles to [1,1,1] or raise render.memory");
  if (uses_gradients(prepared.scene) &&
      (render.gradient == Gradient::prefiltered || render.gradient == Gradient::precomputed))
    refuse("render.gradient '" + word(render.gradient) + "' holds gradients",
           "set render.gradient to central or forward, or raise render.memory");
  if (!prepared.scene.planes.empty())
    refuse("planes look at any of it", "remove planes or raise render.memory");
  if (!prepared.volume.colors.rgba.empty())
    refuse("a volume of colours is held", "choose volume.component or raise render.memory");
}

PageGrid page_grid(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  PageGrid grid;
  grid.edge = render.brick;
  const std::size_t step = !uses_gradients(prepared.scene) || looks_anywhere(prepared) ? 0
                           : prepared.levels > 1                                       ? 2
                                                                                       : 1;
  grid.overlap = (render.filter == Filter::cubic ? 2 : 1) + step;
  std::size_t layer = 0;
  for (std::size_t k = 0; k < prepared.levels; ++k) {
    PageLevel level;
    level.voxels = level_dims(prepared.volume.dims, k);
    for (std::size_t axis = 0; axis < 3; ++axis)
      level.pages[axis] = (level.voxels[axis] + grid.edge - 1) / grid.edge;
    level.first = grid.count;
    level.layer = layer;
    grid.count += level.pages[0] * level.pages[1] * level.pages[2];
    layer += level.pages[2];
    grid.levels.push_back(level);
  }
  if (grid.count > std::numeric_limits<std::uint32_t>::max())
    throw LimitError("the volume has more pages than can be counted; make render.brick larger");
  return grid;
}

PageAddress address_of(const PageGrid& grid, std::size_t page) {
  PageAddress address;
  while (address.level + 1 < grid.levels.size() && page >= grid.levels[address.level + 1].first)
    ++address.level;
  const PageLevel& level = grid.levels[address.level];
  const std::size_t i = page - level.first;
  address.at = {i % level.pages[0], i / level.pages[0] % level.pages[1], i / level.pages[0] / level.pages[1]};
  return address;
}

namespace {

/// The voxels of level 0 that a page holds, half a voxel beyond them; texture coordinates.
Bounds data_of(const PreparedScene& prepared, const PageGrid& grid, const PageAddress& page) {
  const double edge = std::ldexp(static_cast<double>(grid.edge), static_cast<int>(page.level));
  const auto& dims = prepared.volume.dims;
  const glm::dvec3 size = edge / glm::dvec3(dims[0], dims[1], dims[2]);
  const glm::dvec3 low = size * glm::dvec3(page.at[0], page.at[1], page.at[2]);
  return {low, glm::min(low + size, glm::dvec3(1))};
}

/// What the cells that a page's samples read say together.
struct CellSummary {
  float smallest = std::numeric_limits<float>::infinity();
  float largest = -std::numeric_limits<float>::infinity();
  bool shows = false;
};

CellSummary summary_of(const PreparedScene& prepared, const PageGrid& grid, const PageAddress& page,
                       const std::vector<std::uint8_t>& shows, std::size_t margin) {
  const CellRanges& cells = *prepared.cells;
  const std::size_t edge = grid.edge << page.level;
  std::array<std::size_t, 3> low;
  std::array<std::size_t, 3> high;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t begin = page.at[axis] * edge;
    const std::size_t end = std::min(begin + edge, prepared.volume.dims[axis]) + margin;
    low[axis] = (begin - std::min(begin, margin)) / cell_edge;
    high[axis] = std::min((end + cell_edge - 1) / cell_edge, cells.size[axis]);
  }
  CellSummary summary;
  for (std::size_t k = low[2]; k < high[2]; ++k) {
    for (std::size_t j = low[1]; j < high[1]; ++j) {
      for (std::size_t i = low[0]; i < high[0]; ++i) {
        const std::size_t at = (k * cells.size[1] + j) * cells.size[0] + i;
        summary.smallest = std::min(summary.smallest, cells.smallest[at]);
        summary.largest = std::max(summary.largest, cells.largest[at]);
        summary.shows = summary.shows || shows.empty() || shows[at] != 0;
      }
    }
  }
  return summary;
}

/// Whether cells that show nothing can be left out: where every sample is classified by its own value. Ends
/// of segments, labels and means look at other samples' values or weigh them all.
bool emptiness_counts(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  const bool by_value = render.mode == Mode::dvr || render.mode == Mode::xray || render.mode == Mode::mip ||
                        render.mode == Mode::minip;
  return by_value && render.classification != Classification::preintegrated && !looks_anywhere(prepared);
}

} // namespace

std::vector<PageContent> page_contents(const PreparedScene& prepared, const PageGrid& grid) {
  std::vector<PageContent> contents(grid.count);
  const bool empties = emptiness_counts(prepared);
  const bool iso = prepared.scene.render.mode == Mode::iso;
  const auto shows = empties ? occupancy_of(prepared).shows : std::vector<std::uint8_t>{};
  const double isovalue = isovalue_of(prepared);
  const double rounding = 1e-4 * (prepared.volume.max - prepared.volume.min);
  std::vector<std::optional<Bounds>> seen;
  for (std::size_t level = 0; level < grid.levels.size(); ++level)
    seen.push_back(finer_level_data(prepared, level));
  tbb::parallel_for(std::size_t{0}, grid.count, [&](std::size_t i) {
    const PageAddress page = address_of(grid, i);
    // Cells know the voxels one or two beyond; samples that blend two levels and taps of gradients look
    // farther.
    const std::size_t reach = prepared.levels > 1              ? (grid.overlap + 1) << (page.level + 1)
                              : uses_gradients(prepared.scene) ? grid.overlap
                                                               : 0;
    const CellSummary cells = summary_of(prepared, grid, page, shows, reach);
    contents[i].value = cells.smallest;
    const bool same = !(cells.smallest < cells.largest);
    const bool crossed =
        !iso || (cells.smallest - rounding <= isovalue && isovalue <= cells.largest + rounding);
    const Bounds data = data_of(prepared, grid, page);
    const auto& part = seen[page.level];
    const bool in_part = !part || (glm::all(glm::lessThanEqual(data.low, part->high)) &&
                                   glm::all(glm::greaterThanEqual(data.high, part->low)));
    // Without values of labels a page of one value still has several objects.
    const bool uniform = same && prepared.scene.render.mode != Mode::two_level;
    contents[i].needed = in_part && !uniform && cells.shows && crossed;
  });
  return contents;
}

namespace {

/// How many slices nearer and farther than its own a sample looks.
glm::dvec2 slice_margins(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  double margin = 1e-3;
  if (render.mode == Mode::iso)
    margin += 1;
  if (render.classification == Classification::preintegrated)
    margin += 0.5;
  if (looks_anywhere(prepared)) {
    const glm::dvec3& h = prepared.volume.spacing;
    margin += 2 * glm::length(h) / prepared.spacing;
  }
  return {margin + render.jitter, margin};
}

/// Under perspective shells and rays count distances from the eye.
bool counts_from_eye(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  return prepared.view.projection == Projection::perspective &&
         (render.proxy == Proxy::shells || render.pipeline == Pipeline::rays);
}

/// By the sphere about a box of texture coordinates.
void cover_from_eye(const PreparedScene& prepared, const Bounds& shown, ScreenCover& cover) {
  const Box& box = prepared.box;
  const glm::dvec3 middle = world_from_texture(box, 0.5 * (shown.low + shown.high));
  double radius = 0;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 corner = glm::mix(shown.low, shown.high, glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1));
    radius = std::max(radius, glm::length(world_from_texture(box, corner) - middle));
  }
  const double distance =
      glm::length(middle - prepared.view.eye) - glm::length(prepared.view.eye - center(box));
  cover.near = (distance - radius) / prepared.spacing;
  cover.far = (distance + radius) / prepared.spacing;
}

} // namespace

ScreenCover cover_of_samples(const PreparedScene& prepared, const Bounds& shown) {
  ScreenCover cover = ScreenProjector(prepared).cover(shown.low, shown.high);
  if (counts_from_eye(prepared))
    cover_from_eye(prepared, shown, cover);
  return cover;
}

std::vector<PageNeed> page_needs(const PreparedScene& prepared, const PageGrid& grid,
                                 std::span<const PageContent> contents) {
  const ScreenProjector projector(prepared);
  const std::vector<WarpMap> maps = drawn_maps(prepared);
  const glm::dvec2 margin = slice_margins(prepared);
  const bool anywhere = looks_anywhere(prepared);
  const bool radial = counts_from_eye(prepared);
  const bool lenses_only = !maps.empty() && prepared.lenses.size() == maps.size();
  const bool segments = prepared.scene.render.classification == Classification::preintegrated;
  // Ends of segments lie beyond planes that cut the data.
  const bool cut = !anywhere && !segments;
  const ShownBounds shown_part = shown_parts(prepared);
  std::vector<PageNeed> needs;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    if (!contents[i].needed)
      continue;
    const Bounds data = data_of(prepared, grid, address_of(grid, i));
    if (cut && is_cut_away(prepared.data_clip, data.low, data.high))
      continue;
    const std::optional<Bounds> where = shown_part(segments ? with_edge(data) : data);
    if (!where)
      continue;
    const Bounds& shown = *where;
    if (cut && is_cut_away(prepared.object_clip, shown.low, shown.high))
      continue;
    ScreenCover cover = projector.cover(shown.low, shown.high);
    if (radial) {
      cover_from_eye(prepared, shown, cover);
    } else if (lenses_only) { // LaMar's leaves the planes across the view where they are
      const ScreenCover own = projector.cover(data.low, data.high);
      cover.near = own.near;
      cover.far = own.far;
    }
    const double height = prepared.view.height;
    if (!anywhere && (cover.high.x < -1 || cover.low.x > prepared.view.width + 1 || cover.high.y < -1 ||
                      cover.low.y > height + 1))
      continue;
    PageNeed need;
    need.page = static_cast<std::uint32_t>(i);
    need.bottom = anywhere ? 0.0F : static_cast<float>(cover.low.y - 1);
    need.top = anywhere ? static_cast<float>(height) : static_cast<float>(cover.high.y + 1);
    need.near = static_cast<float>(cover.near - margin.x);
    need.far = static_cast<float>(cover.far + margin.y);
    needs.push_back(need);
  }
  return needs;
}

} // namespace slicelens
