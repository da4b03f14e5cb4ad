// A sine wave (Brunet, Nowak and Gleicher 2006, Figure 3 and Table 1): points move along one axis by a sine of another
// coordinate. A shear, so it never folds.
//
// Worked by hand, axis x, along z, amplitude 0.1, wavelength 1/2 (wave number 4π), phase 0: at (0.5, 0.5, 0) the sine is 0:
// u = (0.5, 0.5, 0); at z = 1/8 it is 1: (0.4, 0.5, 0.125); at z = 1/4: (0.5, 0.5, 0.25); at z = 3/8 it is −1: (0.6, 0.5, 0.375); at
// z = 1/24 it is 1/2: (0.45, 0.5, 1/24).

struct SineMap {
  vec3 axis;         // unit: points move along it
  vec3 along;        // unit: by the coordinate along this
  real amplitude;
  real wave_number;  // 2π/λ
  real phase;        // radians
};

// The inverse map: the point of the data shown at p, box space.
vec3 sine_texture_from_object(SineMap map, vec3 p) {
  return p - (map.amplitude * sin(dot(p, map.along) * map.wave_number + map.phase)) * map.axis;
}

// Its derivative: column j is the derivative by p_j.
mat3 sine_jacobian(SineMap map, vec3 p) {
  real slope = map.amplitude * map.wave_number * cos(dot(p, map.along) * map.wave_number + map.phase);
  return mat3(real(1)) - outerProduct(map.axis, slope * map.along);
}
