// One of several volumes: everything that it alone has. The host includes this file once for each, with every name below and in
// the files included here renamed (src/render/several_glsl.cpp). Its chain of warps comes before.

#include "gpu/volume.glsl"
#include "gpu/classify.glsl"
#include "gpu/warp.glsl"
#include "gpu/gradient.glsl"
#include "gpu/light.glsl"

uniform mat4 own_from_first;   // to its texture coordinates from those of the first volume
uniform float length_ratio;    // Δ₀ of the first volume by its own
uniform vec2 unit_from_value;  // MIP: value mapped to [1/255, 1]; 0 is no value

// Straight colour and opacity per reference length of the first volume; nothing outside.
vec4 own_sample(vec3 first, vec3 to_eye) {
  vec3 p = (own_from_first * vec4(first, 1.0)).xyz;
  vec3 t = texture_from_object(p);
  vec4 color = plain_color(t, p);
#ifdef SHADED
  color.rgb = shade(color.rgb, t, p, to_eye);
#endif
  color.a = in_volume(t) && in_data_planes(t) ? corrected_opacity(color.a, length_ratio) : 0.0;
  return color;
}

// MIP: 0 outside.
float own_unit(vec3 first) {
  vec3 t = texture_from_object((own_from_first * vec4(first, 1.0)).xyz);
  float unit = unit_from_value.x * displayed_value(t) + unit_from_value.y;
  return in_volume(t) && in_data_planes(t) ? unit : 0.0;
}

// What a maximum stands for.
vec4 own_color(float unit) {
  vec4 color = classify((unit - unit_from_value.y) / unit_from_value.x);
  color.a = unit > 0.0 ? corrected_opacity(color.a, length_ratio) : 0.0;
  return color;
}
