// From a sample of a slice to the one before it on the same ray: on the plane nearer to the eye.

uniform vec3 sample_step;    // orthographic: texture coordinates
uniform vec3 eye_place;      // perspective: the eye, texture coordinates
uniform vec4 step_of_depth;  // perspective: depth in slice distances = dot(xyz, p) + w

vec3 step_to_eye(vec3 p) {
#ifdef PERSPECTIVE
  return (eye_place - p) / (dot(step_of_depth.xyz, p) + step_of_depth.w);
#else
  return sample_step;
#endif
}
