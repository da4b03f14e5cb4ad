// A volume of voxels that were classified before the upload: associated colours, their opacity already corrected for the
// slice distance. gpu/volume.glsl has texture and filter.
//
// Interpolating associated colours is what keeps transparent voxels' colours out of the picture. With FILTER_LINEAR_EXACT
// the eight texels are weighed in float; the driver's own filter of an 8-bit texture may return 8 bits (llvmpipe does).

#if defined(CLASSIFICATION_PRE) && defined(PAGED)
vec4 classified_sample(vec3 t) { return sample_texels(t); }
#elif defined(CLASSIFICATION_PRE)
vec4 classified_sample(vec3 t) { return filtered_texels(volume_texture, t); }
#endif
