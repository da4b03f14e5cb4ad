#include "core/errors.h"
#include "core/text.h"
#include "scene/names.h"
#include "scene/rules.h"
#include "warp/axis_tables.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace slicelens {

/// Where Cohen's effects can be drawn.
void validate_effects(const Scene& scene) {
  validate(scene.highlight);
  validate(scene.attenuation);
  const RenderSettings& render = scene.render;
  if (render.axis_texels &&
      (*render.axis_texels < min_axis_texels || *render.axis_texels > max_axis_texels)) {
    throw UsageError("render.axis_texels must be from " + std::to_string(min_axis_texels) + " to " +
                     std::to_string(max_axis_texels) + ", not " + std::to_string(*render.axis_texels));
  }
  if (!has_effects(scene))
    return;
  const std::string section =
      scene.highlight.function != HighlightFunction::off ? "highlight" : "attenuation";
  if (render.pipeline == Pipeline::slices || render.pipeline == Pipeline::fixed_function) {
    throw UsageError("pipeline '" + word(render.pipeline) + "' draws no " + section +
                     "; use axis, tessellated, fragment, rays or reference");
  }
  if (render.classification == Classification::pre) {
    throw UsageError("render.classification 'pre' holds colours whose opacity is corrected already, which " +
                     section + " would change too late; set render.classification to post");
  }
  if (render.mode == Mode::average) {
    throw UsageError("mode 'average' has no one sample for " + section +
                     " to follow; set render.mode to another or remove it");
  }
  if (render.mode == Mode::iso && scene.attenuation.function != AttenuationFunction::off)
    throw UsageError("mode 'iso' shows an opaque surface, which attenuation would open; remove it");
  (void)focus_effects(scene.highlight, scene.attenuation, focus_region(scene.warp));
}

/// Each warp by a pipeline that can draw it.
void validate_warps(const Scene& scene) {
  const std::string pipeline = word(scene.render.pipeline);
  const bool meshed =
      scene.render.pipeline == Pipeline::tessellated || scene.render.pipeline == Pipeline::fixed_function;
  for (const Warp& warp : scene.warp) {
    validate(warp);
    const std::vector<std::string>& able = info_of(warp).pipelines;
    if (std::find(able.begin(), able.end(), pipeline) == able.end()) {
      const std::string reason = scene.render.pipeline == Pipeline::slices ? "draws no warp"
                                 : scene.render.pipeline == Pipeline::axis ? "needs a separable warp"
                                                                           : "cannot draw every warp";
      throw UsageError("pipeline '" + pipeline + "' " + reason + "; '" + kind_of(warp) +
                       "' can be drawn by " + join(able));
    }
    const auto* lens = std::get_if<LamarLens>(&warp);
    if (lens != nullptr && !lens->homogeneous && !meshed) {
      throw UsageError("homogeneous false is about corners of triangles; pipeline '" + pipeline +
                       "' has none, give tessellated or fixed-function");
    }
  }
  if (scene.overlay.wireframe != Wireframe::none && !meshed) {
    throw UsageError("overlay.wireframe shows the triangles of a lens; pipeline '" + pipeline +
                     "' has none, give tessellated or fixed-function");
  }
  if (scene.render.subdivision < 1 || scene.render.subdivision > max_subdivision) {
    throw UsageError("render.subdivision must be from 1 to " + std::to_string(max_subdivision) + ", not " +
                     std::to_string(scene.render.subdivision));
  }
  for (const std::size_t nodes : scene.render.grid_size) {
    if (nodes < smallest_grid_size || nodes > max_grid_nodes) {
      throw UsageError("render.grid_size must be from " + std::to_string(smallest_grid_size) + " to " +
                       std::to_string(max_grid_nodes) + " nodes on every axis, not " + std::to_string(nodes));
    }
  }
  if (scene.render.pipeline == Pipeline::axis)
    (void)make_axis_tables(scene.warp, {}, {0, 0, 0}); // refuses lists that have no tables
}

void validate_bricks(const Scene& scene) {
  const RenderSettings& render = scene.render;
  const bool bricked = render.levels > 1 || render.tiles != std::array<std::size_t, 3>{1, 1, 1};
  if (bricked && render.classification == Classification::pre) {
    throw UsageError(
        "render.classification 'pre' holds the volume in one texture of colours; set render.tiles to "
        "[1,1,1] and render.levels to 1, or render.classification to post");
  }
  if (render.brick < min_brick || render.brick > max_brick || render.brick % 8 != 0)
    throw UsageError("render.brick must be from " + std::to_string(min_brick) + " to " +
                     std::to_string(max_brick) + " in steps of 8, not " + std::to_string(render.brick));
  if (render.memory && *render.memory > max_memory)
    throw UsageError("render.memory is in MiB; take at most " + std::to_string(max_memory));
  const auto& tiles = render.tiles;
  for (const std::size_t n : tiles) {
    if (n < 1 || n > max_tiles)
      throw UsageError("render.tiles: every axis takes from 1 to " + std::to_string(max_tiles) + " tiles");
  }
  const std::size_t count = tiles[0] * tiles[1] * tiles[2];
  if (count > max_tiles) {
    throw UsageError("render.tiles asks for " + std::to_string(count) + " textures; take at most " +
                     std::to_string(max_tiles));
  }
  if (count > 1 && render.pipeline != Pipeline::slices && render.pipeline != Pipeline::tessellated &&
      render.pipeline != Pipeline::reference) {
    throw UsageError("pipeline '" + word(render.pipeline) +
                     "' looks anywhere in the volume from each fragment and cannot hold it in tiles; use "
                     "slices or tessellated, or render.tiles [1,1,1]");
  }
  if (render.levels < 1 || render.levels > max_levels) {
    throw UsageError("render.levels must be from 1 to " + std::to_string(max_levels) + ", not " +
                     std::to_string(render.levels));
  }
  if (render.levels == 1 || scene.warp.empty() || render.footprint == Footprint::mip)
    return;
  if (render.pipeline == Pipeline::grid) {
    throw UsageError("render.levels follow the zoom of a lens, which pipeline 'grid' does not hold; set "
                     "render.levels to 1");
  }
  double zoom = 0;
  for (const Warp& warp : scene.warp) {
    const auto* lens = std::get_if<LamarLens>(&warp);
    if (lens == nullptr) {
      throw UsageError("render.levels follow the zoom of a lens 'lamar', and warp '" + kind_of(warp) +
                       "' has none; set render.levels to 1");
    }
    zoom = std::max(zoom, lens->zoom);
    if (render.pipeline == Pipeline::tessellated && !lens->homogeneous) {
      throw UsageError("render.levels follow the homogeneous weights; set warp.homogeneous to true or "
                       "render.levels to 1");
    }
  }
  if (zoom <= 1) {
    throw UsageError("render.levels need a lens that magnifies, and the largest warp.zoom is " +
                     number_text(zoom) + "; raise it above 1 or set render.levels to 1");
  }
}

/// Where several resolutions of the whole volume cannot be read.
void validate_footprint(const Scene& scene) {
  const RenderSettings& render = scene.render;
  if (render.footprint == Footprint::point)
    return;
  const auto refuse = [](const std::string& problem, const std::string& instead) {
    throw UsageError("render.footprint 'mip' reads several resolutions of the volume's values, " + problem +
                     "; set render.footprint to point or " + instead);
  };
  if (render.pipeline == Pipeline::fixed_function)
    refuse("which pipeline 'fixed-function' cannot choose from", "take another pipeline");
  if (render.classification == Classification::pre)
    refuse("and classification 'pre' holds colours", "render.classification to post");
  if (render.tiles != std::array<std::size_t, 3>{1, 1, 1})
    refuse("which tiles do not hold", "render.tiles to [1,1,1]");
  if (!scene.planes.empty())
    refuse("and planes show single values", "remove planes");
  if (render.shading != Shading::none &&
      (render.gradient == Gradient::prefiltered || render.gradient == Gradient::precomputed)) {
    refuse("and the texture of gradient '" + word(render.gradient) + "' has one",
           "render.gradient to central or forward");
  }
}

} // namespace slicelens
