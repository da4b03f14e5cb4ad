#include "core/errors.h"
#include "core/text.h"
#include "scene/names.h"
#include "scene/rules.h"
#include "warp/axis_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace slicelens {

void validate_render(const RenderSettings& render) {
  for (const std::size_t n : render.size) {
    if (n < 1 || n > 32768)
      throw UsageError("render.size: width and height must be from 1 to 32768 pixels");
  }
  if (render.early_termination <= 0)
    throw UsageError("render.early_termination must be above 0 and at most 1");
  if (render.early_termination < 1 && draws_slices(render.pipeline)) {
    throw UsageError("render.early_termination belongs to rays and reference; slices cannot stop early");
  }
  if (render.order == Order::front_to_back && !draws_slices(render.pipeline)) {
    throw UsageError("render.order front-to-back is for slices; rays always go front to back");
  }
  if ((render.mode == Mode::xray || render.mode == Mode::average) && render.target == Target::rgba8 &&
      draws_slices(render.pipeline)) {
    throw UsageError("mode '" + word(render.mode) +
                     "' sums contributions far below 1/255, which target 'rgba8' rounds to "
                     "nothing; use rgba16f or rgba32f");
  }
  if (render.mode == Mode::iso && (render.levels > 1 || render.footprint == Footprint::mip ||
                                   render.tiles != std::array<std::size_t, 3>{1, 1, 1})) {
    throw UsageError(
        "mode 'iso' follows one value at full resolution in one texture; set render.tiles to [1,1,1], "
        "render.levels to 1 and render.footprint to point");
  }
  if (render.jitter > 0 && render.tiles != std::array<std::size_t, 3>{1, 1, 1})
    throw UsageError("render.jitter moves samples out of their tile; set render.tiles to [1,1,1]");
  if (render.isovalue && render.mode != Mode::iso)
    throw UsageError("render.isovalue is for mode 'iso'; set render.mode to iso or remove it");
  if (render.modulate_by_gradient && !composites(render.mode) && render.mode != Mode::xray) {
    throw UsageError("render.modulate_by_gradient changes opacities, which mode '" + word(render.mode) +
                     "' does not sum; set render.mode to dvr or xray, or remove it");
  }
  const bool meshed = render.pipeline == Pipeline::tessellated || render.pipeline == Pipeline::fixed_function;
  if (meshed && (render.mode == Mode::iso || render.jitter > 0)) {
    throw UsageError(std::string(render.mode == Mode::iso ? "mode 'iso'" : "render.jitter") +
                     " looks off the slice, where pipeline '" + word(render.pipeline) +
                     "' has no coordinates; take slices, fragment, rays or reference");
  }
  if (render.jitter_seed > 0x7fffffff)
    throw UsageError("render.jitter_seed must be at most 2147483647");
  if (render.mode == Mode::xray && render.shading != Shading::none) {
    throw UsageError("mode 'xray' shows opacity, which has no shading; set render.shading to none");
  }
  if (classifies_last(render.mode) && render.shading != Shading::none) {
    throw UsageError("mode '" + word(render.mode) +
                     "' classifies one value, which has no gradient; set render.shading to none");
  }
}

/// Voxels that are classified once cannot be corrected, lit or compared later (docs/pipeline.md).
void validate_pre_classification(const RenderSettings& render, const CameraSettings& camera) {
  if (classifies_last(render.mode) || render.mode == Mode::iso) {
    throw UsageError("render.classification 'pre' holds colours, in which mode '" + word(render.mode) +
                     "' finds no value; set render.classification to post");
  }
  if (render.shading != Shading::none) {
    throw UsageError("render.classification 'pre' holds colours, which have no gradient to shade with; set "
                     "render.shading to none or render.classification to post");
  }
  if (render.opacity_correction == OpacityCorrection::fragment && draws_slices(render.pipeline) &&
      camera.projection == ProjectionName::perspective) {
    throw UsageError("render.classification 'pre' bakes one opacity correction into the texture, so under "
                     "camera.projection perspective render.opacity_correction cannot be fragment; set it to "
                     "frame or none");
  }
  if (render.volume_texture != VolumeTexture::automatic) {
    throw UsageError("render.volume_texture is for classification 'post'; 'pre' holds the volume as 8-bit "
                     "colours: remove the key or set it to auto");
  }
  if (render.transfer_texture != TransferTexture::rgba32f) {
    throw UsageError("render.transfer_texture is for classification 'post'; 'pre' applies the transfer "
                     "function without a texture: remove the key or set it to rgba32f");
  }
}

/// Segments need both their ends, of one volume at one resolution.
void validate_preintegrated(const Scene& scene) {
  const RenderSettings& render = scene.render;
  const auto refuse = [](const std::string& problem, const std::string& remedy) {
    throw UsageError("render.classification 'preintegrated' " + problem +
                     "; set render.classification to post or " + remedy);
  };
  if (render.mode == Mode::two_level)
    refuse("has a table of one transfer function, and mode 'two-level' one for each label",
           "render.mode to dvr");
  if (render.mode != Mode::dvr)
    refuse("holds what segments emit and absorb, of which mode '" + word(render.mode) + "' needs neither",
           "render.mode to dvr");
  if (render.pipeline == Pipeline::tessellated)
    refuse("looks in front of each slice and behind it, where the triangles of pipeline 'tessellated' hold "
           "nothing",
           "render.pipeline to fragment, axis, grid, rays or reference");
  if (render.tiles != std::array<std::size_t, 3>{1, 1, 1})
    refuse("looks beyond the tile of a fragment", "render.tiles to [1,1,1]");
  if (render.footprint == Footprint::mip)
    refuse("classifies values of one resolution", "render.footprint to point");
  if (render.levels != 1)
    refuse("classifies values of one resolution", "render.levels to 1");
  if (render.jitter > 0)
    refuse("leaves no gaps between segments for render.jitter to hide", "render.jitter to 0");
  if (render.modulate_by_gradient || !scene.transfer.shapes.empty())
    refuse("classifies pairs of values, without the gradient between them",
           "remove render.modulate_by_gradient and transfer.shapes");
  if (render.transfer_texture != TransferTexture::rgba32f)
    refuse("has a table of floats of its own", "render.transfer_texture to rgba32f");
}

/// What hardware without shaders could do (LaMar 2001).
void validate_fixed_function(const RenderSettings& render) {
  const auto refuse = [](const std::string& problem, const std::string& key, const std::string& value) {
    throw UsageError("pipeline 'fixed-function' " + problem + "; set " + key + " to " + value);
  };
  if (render.classification != Classification::pre)
    refuse("cannot classify samples, it needs colours in the texture", "render.classification", "pre");
  if (render.mode != Mode::dvr)
    refuse("draws mode 'dvr' only", "render.mode", "dvr");
  if (render.shading != Shading::none)
    refuse("has colours in its texture and nothing to shade with", "render.shading", "none");
  if (render.target != Target::rgba8)
    refuse("blends into the papers' 8 bits", "render.target", "rgba8");
  if (render.filter == Filter::linear_exact || render.filter == Filter::cubic) {
    refuse("has no filter '" + word(render.filter) + "', which is a shader's", "render.filter",
           "linear or nearest");
  }
}

/// Slices as shells about the eye: every fragment finds its own sample, on its ray.
void validate_shells(const Scene& scene) {
  const RenderSettings& render = scene.render;
  if (render.proxy == Proxy::planes)
    return;
  const auto refuse = [](const std::string& problem) {
    throw UsageError("render.proxy 'shells' " + problem);
  };
  const std::string pipeline = "pipeline '" + word(render.pipeline) + "' ";
  if (!draws_slices(render.pipeline))
    refuse("is about slices; " + pipeline + "samples shells by itself: set render.proxy to planes");
  if (render.pipeline == Pipeline::tessellated || render.pipeline == Pipeline::fixed_function)
    refuse("finds each sample at its fragment, and " + pipeline +
           "looks where the corners of planes say; use slices, axis, fragment or grid");
  if (scene.camera.projection == ProjectionName::orthographic)
    refuse(
        "are spheres about the eye, which camera.projection orthographic does not have: its planes are its "
        "shells; set camera.projection to perspective or render.proxy to planes");
  if (render.classification == Classification::pre)
    refuse("looks the value up at each fragment; set render.classification to post");
  if (render.tiles != std::array<std::size_t, 3>{1, 1, 1})
    refuse("crosses tiles at each fragment, and triangles would have to be cut there; set render.tiles to "
           "[1,1,1]");
  if (render.mode == Mode::iso || render.jitter > 0)
    refuse(
        "are not moved along their rays, as mode 'iso' and render.jitter ask for; set render.proxy to planes "
        "or take pipeline rays");
  if (!scene.planes.empty())
    refuse("has no depth of a polygon for planes to stop; remove planes or set render.proxy to planes");
  if (scene.overlay.stack != 0)
    refuse("has no flat slices for overlay.stack to show; set it to 0 or render.proxy to planes");
}

void validate_gradients(const Scene& scene) {
  const RenderSettings& render = scene.render;
  if (render.modulate_by_gradient && render.classification == Classification::pre) {
    throw UsageError("render.classification 'pre' holds colours, which have no gradient to modulate by; set "
                     "render.classification to post or remove render.modulate_by_gradient");
  }
  if (render.gradient_sigma < 0.3 || render.gradient_sigma > 8) {
    throw UsageError("render.gradient_sigma must be from 0.3 to 8 voxels of the copy, not " +
                     number_text(render.gradient_sigma));
  }
  if (render.gradient_texture != GradientFormat::rgb16f && render.gradient != Gradient::precomputed) {
    throw UsageError("render.gradient_texture '" + word(render.gradient_texture) +
                     "' holds the gradients of render.gradient 'precomputed', which is '" +
                     word(render.gradient) + "'; set render.gradient to precomputed");
  }
  if (!uses_gradients(scene))
    return;
  const bool own_texture =
      render.gradient == Gradient::prefiltered || render.gradient == Gradient::precomputed;
  if (render.gradient == Gradient::precomputed && render.gradient_space == GradientSpace::object) {
    throw UsageError("render.gradient 'precomputed' holds gradients of the data, which only the Jacobian "
                     "carries to what is shown; set render.gradient_space to data, or render.gradient to "
                     "central, forward or prefiltered");
  }
  const bool bricked = (render.levels > 1 && render.footprint == Footprint::point) ||
                       render.tiles != std::array<std::size_t, 3>{1, 1, 1};
  if (bricked && own_texture) {
    throw UsageError("render.gradient '" + word(render.gradient) +
                     "' needs a second texture of the whole volume, which render.tiles and render.levels do "
                     "not make; set render.gradient to central or forward, or render.tiles to [1,1,1] and "
                     "render.levels to 1");
  }
  if (bricked && gradient_space_of(scene) == GradientSpace::object) {
    throw UsageError("render.gradient_space 'object' may look anywhere in the volume, which render.tiles and "
                     "render.levels do not hold in one texture; set render.gradient_space to data, or "
                     "render.tiles to [1,1,1] and render.levels to 1");
  }
}

void validate_planes(const Scene& scene) {
  for (const PlaneSettings& plane : scene.planes) {
    if (glm::length(plane.normal) == 0)
      throw UsageError("planes: a plane's normal is the zero vector; give a direction");
    if (plane.range && !(plane.range->x < plane.range->y))
      throw UsageError("planes: range must be [black, white] with black below white");
  }
  if (scene.planes.empty())
    return;
  const RenderSettings& render = scene.render;
  const auto refuse = [](const std::string& problem) {
    throw UsageError("planes are opaque polygons that show single values; " + problem);
  };
  if (scene.planes.size() > max_planes_shown)
    refuse("give at most " + std::to_string(max_planes_shown));
  if (render.mode != Mode::dvr)
    refuse("set render.mode to dvr");
  if (render.classification == Classification::pre || render.pipeline == Pipeline::fixed_function)
    refuse("set render.classification to post and take another pipeline than fixed-function");
  if (render.tiles != std::array<std::size_t, 3>{1, 1, 1} || render.levels != 1)
    refuse("set render.tiles to [1,1,1] and render.levels to 1");
}

namespace {

/// What slices cannot show where a fragment finds its samples itself (render/slabs.h).
void validate_slabs(const Scene& scene, const std::function<void(const std::string&)>& refuse) {
  const RenderSettings& render = scene.render;
  if (render.pipeline == Pipeline::tessellated || render.pipeline == Pipeline::fixed_function)
    refuse("finds samples at the fragment, and pipeline '" + word(render.pipeline) +
           "' looks where the corners of triangles say; use slices, axis, fragment or grid");
  if (render.mode == Mode::iso)
    refuse("composites samples, and mode 'iso' is drawn slice by slice; use pipeline rays");
  const auto is_whole = [](const LabelSettings& label) {
    return label.visible && label.mode != LabelMode::dvr;
  };
  if (render.mode == Mode::two_level && std::any_of(scene.labels.begin(), scene.labels.end(), is_whole))
    refuse("composites samples, and objects that are shown as a whole (mip, xray) are drawn slice by slice; "
           "use pipeline rays, or mode dvr for all labels");
  if (render.proxy == Proxy::shells)
    refuse("knows planes only; set render.proxy to planes");
  if (render.tiles != std::array<std::size_t, 3>{1, 1, 1})
    refuse("crosses tiles at each fragment; set render.tiles to [1,1,1]");
  if (!scene.planes.empty())
    refuse("has no depth of a polygon for planes to stop; remove planes or use pipeline rays");
}

} // namespace

/// Several slices sampled by one fragment, each where the fragment's own ray meets it.
void validate_planes_per_pass(const Scene& scene) {
  const RenderSettings& render = scene.render;
  if (render.planes_per_pass < 1 || render.planes_per_pass > max_planes_per_pass) {
    throw UsageError("render.planes_per_pass must be from 1 to " + std::to_string(max_planes_per_pass) +
                     ", not " + std::to_string(render.planes_per_pass));
  }
  if (render.planes_per_pass == 1)
    return;
  const auto refuse = [](const std::string& problem) {
    throw UsageError("render.planes_per_pass above 1 " + problem);
  };
  if (!draws_slices(render.pipeline))
    refuse("is about slices, and pipeline '" + word(render.pipeline) + "' has none; set it to 1");
  validate_slabs(scene, refuse);
}

/// Samples left out. Empty cells are known by their values' range, hidden ones from the front.
void validate_skip(const Scene& scene) {
  const RenderSettings& render = scene.render;
  if (render.skip == Skip::none)
    return;
  const std::string key = "render.skip '" + word(render.skip) + "' ";
  const auto refuse = [&](const std::string& problem) { throw UsageError(key + problem); };
  const std::string off = "; set render.skip to none";
  if (render.pipeline == Pipeline::reference)
    refuse("is for slices and rays, the reference samples everything" + off);
  if (!scene.others.empty())
    refuse("knows the empty cells of one volume; show one or" + off.substr(1));
  if (render.mode == Mode::average)
    refuse("leaves out samples that show nothing, which mode 'average' counts; set render.skip to none");
  if (render.levels != 1 || render.footprint == Footprint::mip ||
      render.tiles != std::array<std::size_t, 3>{1, 1, 1})
    refuse(
        "knows the cells of one texture at full resolution; set render.tiles to [1,1,1], render.levels to 1 "
        "and render.footprint to point, or render.skip to none");
  if (render.skip == Skip::empty_and_hidden && !composites(render.mode))
    refuse("is for modes dvr and two-level: nothing is hidden under mode '" + word(render.mode) +
           "'; set render.skip to empty");
  if (!draws_slices(render.pipeline))
    return;
  validate_slabs(scene, refuse);
  if (render.skip == Skip::empty_and_hidden && render.order != Order::front_to_back)
    refuse("sees from the front what is hidden; set render.order to front-to-back, or render.skip to empty");
}

} // namespace slicelens
