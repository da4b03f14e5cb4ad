#include "warp/focus_effects.h"

#include "core/errors.h"
#include "core/text.h"

#include <cmath>

namespace slicelens {

namespace {

using Functions = shared::FocusEffectsFunctions<double>;

void validate_power(double power, const std::string& section) {
  if (!(power >= 0 && power <= 1000)) {
    throw UsageError(section + ".power must be from 0 to 1000 (1 linear, 2 quadratic, 3 cubic), not " +
                     number_text(power));
  }
}

AxisRanges region_of(const std::optional<AxisRanges>& given, const std::optional<AxisRanges>& mapping,
                     const std::string& section) {
  if (given)
    return *given;
  if (!mapping) {
    throw UsageError(section +
                     " needs a focus region, and the scene has no bifocal, fisheye, volume-lens or "
                     "connected-lens to take it from; give " +
                     section + ".focus, [[min,max],[min,max],[min,max]] in texture coordinates");
  }
  return *mapping;
}

} // namespace

void validate(const Highlight& highlight) {
  validate_power(highlight.power, "highlight");
  for (int i = 0; i < 3; ++i) {
    if (!(highlight.color[i] >= 0 && highlight.color[i] <= 1))
      throw UsageError("highlight.color must be [r, g, b] from 0 to 1");
  }
  if (highlight.focus)
    validate_inside(*highlight.focus, "highlight.focus");
}

void validate(const Attenuation& attenuation) {
  validate_power(attenuation.power, "attenuation");
  if (attenuation.focus)
    validate_inside(*attenuation.focus, "attenuation.focus");
}

FocusEffects focus_effects(const Highlight& highlight, const Attenuation& attenuation,
                           const std::optional<AxisRanges>& mapping) {
  const Functions functions;
  FocusEffects effects{};
  effects.highlight = functions.highlight_off;
  effects.attenuation = functions.attenuation_off;
  effects.highlight_power = highlight.power;
  effects.highlight_color = highlight.color;
  effects.attenuation_power = attenuation.power;
  if (highlight.function != HighlightFunction::off) {
    const AxisRanges region = region_of(highlight.focus, mapping, "highlight");
    effects.highlight_low = low_of(region);
    effects.highlight_high = high_of(region);
    effects.highlight = functions.highlight_distance;
    if (highlight.function == HighlightFunction::focus) {
      effects.highlight = functions.highlight_focus;
      if (region[0].x == region[0].y) {
        throw UsageError("highlight.function 'focus' needs a region, and a fisheye has only a focal point; "
                         "give highlight.focus or function distance");
      }
    }
  }
  if (attenuation.function != AttenuationFunction::off) {
    const AxisRanges region = region_of(attenuation.focus, mapping, "attenuation");
    effects.attenuation_low = low_of(region);
    effects.attenuation_high = high_of(region);
    effects.attenuation = attenuation.function == AttenuationFunction::distance
                              ? functions.attenuation_distance
                              : functions.attenuation_viewpoint;
  }
  return effects;
}

glm::dvec3 gaze_origin(const FocusEffects& effects) {
  return 0.5 * (effects.attenuation_low + effects.attenuation_high);
}

bool has_highlight(const FocusEffects& effects) { return effects.highlight != Functions().highlight_off; }
bool has_attenuation(const FocusEffects& effects) {
  return effects.attenuation != Functions().attenuation_off;
}

double highlight_on_axis(const FocusEffects& effects, int axis, double x) {
  return Functions().highlight_on_axis(effects, x, axis);
}
double attenuation_on_axis(const FocusEffects& effects, int axis, double x) {
  return Functions().attenuation_on_axis(effects, x, axis);
}
double highlight_at(const FocusEffects& effects, const glm::dvec3& t) {
  return Functions().highlight_at(effects, t);
}
double attenuation_at(const FocusEffects& effects, const glm::dvec3& t) {
  return Functions().attenuation_at(effects, t);
}

} // namespace slicelens
