// LOCAL_MODES: labels, some of whose runs of samples become more than the samples one by one (lib/two_level.glsl).

#ifdef LOCAL_MODES
#include "lib/two_level.glsl"
uniform float xray_scale;

// One more sample of this pixel's ray: the data at t, shown at p; `ratio` = Δ/Δ₀ on this ray, `focus` its highlight and
// attenuation.
TwoLevel with_object(TwoLevel state, vec3 t, vec3 p, vec3 to_eye, vec2 focus, float ratio) {
  int row = label_row(t);
  int mode = label_mode(row);
  float value = displayed_value(t);
  vec4 color = classify_row(row, value);
#ifdef MODULATED
  if (mode != 1) color.a *= opacity_factor(t, p);
#endif
#ifdef SHADED
  if (mode == 0) color.rgb = shade(color.rgb, t, p, to_eye);
#endif
#ifdef FOCUS_EFFECTS
  color = with_effects(color, focus);
#endif
  float alpha = color.a;
#if defined(CORRECT_CONSTANT) || defined(CORRECT_FRAGMENT)
  alpha = corrected_opacity(color.a, ratio);
#endif
  return with_sample(state, row, mode, value, color, alpha, ratio, xray_scale);
}
#endif
