// The parts of validate(Scene): which keys go together. Each throws UsageError naming the keys and what would
// be right. For scene/rules*.cpp only.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>

namespace slicelens {

// What is shown and from where: rules_inputs.cpp.
void validate_volume(const VolumeSettings& volume);
void validate_camera(const CameraSettings& camera);
void validate_transfer(const TransferSettings& transfer);
void validate_camera_file(const CameraSettings& camera);
void validate_label_table(const Scene& scene);
void validate_labels(const Scene& scene);
void validate_shapes(const Scene& scene);
void validate_placement(const Placement& placement);
void validate_annotations(const Scene& scene);
void validate_several(const Scene& scene);

// How it is sampled, classified and lit: rules_sampling.cpp.
void validate_render(const RenderSettings& render);
void validate_pre_classification(const RenderSettings& render, const CameraSettings& camera);
void validate_preintegrated(const Scene& scene);
void validate_fixed_function(const RenderSettings& render);
void validate_shells(const Scene& scene);
void validate_gradients(const Scene& scene);
void validate_planes(const Scene& scene);
void validate_planes_per_pass(const Scene& scene);
void validate_skip(const Scene& scene);

// Warps, effects and resolutions: rules_warps.cpp.
void validate_effects(const Scene& scene);
void validate_warps(const Scene& scene);
void validate_bricks(const Scene& scene);
void validate_footprint(const Scene& scene);

// Where the voxels are: rules_access.cpp.
void validate_access(const Scene& scene);

/// What of the scene works on all voxels at once ("render.pipeline 'reference'"), which volumes that stay on
/// disk cannot give; nothing where it can be drawn box by box.
std::optional<std::string> what_needs_voxels(const Scene& scene);

} // namespace slicelens
