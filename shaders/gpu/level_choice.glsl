// Which level of a pyramid the sample at work reads (LEVELS above 1).

uniform float log_zoom;

// Of the sample at work; gradients take all their taps at it, with a step of one voxel of it.
float sample_level = float(LEVELS - 1);
void choose_level(float q) { sample_level = level_of(q, float(LEVELS - 1), log_zoom); }
vec3 level_step(vec3 voxel) { return voxel * exp2(sample_level); }
