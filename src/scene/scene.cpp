#include "scene/scene.h"

#include "core/errors.h"
#include "core/text.h"
#include "scene/names.h"
#include "warp/axis_tables.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace slicelens {

namespace {

void validate_volume(const VolumeSettings& volume) {
  if (volume.file && volume.phantom)
    throw UsageError("volume.file and volume.phantom are both given; keep one");
  if (volume.file && volume.file->empty())
    throw UsageError("volume.file is empty; name a file or folder");
  if (volume.size) {
    for (const std::size_t n : *volume.size) {
      if (n == 0)
        throw UsageError("volume.size: every axis needs at least 1 voxel");
    }
  }
  if (volume.phantom && (volume.type || volume.spacing || volume.big_endian)) {
    throw UsageError(
        "volume.type, volume.spacing and volume.endian describe raw files; a phantom takes only size");
  }
}

void validate_camera(const CameraSettings& camera) {
  if (camera.position && (camera.azimuth != 0 || camera.elevation != 0 || camera.roll != 0)) {
    throw UsageError(
        "camera.position excludes azimuth, elevation and roll, which turn the default camera; keep one form");
  }
  if (camera.view_angle / camera.zoom >= 180 || camera.view_angle >= 180) {
    throw UsageError("camera.view_angle divided by zoom must stay below 180 degrees");
  }
  if (camera.view_up && glm::length(*camera.view_up) == 0)
    throw UsageError("camera.view_up is the zero vector; give a direction");
}

void validate_transfer(const TransferSettings& transfer) {
  const auto refuse = [](const char* a, const char* b) {
    throw UsageError(std::string("transfer.") + a + " and transfer." + b + " are both given; keep one");
  };
  if (transfer.preset && transfer.points)
    refuse("preset", "points");
  if (transfer.preset && transfer.file)
    refuse("preset", "file");
  if (transfer.points && transfer.file)
    refuse("points", "file");
  if (transfer.file && transfer.file->empty())
    throw UsageError("transfer.file is empty; name a file");
  if ((transfer.map || transfer.range) && !transfer.file)
    throw UsageError("transfer.map and transfer.range belong to transfer.file, which is not given");
  if (transfer.range && !(transfer.range->x < transfer.range->y))
    throw UsageError("transfer.range must be [first, last] with first below last");
}

void validate_camera_file(const CameraSettings& camera) {
  const CameraSettings usual;
  if (camera.file->empty())
    throw UsageError("camera.file is empty; name a file");
  if (camera.position || camera.focal_point || camera.view_up || camera.parallel_scale ||
      camera.azimuth != 0 || camera.elevation != 0 || camera.roll != 0 ||
      camera.projection != usual.projection || camera.view_angle != usual.view_angle)
    throw UsageError("camera.file holds a whole camera; of the other keys only camera.zoom goes with it");
}

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

/// Whether the warp is LaMar's or Cohen's, whose gradients are the data's own, carried by the Jacobian.
bool carries_gradients(const Warp& warp) {
  return std::holds_alternative<LamarLens>(warp) || std::holds_alternative<Bifocal>(warp) ||
         std::holds_alternative<Fisheye>(warp) || std::holds_alternative<VolumeLens>(warp) ||
         std::holds_alternative<ConnectedLens>(warp);
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

/// The table of labels, whether the mode uses it or not.
void validate_label_table(const Scene& scene) {
  if (scene.volume.labels && scene.volume.labels->empty())
    throw UsageError("volume.labels is empty; name a file or a phantom");
  if (!scene.labels.empty() && !scene.volume.labels)
    throw UsageError("labels are those of volume.labels, which is not given; name a file or a phantom there");
  if (scene.labels.size() > max_labels) {
    throw UsageError("labels has " + std::to_string(scene.labels.size()) + " entries; take at most " +
                     std::to_string(max_labels) +
                     ", all other labels are shown as the scene's own transfer "
                     "function says");
  }
  std::set<std::size_t> seen;
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    const LabelSettings& label = scene.labels[i];
    const std::string at = "labels[" + std::to_string(i) + "]";
    if (!seen.insert(label.label).second)
      throw UsageError(at + ".label: " + std::to_string(label.label) + " has an entry already; keep one");
    if (!label.transfer)
      continue;
    if (!label.transfer->shapes.empty())
      throw UsageError(at + ".transfer.shapes: labels are classified by value; give points or a preset");
    try {
      validate_transfer(*label.transfer);
    } catch (const UsageError& error) {
      throw UsageError(at + "." + error.what());
    }
  }
}

/// Mode `two-level`: where a sample finds its label and what its run can become.
void validate_labels(const Scene& scene) {
  validate_label_table(scene);
  const RenderSettings& render = scene.render;
  if (render.mode != Mode::two_level)
    return;
  const auto refuse = [](const std::string& problem, const std::string& instead) {
    throw UsageError("mode 'two-level' " + problem + "; set " + instead);
  };
  if (!scene.volume.labels)
    refuse("tells objects apart by a label volume, which is not given", "volume.labels");
  if (render.classification == Classification::pre) {
    refuse("classifies each sample by its label, which classification 'pre' has lost",
           "render.classification to post");
  }
  if (render.tiles != std::array<std::size_t, 3>{1, 1, 1} || render.levels != 1)
    refuse("holds labels in one texture at full resolution",
           "render.tiles to [1,1,1] and render.levels to 1");
  if (render.footprint == Footprint::mip)
    refuse("has labels at one resolution, and means of several objects have none",
           "render.footprint to point");
  if (scene.overlay.legend)
    refuse("has a transfer function for each label, and overlay.legend shows one", "overlay.legend to false");
  for (const LabelSettings& label : scene.labels) {
    if (label.visible && label.mode != LabelMode::dvr && draws_slices(render.pipeline)) {
      refuse("shows label " + std::to_string(label.label) + " by '" + word(label.mode) +
                 "', which needs a ray's whole run through it: slices are blended one by one",
             "render.pipeline to rays or reference, or its mode to dvr");
    }
  }
}

/// Smallest side of a picture that has room for lettering, in pixels.
constexpr std::size_t smallest_annotated = 64;

void validate_annotations(const Scene& scene) {
  const auto& size = scene.render.size;
  const std::size_t legends = smallest_annotated * volume_count(scene);
  if (scene.overlay.legend && std::min(size[0], size[1]) < legends) {
    throw UsageError("overlay.legend of " + std::to_string(volume_count(scene)) +
                     " volume(s) needs a picture of at least " + std::to_string(legends) +
                     " pixels on each side; raise render.size");
  }
  if (is_annotated(scene.overlay) && std::min(size[0], size[1]) < smallest_annotated) {
    throw UsageError("overlay.scale_bar and labels need a picture of at least " +
                     std::to_string(smallest_annotated) + " pixels on each side; raise render.size");
  }
  if (scene.overlay.legend && scene.render.mode == Mode::xray) {
    throw UsageError("overlay.legend shows the transfer function's colours, which mode 'xray' does not; set "
                     "it to false");
  }
}

/// What several volumes on one stack of slices can do.
void validate_several(const Scene& scene) {
  const RenderSettings& render = scene.render;
  const auto refuse = [](const std::string& problem) { throw UsageError("several volumes " + problem); };
  const std::string pipeline = word(render.pipeline);
  if (render.pipeline == Pipeline::tessellated || render.pipeline == Pipeline::axis ||
      render.pipeline == Pipeline::fixed_function) {
    refuse("share one stack of slices, which cannot follow the map of each: pipeline '" + pipeline +
           "' draws one volume; set render.pipeline to slices, fragment, grid, rays or reference");
  }
  if (render.classification == Classification::pre)
    refuse("are combined after classification; set render.classification to post");
  if (render.classification == Classification::preintegrated)
    refuse("have no one pair of values for a segment; set render.classification to post");
  if (render.tiles != std::array<std::size_t, 3>{1, 1, 1} || render.levels != 1)
    refuse("are held in one texture each; set render.tiles to [1,1,1] and render.levels to 1");
  if (render.footprint == Footprint::mip)
    refuse("are held at one resolution each; set render.footprint to point");
  if (!scene.planes.empty())
    refuse("have no one value for a cutting plane to show; remove planes, or show one volume");
  if (scene.overlay.stack != 0)
    refuse("have no overlay.stack; set it to 0");
  if (render.mode == Mode::two_level || !scene.labels.empty())
    refuse("have no labels in common; set render.mode to another than two-level and remove labels");
  if (render.mode == Mode::average || render.mode == Mode::iso)
    refuse("have no one value to show under mode '" + word(render.mode) + "'; set render.mode to another");
  if (has_effects(scene) && classifies_last(render.mode))
    refuse("under mode '" + word(render.mode) +
           "' have a winner each, which highlight and attenuation cannot follow; set "
           "render.mode to dvr or xray");
}

/// A transfer function of value and gradient.
void validate_shapes(const Scene& scene) {
  const TransferSettings& transfer = scene.transfer;
  if (transfer.shapes.empty())
    return;
  if (transfer.preset || transfer.points || transfer.file)
    throw UsageError("transfer.shapes excludes preset, points and file; keep one");
  if (transfer.shapes.size() > 256)
    throw UsageError("transfer.shapes: give at most 256");
  validate(transfer.shapes);
  const RenderSettings& render = scene.render;
  if (render.mode == Mode::two_level) {
    throw UsageError("mode 'two-level' classifies values, and transfer.shapes gradients too; give "
                     "transfer.points for transfer.shapes");
  }
  if (render.mode != Mode::dvr && render.mode != Mode::xray) {
    throw UsageError("transfer.shapes need a gradient, which mode '" + word(render.mode) +
                     "' does not have; set render.mode to dvr or xray");
  }
  if (render.classification == Classification::pre) {
    throw UsageError(
        "render.classification 'pre' classifies voxels, which have no gradient yet; set it to post, "
        "or give transfer.points for transfer.shapes");
  }
  if (render.modulate_by_gradient)
    throw UsageError("transfer.shapes follow the gradient themselves; remove render.modulate_by_gradient");
  if (transfer.window || transfer.level) {
    throw UsageError(
        "transfer.window and transfer.level stretch a function of values only; remove them, or give "
        "transfer.points for transfer.shapes");
  }
  if (scene.overlay.legend) {
    throw UsageError(
        "overlay.legend shows a function of values only; set it to false, or give transfer.points "
        "for transfer.shapes");
  }
}

void validate_placement(const Placement& placement) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(placement.scale[axis] >= 1e-6 && placement.scale[axis] <= 1e6))
      throw UsageError("placement.scale must be from 1e-6 to 1e6, not " + number_text(placement.scale[axis]));
    if (!(std::abs(placement.rotate[axis]) <= 1e6))
      throw UsageError("placement.rotate must be within a million degrees");
  }
}

} // namespace

bool is_annotated(const OverlaySettings& overlay) {
  return overlay.legend || overlay.scale_bar || overlay.labels;
}

Scene scene_of_volume(const Scene& scene, std::size_t index) {
  Scene one = scene;
  one.others.clear();
  one.combine = Combine::mix;
  if (index == 0)
    return one;
  const VolumeLayer& layer = scene.others[index - 1];
  one.volume = layer.volume;
  one.transfer = layer.transfer;
  one.warp = layer.warp;
  one.placement = layer.placement;
  one.highlight = {};
  one.attenuation = {};
  return one;
}

GradientSpace gradient_space_of(const Scene& scene) {
  if (scene.warp.empty() || scene.render.gradient == Gradient::precomputed)
    return GradientSpace::data;
  return scene.render.gradient_space.value_or(carries_gradients(scene.warp[0]) ? GradientSpace::data
                                                                               : GradientSpace::object);
}

bool draws_slices(Pipeline pipeline) {
  return pipeline == Pipeline::slices || pipeline == Pipeline::tessellated || pipeline == Pipeline::axis ||
         pipeline == Pipeline::fragment || pipeline == Pipeline::grid || pipeline == Pipeline::fixed_function;
}

bool has_effects(const Scene& scene) {
  return scene.highlight.function != HighlightFunction::off ||
         scene.attenuation.function != AttenuationFunction::off;
}

Pipeline default_pipeline(const Scene& scene) {
  if (!scene.others.empty()) {
    const bool plain = scene.warp.empty() && !has_effects(scene) &&
                       std::all_of(scene.others.begin(), scene.others.end(),
                                   [](const VolumeLayer& layer) { return layer.warp.empty(); });
    return plain ? Pipeline::slices : Pipeline::fragment;
  }
  if (scene.warp.empty())
    return has_effects(scene) ? Pipeline::axis : Pipeline::slices;
  const std::string& own = info_of(scene.warp[0]).pipelines[0];
  for (const auto& [pipeline, name] : names_of(Pipeline{})) {
    if (own == name)
      return pipeline;
  }
  return Pipeline::fragment;
}

void use_pipeline_defaults(RenderSettings& render, bool classification_given, bool target_given,
                           bool correction_given) {
  if (render.pipeline != Pipeline::fixed_function)
    return;
  if (!classification_given)
    render.classification = Classification::pre;
  if (!target_given)
    render.target = Target::rgba8;
  if (!correction_given)
    render.opacity_correction = OpacityCorrection::frame;
}

void validate(const OverlaySettings& overlay) {
  if (overlay.lattice > 1024) {
    throw UsageError("overlay.lattice must be at most 1024 cells, not " + std::to_string(overlay.lattice));
  }
  if (overlay.line_width > 100)
    throw UsageError("overlay.line_width must be at most 100 pixels");
  if (!(std::abs(overlay.stack) <= 90))
    throw UsageError("overlay.stack must be from -90 to 90 degrees, not " + number_text(overlay.stack));
  if (overlay.landmarks > 1000) {
    throw UsageError("overlay.landmarks must be a radius of at most 1000 pixels, not " +
                     number_text(overlay.landmarks));
  }
  if (overlay.stack != 0 && is_annotated(overlay)) {
    throw UsageError("overlay.stack shows the slices from the side, where legend, scale_bar and labels would "
                     "be wrong; set them to false, or overlay.stack to 0");
  }
  if (overlay.unit && overlay.unit->size() > max_unit_letters) {
    throw UsageError("overlay.unit '" + *overlay.unit + "' is too long; give at most " +
                     std::to_string(max_unit_letters) + " letters");
  }
}

void validate(const Scene& scene) {
  if (!scene.others.empty()) {
    if (volume_count(scene) > max_volumes)
      throw UsageError("volumes: at most " + std::to_string(max_volumes) + " can be shown at once");
    validate_several(scene);
    validate_annotations(scene);
    for (std::size_t i = 0; i < volume_count(scene); ++i) {
      try {
        validate(scene_of_volume(scene, i));
      } catch (const UsageError& error) {
        throw UsageError("volumes[" + std::to_string(i) + "]: " + error.what());
      }
    }
    return;
  }
  validate_placement(scene.placement);
  validate_shapes(scene);
  validate_volume(scene.volume);
  validate_transfer(scene.transfer);
  if (scene.camera.file)
    validate_camera_file(scene.camera);
  validate_camera(scene.camera);
  if (scene.render.pipeline == Pipeline::fixed_function)
    validate_fixed_function(scene.render);
  validate_render(scene.render);
  if (scene.render.classification == Classification::pre)
    validate_pre_classification(scene.render, scene.camera);
  if (scene.render.classification == Classification::preintegrated)
    validate_preintegrated(scene);
  if (scene.light.direction && glm::length(*scene.light.direction) == 0) {
    throw UsageError("light.direction is the zero vector; give a direction");
  }
  validate(scene.overlay);
  validate_annotations(scene);
  validate_shells(scene);
  validate_warps(scene);
  validate_effects(scene);
  validate_bricks(scene);
  validate_footprint(scene);
  validate_planes(scene);
  validate_labels(scene);
  validate_gradients(scene);
  if (scene.crop) {
    for (int axis = 0; axis < 3; ++axis) {
      if (!(scene.crop->low[axis] < scene.crop->high[axis]))
        throw UsageError("crop.low must be below crop.high on every axis");
    }
  }
  for (const ClipSettings& plane : scene.clip) {
    if (glm::length(plane.normal) == 0)
      throw UsageError("clip: a plane's normal is the zero vector; give a direction");
  }
}

} // namespace slicelens
