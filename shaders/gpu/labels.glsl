// LABELS: classification of a sample by the transfer function of the object in whose voxel it lies.

#ifdef LABELS
#include "lib/labels.glsl"

uniform usampler3D label_texture;  // rows of the table
uniform sampler2D label_table;     // a row for each label: its transfer function, straight colour and opacity
uniform sampler2D label_rows;      // two texels for each: texel position in label_table = x · value + y, last texel, and
                                   // the factor of its reference length; then its mode (lib/two_level.glsl)

int label_row(vec3 t) {
#ifdef PAGED
  ivec3 size = ivec3(level_voxels[0].xyz);
#else
  ivec3 size = textureSize(label_texture, 0);
#endif
  ivec3 voxel = ivec3(label_voxel(t.x, size.x), label_voxel(t.y, size.y), label_voxel(t.z, size.z));
#ifdef PAGED
  vec3 place = page_of(vec3(voxel) + 0.5, 0).xyz;
  voxel = place.x > no_place ? ivec3(0) : voxel + ivec3(place);
#endif
  return int(texelFetch(label_texture, voxel, 0).r);
}

int label_mode(int row) { return int(texelFetch(label_rows, ivec2(1, row), 0).r + 0.5); }

// Opacity per the scene's reference length. Two texels are weighed here: a filter of the texture might mix rows.
vec4 classify_row(int row, float value) {
  vec4 info = texelFetch(label_rows, ivec2(0, row), 0);
  float position = clamp(info.x * value + info.y, 0.0, info.z);
  int lower = min(int(position), int(info.z) - 1);
  vec4 a = texelFetch(label_table, ivec2(lower, row), 0);
  vec4 b = texelFetch(label_table, ivec2(lower + 1, row), 0);
  vec4 color = mix(a, b, position - float(lower));
  if (info.w != 1.0) color.a = corrected_opacity(color.a, info.w);
  return color;
}

vec4 classify_at(vec3 t) { return classify_row(label_row(t), displayed_value(t)); }
#endif
