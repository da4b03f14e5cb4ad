// The first surface of one value (MODE_ISO): opaque, in the transfer function's colour, where two neighbouring samples of a ray
// lie on its two sides (lib/iso.glsl). A surface that only the edge of the volume cuts has no such pair and is open there, as a
// contour of VTK is.

#ifdef MODE_ISO
uniform float isovalue;

vec3 shown_point(vec3 p) {
#if defined(AXIS_TABLES)
  return axis_texture_from_object(fetch_axis_tables(p), p);
#elif defined(WARPED)
  return texture_from_object(p);
#else
  return p;
#endif
}

bool shows_data(vec3 t) {
#if defined(AXIS_TABLES)
  return in_data_planes(t);
#elif defined(WARPED)
  return in_volume(t) && in_data_planes(t);
#else
  return true;
#endif
}

float iso_value(vec3 p) { return displayed_value(shown_point(p)); }

#include "lib/iso.glsl"

// Straight colour of the surface at p.
vec3 surface_color(vec3 p, vec3 to_eye) {
  vec3 color = classify(isovalue).rgb;
#ifdef SHADED
  color = shade(color, shown_point(p), p, to_eye);
#endif
#if defined(FOCUS_EFFECTS) && defined(AXIS_TABLES)
  color = with_effects(vec4(color, 1.0), axis_effects(fetch_axis_tables(p))).rgb;
#elif defined(FOCUS_EFFECTS)
  color = with_effects(vec4(color, 1.0), effects_at(p)).rgb;
#endif
  return color;
}
#endif
