// One sample of a slice. MODE_DVR: associated colour for blending; MODE_MIP: the value, for GL_MAX (MODE_MINIP: upside
// down; MODE_AVERAGE: for summing, and 1 to count); MODE_XRAY: the opacity, for summing.
//
// CORRECT_CONSTANT corrects the opacity for one distance ratio; CORRECT_FRAGMENT for the distance along this
// fragment's own ray (Brunet §3.1). CLASSIFICATION_PRE reads colours that are
// corrected already. WARP_TESSELLATED divides the homogeneous coordinate that the mesh carries, WARP_SUBDIVIDED
// also tests where it looks: that mesh is not clipped in the data;
// WARP_FRAGMENT evaluates the warps here; AXIS_TABLES reads them from Cohen's tables. HIGHLIGHT and ATTENUATION follow the
// coordinate where the sample is shown; under MIP the winner of the depth test keeps its own. VOLUMES: there are several
// (gpu/one_volume.glsl); under MIP each has its own channel. SHELLS: polygons only cover what a shell about the eye can
// colour, and each fragment takes the sample that rays.frag would take there. PREINTEGRATED: it stands for the segment of
// its ray around it (gpu/segments.glsl). LOCAL_MODES: it carries its ray's run through an object to the next slice
// (gpu/carried_run.glsl) and blends nothing.

#include "lib/opacity.glsl"
#include "lib/composite.glsl"
#include "lib/shade.glsl"
#ifdef VOLUMES
#include "generated/volumes.glsl"
#else
#include "gpu/volume.glsl"
#include "gpu/classify.glsl"
#include "gpu/labels.glsl"
#include "gpu/classified.glsl"
#include "generated/warps.glsl"
#include "gpu/warp.glsl"
#include "gpu/axis_tables.glsl"
#include "gpu/footprint.glsl"
#include "gpu/gradient.glsl"
#include "gpu/light.glsl"
#endif
#include "gpu/focus_effects.glsl"
#include "gpu/objects.glsl"
#include "gpu/carried_run.glsl"

uniform float distance_ratio;     // Δ/Δ₀ on the view axis
uniform vec4 slope_from_pixel;    // perspective: tangents of the ray's angles = xy · gl_FragCoord + zw
uniform vec2 unit_from_value;     // MIP: value mapped to [0,1] for targets that hold no more
uniform vec3 to_eye_axis;         // world: against the viewing direction
uniform vec3 eye;                 // world, perspective
uniform mat4 world_from_texture;

#if defined(SHELLS) || defined(PREINTEGRATED)
#include "lib/ray.glsl"
#include "gpu/region.glsl"
#include "gpu/ray.glsl"
uniform vec2 place_from_pixel;  // pixels to [0, 2]
vec2 place() { return place_from_pixel * gl_FragCoord.xy - 1.0; }
#elif defined(JITTER) || defined(MODE_ISO)
#include "gpu/region.glsl"
#include "gpu/step.glsl"
#endif
#ifdef JITTER
#include "lib/jitter.glsl"
uniform float jitter;
uniform int jitter_seed;
in vec3 slice_coordinate;
vec3 object_coordinate;  // where this pixel's sample is
#elif defined(SHELLS)
flat in float shell;
vec3 object_coordinate;
#else
in vec3 object_coordinate;
#endif
#include "gpu/iso.glsl"
#ifdef WARP_TESSELLATED
in vec4 homogeneous_coordinate;
#endif
#ifdef LOCAL_MODES
uniform float slice_number;  // from 0, nearest first
layout(location = 0) out vec4 result;
layout(location = 1) out vec4 next_shown;
layout(location = 2) out vec4 next_run;
#else
out vec4 result;
#endif

#if defined(CORRECT_FRAGMENT)
float stretch() {
  vec2 slope = slope_from_pixel.xy * gl_FragCoord.xy + slope_from_pixel.zw;
  return sqrt(1.0 + dot(slope, slope));
}
float sample_ratio() { return distance_ratio * stretch(); }
#else
float stretch() { return 1.0; }
float sample_ratio() { return distance_ratio; }
#endif

#include "gpu/segments.glsl"
#ifdef PREINTEGRATED
// Half the way from one sample to the next on this fragment's ray, away from the eye.
vec3 half_step() {
#if defined(SHELLS)
  return 0.5 * delta * ray_through(place()).direction;
#elif defined(PERSPECTIVE)
  vec2 at = place();
  return 0.5 * delta * (frame.forward + at.x * frame.right + at.y * frame.up);
#else
  return 0.5 * delta * frame.forward;
#endif
}
#endif

vec3 direction_to_eye(vec3 p) {
#ifdef PERSPECTIVE
  return normalize(eye - (world_from_texture * vec4(p, 1.0)).xyz);
#else
  return to_eye_axis;
#endif
}

#ifdef JITTER
// Farther from the eye by a part of the slice distance that is the pixel's own.
void shift_sample() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  float offset = jitter * pixel_offset(pixel.x, pixel.y, uint(jitter_seed));
  object_coordinate = slice_coordinate - offset * step_to_eye(slice_coordinate);
  if (!in_region(object_coordinate)) discard;
}
#elif defined(SHELLS)
// To where the shell meets this pixel's ray.
void shift_sample() {
  PixelRay ray = ray_through(place());
  vec2 interval = clipped(hit_box(ray, object_low, object_high), ray);
  if (shell < first_sample(interval.x, delta) || shell > last_sample(interval.y, delta)) discard;
  object_coordinate = ray_point(ray, shell);
}
#else
void shift_sample() {}
#endif

#if defined(MODE_ISO)
// The surface between this slice and the one before it. The way looked along reaches beyond that one by what coordinates are
// rounded by: its fragment has this point by other arithmetic, and a surface between the two would be found by neither. What
// both find is the same point. A longer reach would also find thin parts that lie between two samples of the ray.
const float reach = 1e-6;  // texture coordinates: some steps of a float below 1
void main() {
  shift_sample();
  vec3 step_back = step_to_eye(object_coordinate);
  vec3 before = object_coordinate + step_back;
  vec3 here_point = shown_point(object_coordinate);
  vec3 before_point = shown_point(before);
  if (!in_region(before) || !shows_data(here_point) || !shows_data(before_point)) discard;
  float here_value = displayed_value(here_point);
  before += reach * normalize(step_back);
  float before_value = iso_value(before);
  if ((here_value < isovalue) == (before_value < isovalue)) discard;
  vec3 p = refined_crossing(before, object_coordinate, before_value, here_value, isovalue);
  result = vec4(surface_color(p, direction_to_eye(p)), 1.0);
}
#elif defined(VOLUMES)
// Several volumes: the samples of all at this place are one sample.
void main() {
  shift_sample();
#if defined(MODE_MIP)
  result = all_units(object_coordinate);
#else
  vec4 sample_color = all_samples(object_coordinate, direction_to_eye(object_coordinate));
#if defined(MODE_XRAY)
  vec4 grey = vec4(1.0, 1.0, 1.0, sample_color.a * sample_ratio());
#ifdef FOCUS_EFFECTS
  grey = with_effects(grey, effects_at(object_coordinate));
#endif
  result = associated(grey.rgb, grey.a);
#else
#ifdef FOCUS_EFFECTS
  sample_color = with_effects(sample_color, effects_at(object_coordinate));
#endif
  result = associated(sample_color.rgb, corrected_opacity(sample_color.a, sample_ratio()));
#endif
#endif
}
#else
void main() {
  shift_sample();
#if defined(WARP_TESSELLATED)
  vec3 texture_coordinate = homogeneous_coordinate.xyz / homogeneous_coordinate.w;
#ifdef WARP_SUBDIVIDED
  if (!in_volume(texture_coordinate) || !in_data_planes(texture_coordinate)) discard;
#endif
#elif defined(AXIS_TABLES)
  AxisTexels texels = fetch_axis_tables(object_coordinate);
  vec3 texture_coordinate = axis_texture_from_object(texels, object_coordinate);
#ifdef DATA_PLANES
  if (!in_data_planes(texture_coordinate)) discard;
#endif
#elif defined(WARP_FRAGMENT)
  vec3 texture_coordinate = texture_from_object(object_coordinate);
  if (!in_volume(texture_coordinate) || !in_data_planes(texture_coordinate)) discard;
#else
  vec3 texture_coordinate = object_coordinate;
#endif
#if defined(FOCUS_EFFECTS) && defined(AXIS_TABLES)
  vec2 focus = axis_effects(texels);
#elif defined(FOCUS_EFFECTS)
  vec2 focus = effects_at(object_coordinate);
#endif
#if (defined(PREINTEGRATED) || defined(LOCAL_MODES)) && !defined(FOCUS_EFFECTS)
  vec2 focus = vec2(1.0, 0.0);
#endif
#if defined(LOCAL_MODES)
  vec4 run = carried_run_here();
  TwoLevel state = carried_state(run);
  // The slice before has no sample on this ray: that place ended the run.
  if (run.w < slice_number - 1.5) state = ended_run(state, xray_scale);
  state = with_object(state, texture_coordinate, object_coordinate, direction_to_eye(object_coordinate), focus,
                      sample_ratio());
  result = state.gathered;
  next_shown = state.shown;
  next_run = vec4(float(state.row), float(state.mode), state.largest, slice_number);
#elif defined(PREINTEGRATED)
  vec3 p = object_coordinate;
  vec3 ahead = half_step();
  result = segment_color(vec2(end_texel(p - ahead), end_texel(p + ahead)), texture_coordinate, p, direction_to_eye(p),
                         focus, stretch());
#elif defined(CLASSIFICATION_PRE)
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
#if defined(FOOTPRINT)
  choose_footprint_level(object_coordinate);
#elif defined(WARP_TESSELLATED)
  choose_level(homogeneous_coordinate.w);
#elif defined(WARP_FRAGMENT)
  choose_level(magnification(object_coordinate));
#endif
#endif
#if defined(MODE_MIP)
  float value = displayed_value(texture_coordinate);
  float unit = unit_from_value.x * value + unit_from_value.y;
#ifdef FOCUS_EFFECTS
  result = vec4(unit, focus, 1.0);
  gl_FragDepth = 0.5 + 0.5 * unit;
#else
  result = vec4(unit, 0.0, 0.0, 1.0);
#endif
#else
#ifdef ONE_FETCH
  vec4 sample_color = lit_color(texture_coordinate, object_coordinate, direction_to_eye(object_coordinate));
#else
  vec4 sample_color = plain_color(texture_coordinate, object_coordinate);
#endif
#if defined(MODE_XRAY)
#if defined(CORRECT_CONSTANT) || defined(CORRECT_FRAGMENT)
  float weight = sample_color.a * sample_ratio();
#else
  float weight = sample_color.a;
#endif
#ifdef FOCUS_EFFECTS
  vec4 grey = with_effects(vec4(1.0, 1.0, 1.0, weight), focus);
  result = associated(grey.rgb, grey.a);
#else
  result = vec4(weight);
#endif
#else
#if defined(SHADED) && !defined(ONE_FETCH)
  sample_color.rgb = shade(sample_color.rgb, texture_coordinate, object_coordinate, direction_to_eye(object_coordinate));
#endif
#ifdef FOCUS_EFFECTS
  sample_color = with_effects(sample_color, focus);
#endif
#if defined(CORRECT_CONSTANT) || defined(CORRECT_FRAGMENT)
  sample_color.a = corrected_opacity(sample_color.a, sample_ratio());
#endif
  result = associated(sample_color.rgb, sample_color.a);
#endif
#endif
#endif
}
#endif
