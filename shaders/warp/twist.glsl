// A twist about an axis (Brunet, Nowak and Gleicher 2006 §3.3): each plane across the axis is turned by an angle in
// proportion to its distance from the centre. It keeps volumes.
//
// Worked by hand, axis z, centre (1/2, 1/2, 1/2), a turn of π for each unit: at z = 1/2 nothing turns: u(1, 1/2, 1/2) = (1, 1/2, 1/2);
// at z = 1 the data looked at is a quarter turn back: u(1, 1/2, 1) = (1/2, 0, 1), u(1/2, 1, 1) = (1, 1/2, 1); at z = 0 a quarter turn
// on: u(1, 1/2, 0) = (1/2, 1, 0); on the axis u(1/2, 1/2, 0.9) = (1/2, 1/2, 0.9).

struct TwistMap {
  vec3 center;
  vec3 axis;  // unit
  real turn;  // radians for each unit along the axis, right-handed
};

// q turned about the axis (Rodrigues' formula).
vec3 twist_turned(TwistMap map, vec3 q, real angle) {
  vec3 along = dot(q, map.axis) * map.axis;
  return along + cos(angle) * (q - along) + sin(angle) * cross(map.axis, q);
}

// The inverse map: the point of the data shown at p, box space.
vec3 twist_texture_from_object(TwistMap map, vec3 p) {
  vec3 q = p - map.center;
  return map.center + twist_turned(map, q, -map.turn * dot(q, map.axis));
}

// Its derivative: column j is the derivative by p_j. A turn, and what the change of its angle along the axis adds.
mat3 twist_jacobian(TwistMap map, vec3 p) {
  vec3 q = p - map.center;
  real angle = -map.turn * dot(q, map.axis);
  mat3 turned = mat3(twist_turned(map, vec3(real(1), real(0), real(0)), angle),
                     twist_turned(map, vec3(real(0), real(1), real(0)), angle),
                     twist_turned(map, vec3(real(0), real(0), real(1)), angle));
  vec3 by_angle = cross(map.axis, twist_turned(map, q, angle));
  return turned - outerProduct(by_angle, map.turn * map.axis);
}
