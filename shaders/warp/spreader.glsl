// A spreader, after the hinge spreader that McGuffin, Tancau and Balakrishnan 2003 name (the definition is ours:
// docs/papers/brunet.md). Above the hinge line, on the side that `toward` points to, the volume is cut along the plane
// through the centre across `axis`. Both sides are pushed half the gap away, then opened like a book: about the hinge line
// the quarter from 0 to 90 degrees beside the cut is squeezed into that from half the angle to 90 degrees, radii kept. Below
// the hinge nothing moves; nothing is pushed over anything else.
//
// Worked by hand, toward z, axis x, centre (1/2, 1/2, 1/2), half angle 45 degrees (squeeze 2), no gap, coordinates (x, z) from
// the centre: (0, 0.4) lies in the wedge: nowhere; (0.3, 0.3) at 45 degrees is the cut's face: u = (0, 0.3√2); (0.4, 0) stays; at 67.5
// degrees, radius 0.4: u at 45 degrees: (0.2√2, 0.2√2), with the other sign of x on the other side; (0.2, −0.3) stays.

struct SpreaderMap {
  vec3 center;      // on the hinge line
  vec3 axis;        // unit, across the cut
  vec3 toward;      // unit, out of the cut
  real half_gap;
  real half_angle;  // radians
  real squeeze;     // (π/2)/(π/2 − half_angle)
};

// Which piece shows p: 0 below the hinge, 1 and 2 the two sides, −1 none.
int spreader_piece(SpreaderMap map, vec3 p) {
  vec3 q = p - map.center;
  real x = dot(q, map.toward);
  real y = dot(q, map.axis);
  if (x <= real(0)) return 0;
  real beside = abs(y) - map.half_gap;
  if (beside < real(0) || beside * cos(map.half_angle) < x * sin(map.half_angle)) return -1;
  return y < real(0) ? 2 : 1;
}

// The inverse map: the point of the data shown at p, box space.
vec3 spreader_texture_from_object(SpreaderMap map, vec3 p) {
  int piece = spreader_piece(map, p);
  if (piece == 0) return p;
  if (piece < 0) return nowhere(p);
  vec3 q = p - map.center;
  real x = dot(q, map.toward);
  real y = dot(q, map.axis);
  real beside = abs(y) - map.half_gap;
  real r = length(vec2(x, beside));
  real angle = max((polar_angle(beside, x) - map.half_angle) * map.squeeze, real(0));
  real uy = r * sin(angle);
  return p + (r * cos(angle) - x) * map.toward + ((piece == 2 ? -uy : uy) - y) * map.axis;
}

// Its derivative: column j is the derivative by p_j. Of e and f, the directions along the radius and about the hinge: f is
// stretched by the squeeze.
mat3 spreader_jacobian(SpreaderMap map, vec3 p) {
  int piece = spreader_piece(map, p);
  if (piece <= 0) return mat3(real(1));
  vec3 q = p - map.center;
  real side = piece == 2 ? real(-1) : real(1);
  real x = dot(q, map.toward);
  real beside = abs(dot(q, map.axis)) - map.half_gap;
  real r = max(length(vec2(x, beside)), real(1e-20));
  real c = x / r;
  real s = beside / r;
  real angle = max((polar_angle(beside, x) - map.half_angle) * map.squeeze, real(0));
  real uc = cos(angle);
  real us = sin(angle);
  real k = map.squeeze;
  return plane_jacobian(map.toward, map.axis, vec2(uc * c + k * us * s, side * (uc * s - k * us * c)),
                        vec2(side * (us * c - k * uc * s), us * s + k * uc * c));
}
