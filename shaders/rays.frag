// A ray through each pixel, sampled front to back (docs/pipeline.md). The loop gathers in its own variables only and nothing
// that a diverging loop computes is read but through them. PARTS: only the samples whose bricks are loaded; parts are blended
// front to back, and under MIP classified when all are there.

#include "lib/opacity.glsl"
#include "lib/composite.glsl"
#include "lib/ray.glsl"
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
#include "gpu/footprint.glsl"
#include "gpu/gradient.glsl"
#include "gpu/light.glsl"
#endif
#include "gpu/focus_effects.glsl"
#include "gpu/objects.glsl"
#ifdef CUT_PLANES
#include "gpu/plane.glsl"
uniform CutPlane planes[CUT_PLANES];
#endif

uniform float distance_ratio;    // Δ/Δ₀, or 1 without correction
uniform float early_termination;
uniform vec3 to_eye_axis;
uniform mat3 world_from_direction;  // texture-space vectors to world space
#ifdef JITTER
#include "lib/jitter.glsl"
uniform float jitter;
uniform int jitter_seed;
#endif

#include "gpu/region.glsl"
#include "gpu/ray.glsl"
#include "gpu/iso.glsl"
#include "gpu/occupancy.glsl"

#ifdef PARTS
uniform vec2 sample_range;  // numbers of the first and the last sample of a part whose bricks are loaded
#endif

float stretch() { return 1.0; }
float sample_ratio() { return distance_ratio; }
#include "gpu/segments.glsl"

in vec2 place;
out vec4 result;

#if defined(MODE_ISO)
// The first surface between two neighbouring samples: its point, and 1 where there is one.
vec4 first_surface(PixelRay ray, int first, int last, float offset) {
  vec4 hit = vec4(0.0);
  bool had = false;
  float before_value = 0.0;
  vec3 before = vec3(0.0);
  for (int k = first; k <= last; ++k) {
#ifdef OCCUPANCY
    // From sample next − 1 to `next` there may be one. Where samples were passed over the first of the two is looked at anew.
    int next = next_between(ray, k, last, offset - 1.0);
    if (next > last) break;
    if (next > k) {
      k = next - 1;
      had = false;
    }
#endif
    vec3 p = ray_point(ray, float(k) + offset);
    vec3 t = shown_point(p);
    bool has = shows_data(t);
    float value = displayed_value(t);
    if (had && has && (value < isovalue) != (before_value < isovalue)) {
      hit = vec4(refined_crossing(before, p, before_value, value, isovalue), 1.0);
      break;
    }
    had = has;
    before_value = value;
    before = p;
  }
  return hit;
}
#endif
#include "gpu/gather.glsl"
#if defined(EARLY_TERMINATION) && defined(MODE_DVR)
#define END_OPACITY early_termination
#endif
#if !defined(MODE_ISO) && !defined(LOCAL_MODES) && !defined(PREINTEGRATED)
#include "gpu/march.glsl"
#endif

#ifdef CUT_PLANES
// The nearest cutting plane on the ray: its distance (beyond the interval: none) and colour. Planes are not cut by clipping planes.
vec4 nearest_plane(PixelRay ray, vec2 interval, inout float nearest) {
  vec4 color = vec4(0.0);
  for (int i = 0; i < CUT_PLANES; ++i) {
    float slope = dot(planes[i].place.xyz, ray.direction);
    float s = -(dot(planes[i].place.xyz, ray.origin) + planes[i].place.w) / (slope == 0.0 ? 1e-30 : slope);
    vec3 p = ray.origin + s * ray.direction;
#ifdef WARPED
    vec3 t = texture_from_object(p);
    bool inside = in_volume(t);
#else
    vec3 t = p;
    bool inside = true;
#endif
    if (inside && s >= interval.x && s <= interval.y && s < nearest && plane_shows(planes[i], t)) {
      nearest = s;
      color = vec4(plane_color(planes[i], t), 1.0);
    }
  }
  return color;
}
#endif

void main() {
  PixelRay ray = ray_through(place);
#ifdef PERSPECTIVE
  vec3 to_eye = -normalize(world_from_direction * ray.direction);
#else
  vec3 to_eye = to_eye_axis;
#endif
  vec2 interval = hit_box(ray, object_low, object_high);
#ifdef CUT_PLANES
  float stop = 1e30;
  vec4 behind = nearest_plane(ray, interval, stop);
  interval.y = min(interval.y, stop);
#endif
  interval = clipped(interval, ray);
#if defined(MODE_MIP) && !defined(VOLUMES) && !defined(MODE_AVERAGE)
  vec4 gathered = vec4(-3.0e38, 0.0, 0.0, 0.0);
#else
  vec4 gathered = vec4(0.0);
#endif
#ifdef JITTER
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  float offset = jitter * pixel_offset(pixel.x, pixel.y, uint(jitter_seed));
#else
  float offset = 0.0;
#endif
  if (interval.x <= interval.y) {
    int first = int(first_sample(interval.x - offset * delta, delta));
    int last = int(last_sample(interval.y - offset * delta, delta));
#ifdef PARTS
#ifdef MODE_ISO
    first = max(first, int(sample_range.x) - 1);  // the surface may lie between the last part's last sample and the first
#else
    first = max(first, int(sample_range.x));
#endif
    last = min(last, int(sample_range.y));
#endif
#ifdef MODE_ISO
    vec4 hit = first_surface(ray, first, last, offset);
    if (hit.w > 0.0) gathered = vec4(surface_color(hit.xyz, to_eye), 1.0);
#else
#if defined(LOCAL_MODES)
    TwoLevel state = nothing_gathered();
    for (int k = first; k <= last; ++k) {
#ifdef OCCUPANCY
      int next = next_occupied(ray, k, last, offset);
      if (next > last) break;
      if (next > k) state = ended_run(state, xray_scale);  // what was passed over is no part of it
      k = next;
#endif
      state = gather_objects(state, ray_point(ray, float(k) + offset), to_eye);
      gathered = state.gathered;
#ifdef END_OPACITY
      if (gathered.a >= END_OPACITY) break;
#endif
    }
    gathered = ended_run(state, xray_scale).gathered;
#elif defined(PREINTEGRATED)
    float front = end_texel(ray_point(ray, float(first) - 0.5));
    for (int k = first; k <= last; ++k) {
#ifdef OCCUPANCY
      int next = next_between(ray, k, last, -0.5);
      if (next > last) break;
      front = front_after(ray, next, next > k, front);
      k = next;
#endif
      float back = end_texel(ray_point(ray, float(k) + 0.5));
      gathered = gather_segment(gathered, ray_point(ray, float(k) + offset), to_eye, vec2(front, back));
      front = back;
#ifdef END_OPACITY
      if (gathered.a >= END_OPACITY) break;
#endif
    }
#else
    gathered = gathered_along(gathered, ray, first, last, offset, to_eye);
#endif
#endif
  }
#if defined(MODE_MIP) && defined(PARTS)
  // Parts are put together and classified at the end (classify_maximum.frag).
#elif defined(MODE_MIP) && defined(VOLUMES)
  vec4 shown = color_of_units(gathered);
  gathered = associated(shown.rgb, shown.a);
#elif defined(MODE_MIP)
  if (gathered.w > 0.0) {
#if defined(MODE_AVERAGE)
    vec4 color = classify(gathered.x / gathered.w);
#elif defined(MODE_MINIP)
    vec4 color = classify(-gathered.x);
#else
    vec4 color = classify(gathered.x);
#endif
#ifdef FOCUS_EFFECTS
    color = with_effects(color, gathered.yz);
#endif
    gathered = associated(color.rgb, color.a);
  } else {
    gathered = vec4(0.0);
  }
#endif
#ifdef CUT_PLANES
  gathered = under(gathered, behind);
#endif
  result = gathered;
}
