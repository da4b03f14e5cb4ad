// A bend (Brunet, Nowak and Gleicher 2006 §3.3): a piece of the length L about the centre, along `axis`, becomes an arc
// about an axis that lies the distance 1/k away in the direction `toward`; beyond its ends the data goes on straight.
//
// With X and Y the coordinates along toward and axis from the centre, ρ the signed distance from the arc's axis and θ the
// angle about it, the data is at (1/k − ρ, θ/k). Written so that nothing cancels for small k: with r = |(1 − kX, kY)|,
// 1/k − ρ = (1 − r)/k = (2X − k(X² + Y²))/(1 + r).
//
// Worked by hand, k = 1, L = π, so that the ends are at θ = ±π/2, (X, Y) only: u(0, 0) = (0, 0); u(1/2, 0) = (1/2, 0); u(1 − √½, √½) =
// (0, π/4); u(1, 1) = (0, π/2), an end of the piece; u(1, 1/2) = (1/2, π/2); beyond that end, straight on: u(1.25, 1) = (0, π/2 + 1/4).

struct BendMap {
  vec3 center;
  vec3 axis;         // unit, along the piece
  vec3 toward;       // unit, where its ends go
  real curvature;    // k, radians for each unit; may be negative
  real half_length;  // L/2
  real end_cos;      // of the half angle kL/2
  real end_sin;
  real end_rise;     // (1 − cos(kL/2))/k, in the limit 0 for k = 0
  real end_run;      // sin(kL/2)/k, in the limit L/2
};

// Whether the point is beside the straight part that begins at the end where Y is positive (1), negative (−1), or beside
// the arc (0).
real bend_end(BendMap map, real x, real y) {
  real angle = polar_angle(map.curvature * y, real(1) - map.curvature * x);
  if (abs(angle) <= abs(map.curvature) * map.half_length) return real(0);
  return y < real(0) ? real(-1) : real(1);
}

// The inverse map: the point of the data shown at p, box space.
vec3 bend_texture_from_object(BendMap map, vec3 p) {
  if (map.curvature == real(0)) return p;
  vec3 q = p - map.center;
  real x = dot(q, map.toward);
  real y = dot(q, map.axis);
  real k = map.curvature;
  real end = bend_end(map, x, y);
  real ux = x * map.end_cos + map.end_rise - end * y * map.end_sin;
  real uy = end * (map.half_length - map.end_run) + y * map.end_cos + end * x * map.end_sin;
  if (end == real(0)) {
    ux = (real(2) * x - k * (x * x + y * y)) / (real(1) + length(vec2(real(1) - k * x, k * y)));
    uy = polar_angle(k * y, real(1) - k * x) / k;
  }
  return p + (ux - x) * map.toward + (uy - y) * map.axis;
}

// Its derivative: column j is the derivative by p_j.
mat3 bend_jacobian(BendMap map, vec3 p) {
  if (map.curvature == real(0)) return mat3(real(1));
  vec3 q = p - map.center;
  real x = dot(q, map.toward);
  real y = dot(q, map.axis);
  real end = bend_end(map, x, y);
  real c = map.end_cos;
  real s = end * map.end_sin;
  real r = real(1);
  if (end == real(0)) {
    vec2 arm = vec2(real(1) - map.curvature * x, map.curvature * y);
    r = max(length(arm), real(1e-20));
    c = arm.x / r;
    s = arm.y / r;
  }
  return plane_jacobian(map.toward, map.axis, vec2(c, -s), vec2(s, c) / r);
}
