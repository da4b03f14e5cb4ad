// Gradients of the displayed volume by differences, taken where the picture is sampled (Brunet eq. 1).
// The host provides: real displayed_value(vec3 p), the data value shown at p in [0,1]³.
//
// `h` is the size of one voxel in texture coordinates. The result is the derivative by texture coordinates.

vec3 forward_gradient(vec3 p, vec3 h) {
  real here = displayed_value(p);
  return vec3(displayed_value(p + vec3(h.x, real(0), real(0))) - here,
              displayed_value(p + vec3(real(0), h.y, real(0))) - here,
              displayed_value(p + vec3(real(0), real(0), h.z)) - here) / h;
}

vec3 central_gradient(vec3 p, vec3 h) {
  return vec3(displayed_value(p + vec3(h.x, real(0), real(0))) - displayed_value(p - vec3(h.x, real(0), real(0))),
              displayed_value(p + vec3(real(0), h.y, real(0))) - displayed_value(p - vec3(real(0), h.y, real(0))),
              displayed_value(p + vec3(real(0), real(0), h.z)) - displayed_value(p - vec3(real(0), real(0), h.z))) /
         (real(2) * h);
}
