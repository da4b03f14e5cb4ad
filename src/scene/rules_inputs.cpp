#include "core/errors.h"
#include "core/text.h"
#include "scene/names.h"
#include "scene/rules.h"
#include "warp/axis_tables.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace slicelens {

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

} // namespace slicelens
