// A translation: Brunet, Nowak and Gleicher 2006 §6.2 measure what any deformation costs by it.
//
// Worked by hand, offset (0.1, −0.2, 0): u(0, 0, 0) = (−0.1, 0.2, 0), u(0.1, 0, 0) = (0, 0.2, 0), u(0.5, 0.5, 0.5) = (0.4, 0.7, 0.5),
// u(1, 1, 1) = (0.9, 1.2, 1), u(1.1, 0.8, 1) = (1, 1, 1).

struct ShiftMap {
  vec3 offset;  // of the displayed volume
};

// The inverse map: the point of the data shown at p, box space.
vec3 shift_texture_from_object(ShiftMap map, vec3 p) { return p - map.offset; }

// Its derivative: column j is the derivative by p_j.
mat3 shift_jacobian(ShiftMap map, vec3 p) { return mat3(real(1)); }
