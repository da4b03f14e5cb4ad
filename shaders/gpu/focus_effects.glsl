// Highlight and attenuation of a sample (lib/focus_effects.glsl). HIGHLIGHT and ATTENUATION say which are on; with
// AXIS_TABLES both come from the tables (gpu/axis_tables.glsl), else from the formulas.

#if defined(HIGHLIGHT) || defined(ATTENUATION)
#define FOCUS_EFFECTS
#include "lib/focus_effects.glsl"
uniform FocusEffects effects;

#ifndef AXIS_TABLES
// At the coordinate where a sample is shown: attenuation, highlight.
vec2 effects_at(vec3 p) {
  vec2 result = vec2(1.0, 0.0);
#ifdef ATTENUATION
  result.x = attenuation_at(effects, p);
#endif
#ifdef HIGHLIGHT
  result.y = highlight_at(effects, p);
#endif
  return result;
}
#endif

// A straight colour and its opacity per reference length after both. Opacity is scaled before any correction, or the picture
// would depend on the spacing.
vec4 with_effects(vec4 color, vec2 attenuation_highlight) {
  return vec4(highlighted(color.rgb, effects.highlight_color, attenuation_highlight.y),
              color.a * attenuation_highlight.x);
}
#endif
