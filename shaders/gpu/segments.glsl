// Pre-integrated classification (PREINTEGRATED): a sample stands for the segment of the ray around it, from half a sample
// distance before to half behind it. Its host declares distance_ratio (Δ/Δ₀, or 1 without correction).

#ifdef PREINTEGRATED
#include "lib/segment.glsl"
uniform sampler2D segment_texture;  // associated colour and opacity by front and back value (volume/segment_table.h)
uniform vec2 segment_from_texel;    // table coordinate = x · texel of the volume + y

// What the volume's texture holds of the data that is shown at p, an end of a segment. Beyond the volume: its edge.
float end_texel(vec3 p) {
#if defined(AXIS_TABLES)
  return displayed_texel(axis_texture_from_object(fetch_axis_tables(p), p));
#elif defined(WARPED)
  return displayed_texel(texture_from_object(p));
#else
  return displayed_texel(p);
#endif
}

#ifdef OCCUPANCY
// The same at the front of segment k where segments before it were passed over; else `front`, which is its end already. A loop,
// since no driver need branch.
float front_after(PixelRay ray, int k, bool passed, float front) {
  float texel = front;
  for (int n = passed ? 1 : 0; n > 0; --n) texel = end_texel(ray_point(ray, float(k) - 0.5));
  return texel;
}
#endif

// Associated colour. `ends`: texels in front and behind; `t`: where the data of the middle is looked at, `p`: where it is
// shown; `focus`: attenuation and highlight there; `stretch`: length of the segment by that of the table's.
vec4 segment_color(vec2 ends, vec3 t, vec3 p, vec3 to_eye, vec2 focus, float stretch) {
  vec4 segment = textureLod(segment_texture, segment_from_texel.x * ends + segment_from_texel.y, 0.0);
#if defined(SHADED) || defined(FOCUS_EFFECTS)
  vec4 color = vec4(segment.rgb / max(segment.a, 1e-30), 1.0);
#ifdef SHADED
  color.rgb = shade(color.rgb, t, p, to_eye);
#endif
#ifdef FOCUS_EFFECTS
  color = with_effects(color, focus);
#endif
  return associated(color.rgb, segment_opacity(segment.a, color.a, distance_ratio, stretch));
#elif defined(CORRECT_FRAGMENT)
  return segment * (corrected_opacity(segment.a, stretch) / max(segment.a, 1e-30));
#else
  return segment;
#endif
}
#endif
