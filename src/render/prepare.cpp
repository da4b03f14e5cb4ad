#include "render/prepare.h"

#include "core/errors.h"
#include "render/bricks.h"
#include "render/pages.h"
#include "render/prepare_data.h"
#include "scene/camera.h"
#include "scene/names.h"
#include "warp/object_bounds.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace slicelens {

namespace {

PreparedScene unprepared(Scene scene, Volume volume, TransferFunction transfer) {
  PreparedScene prepared;
  prepared.scene = std::move(scene);
  prepared.transfer = std::move(transfer);
  set_volume(prepared, std::move(volume));
  return prepared;
}

} // namespace

void set_volume(PreparedScene& prepared, Volume volume) {
  if (volume.components != 1)
    throw UsageError("a volume of several components cannot be drawn; choose volume.component");
  prepared.volume = std::move(volume);
  prepared.file_geometry = {prepared.volume.spacing, prepared.volume.origin, prepared.volume.direction};
  prepared.pyramid.clear();
  prepared.cells.reset();
  prepared.small_cells.reset();
}

PreparedScene prepare(Scene scene, Volume volume, TransferFunction transfer, std::vector<LoadedVolume> others,
                      std::optional<LoadedLabels> labels) {
  if (others.size() != scene.others.size())
    throw UsageError("the scene has " + std::to_string(volume_count(scene)) + " volumes, the data " +
                     std::to_string(1 + others.size()));
  PreparedScene prepared = unprepared(std::move(scene), std::move(volume), std::move(transfer));
  prepared.labels.loaded = std::move(labels);
  for (std::size_t i = 0; i < others.size(); ++i) {
    prepared.others.push_back(unprepared(scene_of_volume(prepared.scene, i + 1), std::move(others[i].volume),
                                         std::move(others[i].transfer)));
  }
  prepare_again(prepared);
  return prepared;
}

namespace {

/// Pixels in one unit of box space at a lens centre.
double pixels_per_unit(const PreparedScene& prepared, const LamarLens& lens) {
  const View& view = prepared.view;
  const double pixels_per_world = 0.5 * view.height / view.half_height;
  if (view.projection == Projection::orthographic)
    return pixels_per_world * prepared.space.longest;
  const double distance = depth(view, world_from_texture(prepared.box, lens.center));
  return pixels_per_world * prepared.space.longest / std::max(distance, 1e-9 * prepared.space.longest);
}

/// The warp as one that is held in a grid, or nothing.
std::optional<std::variant<Landmarks, Field>> gridded(const Warp& warp) {
  if (const auto* landmarks = std::get_if<Landmarks>(&warp))
    return *landmarks;
  if (const auto* field = std::get_if<Field>(&warp))
    return *field;
  return std::nullopt;
}

/// map_of, or what it gave before for the same landmarks or field: found in `before` and kept in
/// prepared.held.
WarpMap map_once(PreparedScene& prepared, const Warp& warp, const std::vector<HeldWarp>& before) {
  const auto own = gridded(warp);
  if (!own)
    return map_of(warp, prepared.space, prepared.warp_view);
  for (const HeldWarp& held : before) {
    if (held.warp == *own && held.space == prepared.space) {
      prepared.held.push_back(held);
      return held.map;
    }
  }
  const auto map = std::get<GridMap>(map_of(warp, prepared.space, prepared.warp_view));
  prepared.held.push_back({*own, prepared.space, map});
  return map;
}

void prepare_warps(PreparedScene& prepared) {
  prepared.space = box_space(prepared.box);
  prepared.warp_view = warp_view(prepared.view, prepared.box);
  const glm::dmat3& axes = prepared.volume.direction;
  const bool sheared = std::abs(glm::dot(axes[0], axes[1])) > 1e-3 ||
                       std::abs(glm::dot(axes[1], axes[2])) > 1e-3 ||
                       std::abs(glm::dot(axes[2], axes[0])) > 1e-3;
  if (sheared && !prepared.scene.warp.empty()) {
    throw UsageError(
        "warp '" + kind_of(prepared.scene.warp[0]) +
        "' needs a volume with axes at right angles; this one is sheared (a tilted gantry, for instance)");
  }
  const std::vector<HeldWarp> before = std::exchange(prepared.held, {});
  prepared.maps.clear();
  prepared.lenses.clear();
  prepared.log_zoom = 0;
  Bounds shown{glm::dvec3(0), prepared.space.size}; // by the warps so far
  for (const Warp& warp : prepared.scene.warp) {
    prepared.maps.push_back(map_once(prepared, warp, before));
    shown = object_bounds(prepared.maps.back(), shown);
    const auto* lens = std::get_if<LamarLens>(&warp);
    if (lens == nullptr)
      continue;
    prepared.lenses.push_back(
        prepare_lens(*lens, prepared.space, prepared.warp_view, pixels_per_unit(prepared, *lens)));
    prepared.log_zoom = std::max(prepared.log_zoom, std::log(lens->zoom));
    const Bounds footprint = footprint_bounds(prepared.lenses.back().map);
    shown.low = glm::min(shown.low, footprint.low);
    shown.high = glm::max(shown.high, footprint.high);
  }
  refuse_overlap(prepared.lenses);
  prepared.object_low = texture_from_box(prepared.space, shown.low);
  prepared.object_high = texture_from_box(prepared.space, shown.high);
  prepared.map_grid.reset();
  if (prepared.scene.render.pipeline == Pipeline::grid && !prepared.maps.empty()) {
    prepared.map_grid = GridMap{std::make_shared<const MapGrid>(
        make_map_grid(prepared.maps, prepared.scene.render.grid_size, shown.low, shown.high))};
  }
}

/// Unit vector from the focus centre to the viewer, along the volume's axes (Cohen, Brodlie and Phillips 2008
/// §3.3).
glm::dvec3 viewing_gaze(const PreparedScene& prepared) {
  const View& view = prepared.view;
  glm::dvec3 gaze = -view.forward;
  if (view.projection == Projection::perspective) {
    const glm::dvec3 focus = world_from_texture(prepared.box, gaze_origin(prepared.effects));
    const glm::dvec3 to_eye = view.eye - focus;
    if (glm::length(to_eye) > 0)
      gaze = glm::normalize(to_eye);
  }
  return glm::transpose(prepared.volume.direction) * gaze;
}

/// Highlight, attenuation, and the tables of pipeline `axis`: all that changes with an effect or the view.
void prepare_effects(PreparedScene& prepared) {
  const Scene& scene = prepared.scene;
  prepared.effects = focus_effects(scene.highlight, scene.attenuation, focus_region(scene.warp));
  prepared.effects.gaze = viewing_gaze(prepared);
  prepared.tables = {};
  if (scene.render.pipeline == Pipeline::axis)
    prepared.tables = axis_tables_of(prepared);
}

/// All that one volume needs but the view. `first`: whose texture coordinates clipping planes are given in.
void prepare_one(PreparedScene& prepared, const Box& first, double spacing) {
  const Scene& scene = prepared.scene;
  fill_missing(prepared);
  const double h = smallest_spacing(prepared.volume);
  prepared.spacing = spacing;
  prepared.unit_distance = prepared.transfer.unit_distance.value_or(h);
  prepared.xray_scale =
      scene.render.xray_scale.value_or(prepared.unit_distance / (2 * bounding_radius(prepared.box)));
  prepared.data_clip.clear();
  prepared.object_clip.clear();
  for (const ClipSettings& plane : scene.clip) {
    const Plane world{plane.normal, glm::dot(plane.normal, world_from_texture(first, plane.point))};
    auto& planes = plane.space == ClipSpace::texture ? prepared.data_clip : prepared.object_clip;
    planes.push_back(pull_back(world, prepared.box.world_from_texture));
  }
  if (scene.crop) {
    auto& planes = scene.crop->space == ClipSpace::texture ? prepared.data_clip : prepared.object_clip;
    const glm::dmat4 first_from_own = texture_from_world(first) * prepared.box.world_from_texture;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 normal(0);
      normal[axis] = 1;
      planes.push_back(pull_back({normal, scene.crop->low[axis]}, first_from_own));
      planes.push_back(pull_back({-normal, -scene.crop->high[axis]}, first_from_own));
    }
  }
  prepared.gradient_space = gradient_space_of(scene);
  prepare_labels(prepared);
  prepare_warps(prepared);
  prepare_effects(prepared);
  prepared.steps = sample_steps(prepared);
  prepared.levels =
      scene.render.footprint == Footprint::mip ? footprint_level_count(prepared) : scene.render.levels;
  if (is_paged(prepared))
    refuse_unpaged_settings(prepared);
  if (is_bricked(prepared) || prepared.levels > 1)
    (void)plan_bricks(prepared); // refuses tiles and levels that the volume has no voxels for
  prepare_pyramid(prepared);
  prepare_cells(prepared);
}

/// Widens the bounds of what is displayed to all volumes.
void include_others(PreparedScene& prepared) {
  for (std::size_t i = 1; i < volume_count(prepared); ++i) {
    const PreparedScene& other = volume_at(prepared, i);
    const glm::dmat4 to_first = glm::inverse(own_from_first(prepared, i));
    for (int k = 0; k < 8; ++k) {
      const glm::dvec3 corner =
          glm::mix(other.object_low, other.object_high, glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1));
      const glm::dvec3 t(to_first * glm::dvec4(corner, 1));
      prepared.object_low = glm::min(prepared.object_low, t);
      prepared.object_high = glm::max(prepared.object_high, t);
    }
  }
}

} // namespace

Box box_of_all(const PreparedScene& prepared) {
  if (prepared.others.empty())
    return prepared.box;
  Bounds bounds{glm::dvec3(0), glm::dvec3(1)};
  const glm::dmat4 to_first = texture_from_world(prepared.box);
  for (const PreparedScene& other : prepared.others) {
    for (const glm::dvec3& corner : corners(other.box)) {
      const glm::dvec3 t(to_first * glm::dvec4(corner, 1));
      bounds.low = glm::min(bounds.low, t);
      bounds.high = glm::max(bounds.high, t);
    }
  }
  const glm::dmat4 moved = glm::translate(prepared.box.world_from_texture, bounds.low);
  return {glm::scale(moved, bounds.high - bounds.low)};
}

namespace {

/// A volume of colours is drawn in them, as voxels that are classified already.
void draw_own_colors(PreparedScene& prepared) {
  bool colored = false;
  for (std::size_t i = 0; i < volume_count(prepared); ++i)
    colored = colored || !volume_at(prepared, i).volume.colors.rgba.empty();
  if (!colored)
    return;
  const std::string instead = "; or choose one component with volume.component";
  if (volume_count(prepared) > 1)
    throw UsageError("several volumes are combined after classification, and one of these is a volume of "
                     "colours; show it alone" +
                     instead);
  if (prepared.scene.overlay.legend)
    throw UsageError(
        "overlay.legend shows a transfer function, and the volume has colours of its own; set it "
        "to false" +
        instead);
  if (prepared.scene.render.skip != Skip::none)
    throw UsageError(
        "render.skip '" + word(prepared.scene.render.skip) +
        "' knows empty cells by a transfer function, which the volume's own colours have not; set "
        "render.skip to none" +
        instead);
  if (prepared.scene.render.shading != Shading::none)
    throw UsageError(
        "render.shading '" + word(prepared.scene.render.shading) +
        "' needs a gradient, which the volume's own colours have not; set render.shading to none" + instead);
  prepared.scene.render.classification = Classification::pre;
  try {
    validate(prepared.scene);
  } catch (const UsageError& error) {
    throw UsageError("a volume of colours is always drawn as render.classification 'pre' (volume.component "
                     "shows one component instead): " +
                     std::string(error.what()));
  }
}

} // namespace

void prepare_again(PreparedScene& prepared) {
  draw_own_colors(prepared);
  place(prepared, std::nullopt);
  prepared.box = box_of(prepared.volume);
  double h = smallest_spacing(prepared.volume);
  for (std::size_t i = 0; i < prepared.others.size(); ++i) {
    PreparedScene& other = prepared.others[i];
    other.scene = scene_of_volume(prepared.scene, i + 1);
    place(other, center(prepared.box));
    other.box = box_of(other.volume);
    h = std::min(h, smallest_spacing(other.volume));
  }
  const RenderSettings& render = prepared.scene.render;
  prepared.view = make_view(prepared.scene.camera, box_of_all(prepared), static_cast<int>(render.size[0]),
                            static_cast<int>(render.size[1]));
  const double spacing = render.spacing * h;
  prepare_one(prepared, prepared.box, spacing);
  for (PreparedScene& other : prepared.others) {
    other.view = prepared.view;
    prepare_one(other, prepared.box, spacing);
  }
  include_others(prepared);
}

PreparedScene one_volume(PreparedScene prepared, std::size_t index) {
  if (index > 0) {
    PreparedScene other = std::move(prepared.others[index - 1]);
    return other;
  }
  // The bounds go back to the first volume's own; the view stays that of all.
  const View view = prepared.view;
  const double spacing = prepared.spacing;
  prepared.others.clear();
  prepared.scene = scene_of_volume(prepared.scene, 0);
  prepared.view = view;
  prepare_one(prepared, prepared.box, spacing);
  return prepared;
}

glm::dmat4 own_from_first(const PreparedScene& prepared, std::size_t index) {
  if (index == 0)
    return glm::dmat4(1);
  return texture_from_world(volume_at(prepared, index).box) * prepared.box.world_from_texture;
}

AxisTables axis_tables_of(const PreparedScene& prepared) {
  const Scene& scene = prepared.scene;
  std::array<std::size_t, 3> counts = prepared.volume.dims;
  if (scene.render.axis_texels)
    counts.fill(*scene.render.axis_texels);
  return make_axis_tables(scene.warp, prepared.effects, counts);
}

std::vector<WarpMap> drawn_maps(const PreparedScene& prepared) {
  return prepared.map_grid ? std::vector<WarpMap>{*prepared.map_grid} : prepared.maps;
}

MapGridError map_grid_error(const PreparedScene& prepared) {
  const auto& dims = prepared.volume.dims;
  return map_grid_error(*prepared.map_grid->grid, prepared.maps, prepared.space,
                        glm::dvec3(dims[0], dims[1], dims[2]));
}

double isovalue_of(const PreparedScene& prepared) {
  return prepared.scene.render.isovalue.value_or(0.5 * (prepared.volume.min + prepared.volume.max));
}

double axis_distance_ratio(const PreparedScene& prepared) {
  return prepared.spacing / prepared.unit_distance;
}

Correction correction_of(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  if (render.opacity_correction == OpacityCorrection::none)
    return Correction::none;
  if (render.opacity_correction == OpacityCorrection::fragment && draws_slices(render.pipeline) &&
      render.proxy == Proxy::planes && prepared.view.projection == Projection::perspective) {
    return Correction::per_fragment;
  }
  return axis_distance_ratio(prepared) == 1 ? Correction::none : Correction::constant;
}

glm::dvec3 light_direction(const PreparedScene& prepared, const glm::dvec3& to_eye) {
  const auto& direction = prepared.scene.light.direction;
  return direction ? glm::normalize(*direction) : to_eye;
}

} // namespace slicelens
