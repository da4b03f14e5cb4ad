// render.footprint "mip": FOOTPRINT with LEVELS above 1. The level of a sample from the spacing of samples in the data
// (Brunet, Nowak and Gleicher 2006 §3.2): the matrix d(voxel index)/d(pixel, sample) is d(voxel index)/d(texture) times the
// map's Jacobian times the steps from sample to sample where the volume is shown (src/render/footprint.h).

#ifdef FOOTPRINT
uniform mat3 sample_steps;       // columns: one pixel to the right, one up, both per unit of scale; one sample ahead
uniform vec4 sample_step_scale;  // of the first two at p: dot(xyz, p) + w
uniform vec3 volume_voxels;

mat3 scaled_rows(vec3 s, mat3 m) { return mat3(s * m[0], s * m[1], s * m[2]); }

// Where the volume is shown, texture coordinates.
mat3 steps_shown(vec3 p) {
  float scale = max(dot(sample_step_scale.xyz, p) + sample_step_scale.w, 0.0);
  return mat3(scale * sample_steps[0], scale * sample_steps[1], sample_steps[2]);
}

// In the data, texture coordinates: the pipeline's own map, but `tessellated` has the exact one, as for light.
mat3 steps_in_data(vec3 p) {
#if defined(AXIS_TABLES)
  return axis_jacobian(p) * steps_shown(p);
#elif defined(WARPED)
  return scaled_rows(1.0 / box_size, chain_jacobian(p * box_size) * scaled_rows(box_size, steps_shown(p)));
#else
  return steps_shown(p);
#endif
}

void choose_footprint_level(vec3 p) {
  sample_level = footprint_level(scaled_rows(volume_voxels, steps_in_data(p)), float(LEVELS - 1));
}

// Gradients take their taps at the sample's level, one voxel of it apart in the data; on display one voxel of the volume
// apart, or a step of the picture where that is longer.
float step_level(vec3 p) {
#ifdef GRADIENT_IN_OBJECT_SPACE
  return footprint_level(scaled_rows(volume_voxels, steps_shown(p)), 32.0);
#else
  return sample_level;
#endif
}
#endif
