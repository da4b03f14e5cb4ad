// Cohen's highlight and attenuation of a focus region as values.
#pragma once

#include "warp/axis_ranges.h"
#include "warp/shared_axis_maps.h"

#include <optional>

namespace slicelens {

enum class HighlightFunction { off, distance, focus };
enum class AttenuationFunction { off, distance, viewpoint };

/// Section `highlight` (Cohen, Brodlie and Phillips 2008 §3.2, eq. 1 and 2).
struct Highlight {
  HighlightFunction function = HighlightFunction::off;
  double power = 1;          ///< of the distance function: 1 linear, 2 quadratic, 3 cubic
  glm::dvec3 color{0, 1, 0}; ///< H, [0,1]
  std::optional<AxisRanges> focus = std::nullopt; ///< on display; none: the mapping's own
};

/// Section `attenuation` (§3.3, eq. 3 and 4).
struct Attenuation {
  AttenuationFunction function = AttenuationFunction::off;
  double power = 1;
  std::optional<AxisRanges> focus = std::nullopt; ///< on display; none: the mapping's own
};

/// Throws UsageError naming the key: powers below 0 or not finite, a focus that is no region within the
/// volume.
void validate(const Highlight& highlight);
void validate(const Attenuation& attenuation);

namespace shared {
template <class Real>
struct FocusEffectsFunctions {
  SLICELENS_SHARED_NAMES(Real)
#include "lib/focus_effects.glsl"
};
} // namespace shared

using FocusEffects = shared::FocusEffectsFunctions<double>::FocusEffects;

/// The numbers that shaders/lib/focus_effects.glsl takes. `mapping`: the focus region that the mapping shows
/// (low = high for a fisheye's focal point), used where a section gives none; `gaze`: see viewing_gaze.
/// Throws UsageError where a function needs a region and there is none.
FocusEffects focus_effects(const Highlight& highlight, const Attenuation& attenuation,
                           const std::optional<AxisRanges>& mapping);

/// Middle of the attenuation's region, texture coordinates: where the gaze vector starts.
glm::dvec3 gaze_origin(const FocusEffects& effects);

/// Whether anything is highlighted or attenuated.
bool has_highlight(const FocusEffects& effects);
bool has_attenuation(const FocusEffects& effects);

/// h (eq. 1) and a (eq. 3, 4) of one axis at displayed coordinate x, and their products at t.
double highlight_on_axis(const FocusEffects& effects, int axis, double x);
double attenuation_on_axis(const FocusEffects& effects, int axis, double x);
double highlight_at(const FocusEffects& effects, const glm::dvec3& t);
double attenuation_at(const FocusEffects& effects, const glm::dvec3& t);

/// Calls set(name, value) for every field as GLSL takes it.
template <class Set>
void visit_fields(const FocusEffects& effects, const Set& set) {
  set("highlight", effects.highlight);
  set("highlight_power", effects.highlight_power);
  set("highlight_color", effects.highlight_color);
  set("highlight_low", effects.highlight_low);
  set("highlight_high", effects.highlight_high);
  set("attenuation", effects.attenuation);
  set("attenuation_power", effects.attenuation_power);
  set("attenuation_low", effects.attenuation_low);
  set("attenuation_high", effects.attenuation_high);
  set("gaze", effects.gaze);
}

} // namespace slicelens
