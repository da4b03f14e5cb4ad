#include "scene/rules.h"

#include "core/errors.h"
#include "core/text.h"
#include "scene/names.h"
#include "warp/axis_tables.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace slicelens {

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
    validate_skip(scene);
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
  validate_planes_per_pass(scene);
  validate_skip(scene);
  validate_labels(scene);
  validate_gradients(scene);
  validate_access(scene);
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
