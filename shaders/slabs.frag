// Several planes of the stack in one fragment (render.planes_per_pass): it samples them where its ray meets them, front to
// back, and what they make together is blended once. The samples are those of slices.frag to rounding; where a plane's polygon
// ends is decided by the ray's interval in the volume instead of the rasteriser. MODE_MIP: as slices.frag, the value for
// GL_MAX. Nothing that the diverging loop computes is read but through its own variables. OCCUPANCY: planes whose sample lies
// in an empty cell are passed over; HIDDEN: a ray ends where no more light would come through.

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
#include "gpu/axis_tables.glsl"
#include "gpu/footprint.glsl"
#include "gpu/gradient.glsl"
#include "gpu/light.glsl"
#endif
#include "gpu/focus_effects.glsl"

uniform float distance_ratio;     // Δ/Δ₀ on the view axis
uniform vec2 unit_from_value;     // MIP: value mapped to [0,1] for targets that hold no more
uniform vec3 to_eye_axis;         // world: against the viewing direction
uniform mat4 world_from_texture;
uniform vec4 slope_from_pixel;    // perspective: tangents of the ray's angles = xy · gl_FragCoord + zw
uniform vec2 place_from_pixel;    // pixels to [0, 2]
uniform vec3 plane_center;        // texture coordinates: the view axis on the plane from which distances count
uniform float plane_depth;        // perspective: that plane's depth
uniform float nothing_behind;     // HIDDEN: the opacity at which a ray ends
#ifdef JITTER
#include "lib/jitter.glsl"
uniform float jitter;
uniform int jitter_seed;
#endif

#include "gpu/region.glsl"
#include "gpu/ray.glsl"
#include "gpu/occupancy.glsl"

flat in vec2 planes;
out vec4 result;

#if defined(CORRECT_FRAGMENT)
float ray_stretch;
float stretch() { return ray_stretch; }
#else
float stretch() { return 1.0; }
#endif
float sample_ratio() { return distance_ratio * stretch(); }

#include "gpu/segments.glsl"
#include "gpu/gather.glsl"
#ifdef HIDDEN
#define END_OPACITY nothing_behind
#endif
#ifndef PREINTEGRATED
#include "gpu/march.glsl"
#endif

// This fragment's ray by distances along the view axis, so that plane k is its sample k.
PixelRay ray_over_planes() {
  vec2 at = place_from_pixel * gl_FragCoord.xy - 1.0;
  vec3 aside = at.x * frame.right + at.y * frame.up;
#ifdef PERSPECTIVE
  return PixelRay(plane_center + plane_depth * aside, frame.forward + aside, -plane_depth);
#else
  return PixelRay(plane_center + aside, frame.forward, -1e30);
#endif
}

vec4 shown(vec4 gathered) {
#if !defined(MODE_MIP) || defined(VOLUMES)
  return gathered;
#elif defined(MODE_AVERAGE)
  return vec4(unit_from_value.x * gathered.x + unit_from_value.y * gathered.w, 0.0, 0.0, gathered.w);
#elif defined(MODE_MINIP)
  return vec4(unit_from_value.y - unit_from_value.x * gathered.x, gathered.yzw);
#else
  return vec4(unit_from_value.x * gathered.x + unit_from_value.y, gathered.yzw);
#endif
}

void main() {
  PixelRay ray = ray_over_planes();
#ifdef PERSPECTIVE
  vec3 to_eye = -normalize(mat3(world_from_texture) * ray.direction);
#else
  vec3 to_eye = to_eye_axis;
#endif
#ifdef CORRECT_FRAGMENT
  vec2 slope = slope_from_pixel.xy * gl_FragCoord.xy + slope_from_pixel.zw;
  ray_stretch = sqrt(1.0 + dot(slope, slope));
#endif
#ifdef JITTER
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  float offset = jitter * pixel_offset(pixel.x, pixel.y, uint(jitter_seed));
#else
  float offset = 0.0;
#endif
#if defined(MODE_MIP) && !defined(VOLUMES) && !defined(MODE_AVERAGE)
  vec4 gathered = vec4(-3.0e38, 0.0, 0.0, 0.0);
#else
  vec4 gathered = vec4(0.0);
#endif
  vec2 interval = clipped(hit_box(ray, object_low, object_high), ray);
  // A plane on a face of the volume is in it, whatever the interval is rounded to; which faces count is for the stack to say.
  interval += vec2(-1e-4, 1e-4) * delta;
  if (interval.x <= interval.y) {
    int first = int(max(first_sample(interval.x - offset * delta, delta), planes.x));
    int last = int(min(last_sample(interval.y - offset * delta, delta), planes.y));
#ifdef PREINTEGRATED
    float front = end_texel(ray_point(ray, float(first) - 0.5));
    for (int k = first; k <= last; ++k) {
      float back = end_texel(ray_point(ray, float(k) + 0.5));
      gathered = gather_segment(gathered, ray_point(ray, float(k) + offset), to_eye, vec2(front, back));
      front = back;
    }
#else
    gathered = gathered_along(gathered, ray, first, last, offset, to_eye);
#endif
  }
#if defined(MODE_MIP) && !defined(VOLUMES)
  if (gathered.w == 0.0) discard;
#endif
  result = shown(gathered);
#if defined(MODE_MIP) && !defined(VOLUMES) && defined(FOCUS_EFFECTS)
  gl_FragDepth = 0.5 + 0.5 * result.x;
#endif
}
