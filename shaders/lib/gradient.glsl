// Gradients by differences, taken where the picture is sampled (Brunet, Nowak and Gleicher 2006, eq. 1).
// The host provides: real gradient_value(vec3 p), the value that is differentiated, at p in [0,1]³: the data at p, or
// what is shown at p (render.gradient_space).
//
// `h` is the size of one voxel in texture coordinates. The result is the derivative by texture coordinates.

vec3 forward_gradient(vec3 p, vec3 h) {
  real here = gradient_value(p);
  return vec3(gradient_value(p + vec3(h.x, real(0), real(0))) - here,
              gradient_value(p + vec3(real(0), h.y, real(0))) - here,
              gradient_value(p + vec3(real(0), real(0), h.z)) - here) / h;
}

vec3 central_gradient(vec3 p, vec3 h) {
  return vec3(gradient_value(p + vec3(h.x, real(0), real(0))) - gradient_value(p - vec3(h.x, real(0), real(0))),
              gradient_value(p + vec3(real(0), h.y, real(0))) - gradient_value(p - vec3(real(0), h.y, real(0))),
              gradient_value(p + vec3(real(0), real(0), h.z)) - gradient_value(p - vec3(real(0), real(0), h.z))) /
         (real(2) * h);
}
