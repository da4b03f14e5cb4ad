// A pulsing fisheye in a sphere of influence (Brunet, Nowak and Gleicher 2006 §5.2). Distances from the centre follow the
// Hermite cubic with g(0) = 0, g'(0) = 1/m, g(R) = R, g'(R) = 1. With x = r/R it is g = r·(1 + (1/m − 1)(1 − x)²).
//
// Its slope 1 + (1/m − 1)(1 − x)(1 − 3x) is smallest at x = 2/3, where it is 1 − (1/m − 1)/3: positive for m > 1/4.
//
// Worked by hand, centre (1/2, 1/2, 1/2), R = 0.4, m = 2, on the line through the centre along x: g(0) = 0; g(0.1): x = 1/4, factor
// 1 − 9/32 = 23/32: u_x = 0.5 + 0.071875; g(0.2): factor 1 − 1/8: u_x = 0.675; g(0.3): factor 1 − 1/32: u_x = 0.790625; g(0.4) = 0.4.

struct PulseMap {
  vec3 center;
  real radius;        // R of the sphere of influence
  real minification;  // 1/m of this moment, at the centre
};

// The inverse map: the point of the data shown at p, box space. The identity outside the sphere.
vec3 pulse_texture_from_object(PulseMap map, vec3 p) {
  vec3 q = p - map.center;
  real rest = max(real(1) - length(q) / map.radius, real(0));
  return p + ((map.minification - real(1)) * rest * rest) * q;
}

// Its derivative: column j is the derivative by p_j.
mat3 pulse_jacobian(PulseMap map, vec3 p) {
  vec3 q = p - map.center;
  real r = length(q);
  real rest = max(real(1) - r / map.radius, real(0));
  real strength = map.minification - real(1);
  return mat3(real(1) + strength * rest * rest) -
         outerProduct(q, (real(2) * strength * rest / (map.radius * max(r, real(1e-20)))) * q);
}
