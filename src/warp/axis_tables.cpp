#include "warp/axis_tables.h"

#include "core/errors.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

using Functions = shared::AxisMapFunctions<double>;

void refuse_others(const std::vector<Warp>& warps) {
  for (const Warp& warp : warps) {
    if (!is_separable(warp)) {
      throw UsageError("pipeline 'axis' needs a separable warp; '" + kind_of(warp) +
                       "' is not: use fragment, rays or reference");
    }
    const bool masked =
        std::holds_alternative<VolumeLens>(warp) || std::holds_alternative<ConnectedLens>(warp);
    if (masked && warps.size() > 1) {
      throw UsageError("pipeline 'axis' has one mask for each axis, which the mask of '" + kind_of(warp) +
                       "' fills; draw it without other warps, or use fragment, rays or reference");
    }
  }
}

} // namespace

AxisSample sample_axis(const Warp& warp, int axis, double x) {
  Functions functions;
  if (const auto* bifocal = std::get_if<Bifocal>(&warp)) {
    const glm::dvec2& focus = bifocal->focus[static_cast<std::size_t>(axis)];
    const glm::dvec2& shown = bifocal->shown[static_cast<std::size_t>(axis)];
    return {functions.bifocal_axis(x, focus.x, focus.y, shown.x, shown.y).x, 1};
  }
  if (const auto* fisheye = std::get_if<Fisheye>(&warp))
    return {functions.fisheye_axis(x, fisheye->center[axis], fisheye->distortion[axis]).x, 1};
  const auto lens = [&](const LensBox& box) {
    return functions.lens_axis(x, box.center[axis], box.inner[axis], box.outer[axis], box.magnification).x;
  };
  if (const auto* volume_lens = std::get_if<VolumeLens>(&warp)) {
    const LensBox& box = volume_lens->box;
    return {lens(box), std::abs(x - box.center[axis]) < box.outer[axis] ? 1.0 : 0.0};
  }
  if (const auto* connected = std::get_if<ConnectedLens>(&warp)) {
    const LensBox& box = connected->box;
    return {lens(box), functions.lens_weight(x, box.center[axis], box.inner[axis], box.outer[axis]).x};
  }
  throw UsageError("warp '" + kind_of(warp) + "' has no map for single axes");
}

bool is_unmasked(const AxisTables& tables) {
  for (const std::vector<glm::vec4>& texels : tables.texels) {
    if (!std::all_of(texels.begin(), texels.end(), [](const glm::vec4& texel) { return texel.g == 1; }))
      return false;
  }
  return true;
}

AxisTables make_axis_tables(const std::vector<Warp>& warps, const FocusEffects& effects,
                            const std::array<std::size_t, 3>& counts) {
  refuse_others(warps);
  AxisTables tables;
  if (!warps.empty() && std::holds_alternative<ConnectedLens>(warps[0]))
    tables.mask = AxisMask::weight;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t count = counts[static_cast<std::size_t>(axis)];
    for (std::size_t j = 0; j < count; ++j) {
      const double x = (static_cast<double>(j) + 0.5) / static_cast<double>(count);
      AxisSample sample{x, 1};
      for (auto warp = warps.rbegin(); warp != warps.rend(); ++warp)
        sample = sample_axis(*warp, axis, sample.texture);
      tables.texels[static_cast<std::size_t>(axis)].emplace_back(sample.texture - x, sample.mask,
                                                                 attenuation_on_axis(effects, axis, x),
                                                                 highlight_on_axis(effects, axis, x));
    }
  }
  return tables;
}

} // namespace slicelens
