// Maps of the plane of two perpendicular unit vectors e and f.

// atan(y, x), from −π to π. Drivers compute atan to some 1e-5; one step of Newton's method brings it to rounding.
real polar_angle(real y, real x) {
  real angle = atan(y, x);
  real c = cos(angle);
  real s = sin(angle);
  return angle + (y * c - x * s) / max(x * c + y * s, real(1e-30));
}

// The derivative of a map that keeps everything across the plane: `toe` is the derivative of the coordinate along e by
// the coordinates along e and f, `tof` that of the coordinate along f.
mat3 plane_jacobian(vec3 e, vec3 f, vec2 toe, vec2 tof) {
  return mat3(real(1)) + outerProduct(e, (toe.x - real(1)) * e + toe.y * f) +
         outerProduct(f, tof.x * e + (tof.y - real(1)) * f);
}

// Far outside the volume, beyond what any warp brings back: what is looked at where a cut leaves a gap. A translation,
// so that its derivative is the identity.
vec3 nowhere(vec3 p) { return p + vec3(real(1024)); }
