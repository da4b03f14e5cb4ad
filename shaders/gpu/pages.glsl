// The volume in a pool of bricks (PAGED; docs/bricks.md). A level of L voxels is cut into pages of `edge` voxels; each page that
// is loaded lies somewhere in the pool with so many voxels of its neighbours around it that filters and the taps of gradients
// stay within it. The page of a sample is that of the voxel it lies in, half a voxel away from where its filter would end.

uniform sampler3D volume_texture;  // the pool
uniform sampler3D page_texture;    // for each page what to add to a voxel coordinate of its level for its place in the pool.
                                   // Absent pages have no such place (x above no_place) and read w everywhere
uniform vec3 texture_from_pool;    // one over the pool's voxels
uniform float pages_from_voxels;   // one over the edge of a page
uniform vec4 level_voxels[LEVELS]; // voxels of a level in one unit of texture coordinates: N/2^level
uniform vec4 level_pages[LEVELS];  // last page on each axis; where its pages begin along z of the table

const float no_place = 1.0e9;

vec4 page_of(vec3 voxel, int level) {
  vec3 page = min(floor(voxel * pages_from_voxels), level_pages[level].xyz);
  return texelFetch(page_texture, ivec3(page) + ivec3(0, 0, int(level_pages[level].w)), 0);
}

vec4 page_texels(vec4 page, vec3 voxel) {
  vec4 texels = filtered_texels(volume_texture, (voxel + page.xyz) * texture_from_pool);
  return page.x > no_place ? vec4(page.w) : texels;
}

// Beyond the volume: its edge.
vec3 voxel_of(vec3 t, int level) { return clamp(t, 0.0, 1.0) * level_voxels[level].xyz; }

#if LEVELS > 1
#include "gpu/level_choice.glsl"

// The level below and the next coarser one, which has the weight.
int lower_level() { return min(int(sample_level), LEVELS - 2); }
float upper_weight() { return sample_level - float(lower_level()); }

float sample_texel(vec3 t) {
  int level = lower_level();
  vec3 lower = voxel_of(t, level);
  vec3 upper = voxel_of(t, level + 1);
  float a = page_texels(page_of(lower, level), lower).r;
  float b = page_texels(page_of(upper, level + 1), upper).r;
  return mix(a, b, upper_weight());
}
#else
float sample_texel(vec3 t) {
  vec3 voxel = voxel_of(t, 0);
  return page_texels(page_of(voxel, 0), voxel).r;
}
vec4 sample_texels(vec3 t) {
  vec3 voxel = voxel_of(t, 0);
  return page_texels(page_of(voxel, 0), voxel);
}
#endif

// A gradient takes all its taps in the page of its middle, which holds what they need.
vec4 held_page;
#if LEVELS > 1
vec4 held_upper;
#endif

void hold_page(vec3 t) {
#if LEVELS > 1
  int level = lower_level();
  held_page = page_of(voxel_of(t, level), level);
  held_upper = page_of(voxel_of(t, level + 1), level + 1);
#else
  held_page = page_of(voxel_of(t, 0), 0);
#endif
}

float held_texel(vec3 t) {
#if LEVELS > 1
  int level = lower_level();
  float a = page_texels(held_page, t * level_voxels[level].xyz).r;
  float b = page_texels(held_upper, t * level_voxels[level + 1].xyz).r;
  return mix(a, b, upper_weight());
#else
  return page_texels(held_page, t * level_voxels[0].xyz).r;
#endif
}
