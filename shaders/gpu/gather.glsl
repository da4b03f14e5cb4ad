// One more sample of a ray, front to back: what rays.frag does at every step and slabs.frag at every plane. Hosts declare
// distance_ratio (Δ/Δ₀, or 1 without correction), sample_ratio() (the same on this ray) and stretch() (the second by the first).

#if defined(MODE_ISO)
// Looks for a surface instead.
#elif defined(VOLUMES)
// Several volumes: the samples of all at this place are one sample. Under MIP each volume has its own channel.
vec4 gather(vec4 gathered, vec3 p, vec3 to_eye) {
#if defined(MODE_MIP)
  return max(gathered, all_units(p));
#else
  vec4 sample_color = all_samples(p, to_eye);
#if defined(MODE_XRAY)
  vec4 grey = vec4(1.0, 1.0, 1.0, sample_color.a * sample_ratio());
#ifdef FOCUS_EFFECTS
  grey = with_effects(grey, effects_at(p));
#endif
  return gathered + associated(grey.rgb, grey.a);
#else
#ifdef FOCUS_EFFECTS
  sample_color = with_effects(sample_color, effects_at(p));
#endif
  return under(gathered, associated(sample_color.rgb, corrected_opacity(sample_color.a, sample_ratio())));
#endif
#endif
}
#elif defined(LOCAL_MODES)
// Labels, some of whose runs become more than their samples.
TwoLevel gather_objects(TwoLevel state, vec3 p, vec3 to_eye) {
#ifdef WARPED
  vec3 t = texture_from_object(p);
  if (!in_volume(t) || !in_data_planes(t)) return ended_run(state, xray_scale);
#else
  vec3 t = p;
#endif
#ifdef FOCUS_EFFECTS
  vec2 focus = effects_at(p);
#else
  vec2 focus = vec2(1.0, 0.0);
#endif
  return with_object(state, t, p, to_eye, focus, sample_ratio());
}
#elif !defined(PREINTEGRATED)
#if defined(SHADED) && defined(MODE_DVR) && !defined(CLASSIFICATION_PRE)
// A sample's straight colour and opacity per reference length before any light, at the point p of what is displayed; nothing
// where the data are cut away.
vec4 color_without_light(vec3 p) {
#if defined(AXIS_TABLES)
  vec3 t = axis_texture_from_object(fetch_axis_tables(p), p);
  return in_data_planes(t) ? plain_color(t, p) : vec4(0.0);
#elif defined(WARPED)
  vec3 t = texture_from_object(p);
  return in_volume(t) && in_data_planes(t) ? plain_color(t, p) : vec4(0.0);
#else
  return plain_color(p, p);
#endif
}

// One more sample, of the colour that color_without_light has given for p.
vec4 gather_colored(vec4 gathered, vec4 color, vec3 p, vec3 to_eye) {
#if defined(AXIS_TABLES)
  AxisTexels texels = fetch_axis_tables(p);
  vec3 t = axis_texture_from_object(texels, p);
#elif defined(WARPED)
  vec3 t = texture_from_object(p);
#else
  vec3 t = p;
#endif
  vec4 lit = vec4(shade(color.rgb, t, p, to_eye), color.a);
#if defined(FOCUS_EFFECTS) && defined(AXIS_TABLES)
  lit = with_effects(lit, axis_effects(texels));
#elif defined(FOCUS_EFFECTS)
  lit = with_effects(lit, effects_at(p));
#endif
#if defined(CORRECT_CONSTANT) || defined(CORRECT_FRAGMENT)
  lit.a = corrected_opacity(lit.a, sample_ratio());
#endif
  return under(gathered, associated(lit.rgb, lit.a));
}
#endif

vec4 gather(vec4 gathered, vec3 p, vec3 to_eye) {
#if defined(AXIS_TABLES)
  AxisTexels texels = fetch_axis_tables(p);
  vec3 t = axis_texture_from_object(texels, p);
  if (!in_data_planes(t)) return gathered;
#elif defined(WARPED)
  vec3 t = texture_from_object(p);
  if (!in_volume(t) || !in_data_planes(t)) return gathered;
#if defined(LEVELS) && LEVELS > 1 && !defined(FOOTPRINT)
  choose_level(magnification(p));
#endif
#else
  vec3 t = p;
#endif
#if defined(FOCUS_EFFECTS) && defined(AXIS_TABLES)
  vec2 focus = axis_effects(texels);
#elif defined(FOCUS_EFFECTS)
  vec2 focus = effects_at(p);
#endif
#ifdef FOOTPRINT
  choose_footprint_level(p);
#endif
#if defined(CLASSIFICATION_PRE)
  vec4 ready = classified_sample(t);
#if defined(MODE_XRAY)
  return gathered + vec4(ready.a * sample_ratio());
#else
  return under(gathered, ready);
#endif
#else
#if defined(MODE_MIP)
#if defined(MODE_AVERAGE)
  return gathered + vec4(displayed_value(t), 0.0, 0.0, 1.0);
#else
#ifdef MODE_MINIP
  float value = -displayed_value(t);
#else
  float value = displayed_value(t);
#endif
#ifdef FOCUS_EFFECTS
  return value > gathered.x ? vec4(value, focus, 1.0) : gathered;
#else
  return vec4(max(gathered.x, value), 0.0, 0.0, 1.0);
#endif
#endif
#else
#ifdef ONE_FETCH
  vec4 sample_color = lit_color(t, p, to_eye);
#else
  vec4 sample_color = plain_color(t, p);
#endif
#if defined(MODE_XRAY)
#ifdef FOCUS_EFFECTS
  vec4 grey = with_effects(vec4(1.0, 1.0, 1.0, sample_color.a * sample_ratio()), focus);
  return gathered + associated(grey.rgb, grey.a);
#else
  return gathered + vec4(sample_color.a * sample_ratio());
#endif
#else
#if defined(SHADED) && !defined(ONE_FETCH)
  sample_color.rgb = shade(sample_color.rgb, t, p, to_eye);
#endif
#ifdef FOCUS_EFFECTS
  sample_color = with_effects(sample_color, focus);
#endif
#if defined(CORRECT_CONSTANT) || defined(CORRECT_FRAGMENT)
  sample_color.a = corrected_opacity(sample_color.a, sample_ratio());
#endif
  return under(gathered, associated(sample_color.rgb, sample_color.a));
#endif
#endif
#endif
}
#else
// The segment around p, with the texels at its two ends.
vec4 gather_segment(vec4 gathered, vec3 p, vec3 to_eye, vec2 ends) {
#if defined(AXIS_TABLES)
  AxisTexels texels = fetch_axis_tables(p);
  vec3 t = axis_texture_from_object(texels, p);
  if (!in_data_planes(t)) return gathered;
#elif defined(WARPED)
  vec3 t = texture_from_object(p);
  if (!in_volume(t) || !in_data_planes(t)) return gathered;
#else
  vec3 t = p;
#endif
#if defined(FOCUS_EFFECTS) && defined(AXIS_TABLES)
  vec2 focus = axis_effects(texels);
#elif defined(FOCUS_EFFECTS)
  vec2 focus = effects_at(p);
#else
  vec2 focus = vec2(1.0, 0.0);
#endif
  return under(gathered, segment_color(ends, t, p, to_eye, focus, stretch()));
}
#endif
