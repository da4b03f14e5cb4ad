// A volume of voxels that were classified before the upload: associated colours, their opacity already corrected for the
// slice distance. `volume_texture` is declared in gpu/volume.glsl.
//
// Interpolating associated colours is what keeps transparent voxels' colours out of the picture. With FILTER_LINEAR_EXACT
// the eight texels are weighed in float; the driver's own filter of an 8-bit texture may return 8 bits (llvmpipe does).

#ifdef CLASSIFICATION_PRE
#ifdef FILTER_LINEAR_EXACT
vec4 color_at(ivec3 i, ivec3 last) { return texelFetch(volume_texture, clamp(i, ivec3(0), last), 0); }
#endif

vec4 classified_sample(vec3 t) {
#ifdef FILTER_LINEAR_EXACT
  ivec3 size = textureSize(volume_texture, 0);
  vec3 position = clamp(t * vec3(size) - 0.5, vec3(-0.5), vec3(size) - 0.5);
  vec3 lower = floor(position);
  vec3 f = position - lower;
  ivec3 i = ivec3(lower);
  ivec3 last = size - 1;
  vec4 v00 = mix(color_at(i, last), color_at(i + ivec3(1, 0, 0), last), f.x);
  vec4 v10 = mix(color_at(i + ivec3(0, 1, 0), last), color_at(i + ivec3(1, 1, 0), last), f.x);
  vec4 v01 = mix(color_at(i + ivec3(0, 0, 1), last), color_at(i + ivec3(1, 0, 1), last), f.x);
  vec4 v11 = mix(color_at(i + ivec3(0, 1, 1), last), color_at(i + ivec3(1, 1, 1), last), f.x);
  return mix(mix(v00, v10, f.y), mix(v01, v11, f.y), f.z);
#else
  return texture(volume_texture, t);
#endif
}
#endif
