// One sample of a slice. MODE_DVR: associated colour for blending; MODE_MIP: the value, for GL_MAX; MODE_XRAY: the
// opacity, for summing.
//
// CORRECT_CONSTANT corrects the opacity for one distance ratio; CORRECT_FRAGMENT for the distance along this
// fragment's own ray (Brunet §3.1). CLASSIFICATION_PRE reads colours that are
// corrected already. WARP_TESSELLATED divides the homogeneous coordinate that the mesh carries;
// WARP_FRAGMENT evaluates the lens here.

#include "lib/opacity.glsl"
#include "lib/composite.glsl"
#include "gpu/volume.glsl"
#include "gpu/classify.glsl"
#include "gpu/classified.glsl"
#include "lib/gradient.glsl"
#include "lib/shade.glsl"
#include "gpu/warp.glsl"
#include "gpu/light.glsl"

uniform float distance_ratio;     // Δ/Δ₀ on the view axis
uniform vec4 slope_from_pixel;    // perspective: tangents of the ray's angles = xy · gl_FragCoord + zw
uniform vec2 unit_from_value;     // MIP: value mapped to [0,1] for targets that hold no more
uniform vec3 to_eye_axis;         // world: against the viewing direction
uniform vec3 eye;                 // world, perspective
uniform mat4 world_from_texture;

in vec3 object_coordinate;
#ifdef WARP_TESSELLATED
in vec4 homogeneous_coordinate;
#endif
out vec4 result;

#if defined(CORRECT_FRAGMENT)
float sample_ratio() {
  vec2 slope = slope_from_pixel.xy * gl_FragCoord.xy + slope_from_pixel.zw;
  return distance_ratio * sqrt(1.0 + dot(slope, slope));
}
#else
float sample_ratio() { return distance_ratio; }
#endif

vec3 direction_to_eye(vec3 p) {
#ifdef PERSPECTIVE
  return normalize(eye - (world_from_texture * vec4(p, 1.0)).xyz);
#else
  return to_eye_axis;
#endif
}

void main() {
#if defined(WARP_TESSELLATED)
  vec3 texture_coordinate = homogeneous_coordinate.xyz / homogeneous_coordinate.w;
#elif defined(WARP_FRAGMENT)
  vec3 texture_coordinate = texture_from_object(object_coordinate);
  if (!in_volume(texture_coordinate) || !in_data_planes(texture_coordinate)) discard;
#else
  vec3 texture_coordinate = object_coordinate;
#endif
#if defined(CLASSIFICATION_PRE)
  vec4 sample_color = classified_sample(texture_coordinate);
#if defined(MODE_XRAY)
#if defined(CORRECT_CONSTANT) || defined(CORRECT_FRAGMENT)
  sample_color = vec4(sample_color.a * sample_ratio());
#else
  sample_color = vec4(sample_color.a);
#endif
#endif
  result = sample_color;
#else
#if defined(LEVELS) && LEVELS > 1
#if defined(WARP_TESSELLATED)
  choose_level(homogeneous_coordinate.w);
#elif defined(WARP_FRAGMENT)
  choose_level(magnification(object_coordinate));
#endif
#endif
#if defined(MODE_MIP)
  float value = displayed_value(texture_coordinate);
  result = vec4(unit_from_value.x * value + unit_from_value.y, 0.0, 0.0, 1.0);
#else
  vec4 sample_color = classify_texel(displayed_texel(texture_coordinate));
#if defined(MODE_XRAY)
#if defined(CORRECT_CONSTANT) || defined(CORRECT_FRAGMENT)
  result = vec4(sample_color.a * sample_ratio());
#else
  result = vec4(sample_color.a);
#endif
#else
#ifdef SHADING_DIFFUSE
  sample_color.rgb = shade(sample_color.rgb, texture_coordinate, object_coordinate, direction_to_eye(object_coordinate));
#endif
#if defined(CORRECT_CONSTANT) || defined(CORRECT_FRAGMENT)
  sample_color.a = corrected_opacity(sample_color.a, sample_ratio());
#endif
  result = associated(sample_color.rgb, sample_color.a);
#endif
#endif
#endif
}
