#include "scene/scene.h"

#include "scene/names.h"

#include <algorithm>

namespace slicelens {

namespace {

/// Whether the warp is LaMar's or Cohen's, whose gradients are the data's own, carried by the Jacobian.
bool carries_gradients(const Warp& warp) {
  return std::holds_alternative<LamarLens>(warp) || std::holds_alternative<Bifocal>(warp) ||
         std::holds_alternative<Fisheye>(warp) || std::holds_alternative<VolumeLens>(warp) ||
         std::holds_alternative<ConnectedLens>(warp);
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

} // namespace slicelens
