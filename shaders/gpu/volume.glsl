// The volume and the transfer function as textures.
//
// FILTER_LINEAR_EXACT takes the eight voxels one by one and weighs them in float, where drivers filter with weights
// of 8 bits. FILTER_CUBIC takes the 64 voxels of the cubic B-spline by eight fetches of a texture that filters linearly
// (lib/cubic.glsl); a fetch beyond the edge clamps both its voxels, as the filter of 64 would clamp each. Otherwise the
// texture's own filter (nearest or linear) is used. PAGED: the texture is a pool of bricks (gpu/pages.glsl).

uniform vec2 value_from_texel;  // data value = x · texel + y

#ifdef FILTER_LINEAR_EXACT
vec4 texel_at(sampler3D voxels, ivec3 i, ivec3 last) { return texelFetch(voxels, clamp(i, ivec3(0), last), 0); }
#endif

#ifdef FILTER_CUBIC
#include "lib/cubic.glsl"

// The two fetches of one axis: their places, in texture coordinates, and the share of the second.
vec3 cubic_axis(float t, float size) {
  float position = t * size - 0.5;
  float lower = floor(position);
  vec4 fetches = cubic_fetches(position - lower);
  return vec3((vec2(lower + 0.5) + fetches.xy) / size, fetches.w);
}
#endif

// Linear between eight texels of a texture that filters linearly, or with FILTER_LINEAR_EXACT of any.
vec4 linear_texels(sampler3D voxels, vec3 t) {
#ifdef FILTER_LINEAR_EXACT
  ivec3 size = textureSize(voxels, 0);
  vec3 position = clamp(t * vec3(size) - 0.5, vec3(-0.5), vec3(size) - 0.5);
  vec3 lower = floor(position);
  vec3 f = position - lower;
  ivec3 i = ivec3(lower);
  ivec3 last = size - 1;
  vec4 v00 = mix(texel_at(voxels, i, last), texel_at(voxels, i + ivec3(1, 0, 0), last), f.x);
  vec4 v10 = mix(texel_at(voxels, i + ivec3(0, 1, 0), last), texel_at(voxels, i + ivec3(1, 1, 0), last), f.x);
  vec4 v01 = mix(texel_at(voxels, i + ivec3(0, 0, 1), last), texel_at(voxels, i + ivec3(1, 0, 1), last), f.x);
  vec4 v11 = mix(texel_at(voxels, i + ivec3(0, 1, 1), last), texel_at(voxels, i + ivec3(1, 1, 1), last), f.x);
  return mix(mix(v00, v10, f.y), mix(v01, v11, f.y), f.z);
#else
  return textureLod(voxels, t, 0.0);
#endif
}

// What the texture holds at t: values in its own unit, which filtering leaves alone.
vec4 filtered_texels(sampler3D voxels, vec3 t) {
#if defined(FILTER_CUBIC)
  vec3 size = vec3(textureSize(voxels, 0));
  vec3 x = cubic_axis(t.x, size.x);
  vec3 y = cubic_axis(t.y, size.y);
  vec3 z = cubic_axis(t.z, size.z);
#define FETCH(a, b, c) textureLod(voxels, vec3(a, b, c), 0.0)
  vec4 v00 = mix(FETCH(x.x, y.x, z.x), FETCH(x.y, y.x, z.x), x.z);
  vec4 v10 = mix(FETCH(x.x, y.y, z.x), FETCH(x.y, y.y, z.x), x.z);
  vec4 v01 = mix(FETCH(x.x, y.x, z.y), FETCH(x.y, y.x, z.y), x.z);
  vec4 v11 = mix(FETCH(x.x, y.y, z.y), FETCH(x.y, y.y, z.y), x.z);
#undef FETCH
  return mix(mix(v00, v10, y.z), mix(v01, v11, y.z), z.z);
#else
  return linear_texels(voxels, t);
#endif
}

float filtered_texel(sampler3D voxels, vec3 t) { return filtered_texels(voxels, t).r; }

#if defined(LEVELS) && LEVELS > 1
#include "lib/levels.glsl"
#endif
#if defined(PAGED)
#include "gpu/pages.glsl"
#elif defined(LEVELS)
#include "gpu/levels.glsl"
#else
uniform sampler3D volume_texture;
float sample_texel(vec3 t) { return filtered_texel(volume_texture, t); }
#endif

// The data at a point, as texel and as value; points are the data's own.
float displayed_texel(vec3 t) { return sample_texel(t); }
float displayed_value(vec3 t) { return value_from_texel.x * displayed_texel(t) + value_from_texel.y; }
