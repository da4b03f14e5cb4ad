// One pixel of a picture under a lens. WARP_FRAGMENT evaluates the lens here; WARP_LOOKUP reads where to look from a
// table of displacements (LaMar 2001 §6, dependent texture); otherwise the homogeneous coordinate is divided.
// FILTER_LINEAR_EXACT weighs the four texels in float, where drivers filter with weights of 8 bits.

#include "generated/warps.glsl"
#include "gpu/warp.glsl"

uniform sampler2D image_texture;
#ifdef WARP_LOOKUP
uniform sampler2D warp_table;
uniform vec4 table_from_picture;  // table coordinate = xy · t + zw
#endif

in vec3 homogeneous_coordinate;
out vec4 result;

#ifdef FILTER_LINEAR_EXACT
vec4 image_at(vec2 t) {
  ivec2 size = textureSize(image_texture, 0);
  vec2 position = clamp(t * vec2(size) - 0.5, vec2(-0.5), vec2(size) - 0.5);
  vec2 lower = floor(position);
  vec2 f = position - lower;
  ivec2 last = size - 1;
  ivec2 a = clamp(ivec2(lower), ivec2(0), last);
  ivec2 b = clamp(ivec2(lower) + 1, ivec2(0), last);
  vec4 top = mix(texelFetch(image_texture, a, 0), texelFetch(image_texture, ivec2(b.x, a.y), 0), f.x);
  vec4 bottom = mix(texelFetch(image_texture, ivec2(a.x, b.y), 0), texelFetch(image_texture, b, 0), f.x);
  return mix(top, bottom, f.y);
}
#else
vec4 image_at(vec2 t) { return texture(image_texture, t); }
#endif

void main() {
#if defined(WARP_FRAGMENT)
  vec3 u = texture_from_object(vec3(homogeneous_coordinate.xy, 0.5));
  if (any(lessThan(u.xy, vec2(0.0))) || any(greaterThan(u.xy, vec2(1.0)))) discard;
  result = image_at(u.xy);
#elif defined(WARP_LOOKUP)
  vec2 t = homogeneous_coordinate.xy;
  vec2 u = t + texture(warp_table, table_from_picture.xy * t + table_from_picture.zw).rg;
  if (any(lessThan(u, vec2(0.0))) || any(greaterThan(u, vec2(1.0)))) discard;
  result = image_at(u);
#else
  result = image_at(homogeneous_coordinate.xy / homogeneous_coordinate.z);
#endif
}
