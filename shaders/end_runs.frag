// Last pass of local modes in slices: ends the run that is under way at each pixel.

#include "lib/composite.glsl"
#include "lib/two_level.glsl"
#include "gpu/carried_run.glsl"

uniform float xray_scale;
out vec4 result;

void main() { result = ended_run(carried_state(carried_run_here()), xray_scale).gathered; }
