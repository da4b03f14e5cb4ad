// LaMar's magnification lens as an inverse map (LaMar, Hamann and Joy 2001; docs/papers/lamar.md), in box space.
//
// In each plane across the viewing direction points move along lines through the lens axis, from texture radius f(r) to
// radius r. m = 1/Q is the minification of the zoom region; every profile is linear in m, or rational for `simple`.
//
// Worked by hand, linear border, Q = 4, r_i = 1/2, r_o = 1: f(1/4) = 1/16 (zoom), f(1/2) = 1/8, f(3/4) = 1/8 + (1/4)(7/8)/(1/2)
// = 9/16, f(1) = 1, f(2) = 2. Cubic border: f(3/4) = (f(1/2) + f(1))/2 + (1/2)(f'(1/2) − f'(1))/8 = 9/16 − 3/64 = 33/64.

const int lamar_simple = 0;
const int lamar_linear = 1;
const int lamar_cubic = 2;

struct LamarMap {
  vec3 center;        // lens centre
  vec3 axis;          // of the lens: displacement of the axis' point for one unit of depth
  vec3 forward;       // unit, viewing direction; depths count along it
  vec3 right;         // unit, across
  vec3 up;            // unit, across
  real center_depth;  // perspective: depth of the centre below the eye; orthographic: 0 (radii do not scale)
  bool square;        // Chebyshev distance instead of Euclid's
  int border;
  real minification;  // 1/Q of the zoom region
  real inner;         // r_i, at the centre's depth
  real outer;         // r_o
  real depth_inner;   // d_i
  real depth_outer;   // d_o
};

// f and its derivatives by r and by m.
struct LamarProfile {
  real value;
  real by_radius;
  real by_minification;
};

LamarProfile lamar_profile(int border, real m, real inner, real outer, real r) {
  LamarProfile f;
  real width = outer - inner;
  real x = (r - inner) / width;
  if (r >= outer) {
    f.value = r;
    f.by_radius = real(1);
    f.by_minification = real(0);
  } else if (r <= inner) {
    f.value = r * m;
    f.by_radius = m;
    f.by_minification = r;
  } else if (border == lamar_simple) {
    // f = r/q with q from Q to 1: what one projective map gives (LaMar Fig. 2(b)).
    real q = (real(1) - x) / m + x;
    real slope = (real(1) - real(1) / m) / width;
    f.value = r / q;
    f.by_radius = (q - r * slope) / (q * q);
    f.by_minification = r * (real(1) - x) / (m * m * q * q);
  } else if (border == lamar_linear) {
    real slope = (outer - inner * m) / width;
    f.value = inner * m + (r - inner) * slope;
    f.by_radius = slope;
    f.by_minification = inner * (real(1) - x);
  } else {
    // Hermite: values inner·m and outer, slopes m and 1.
    real h00 = (real(1) + real(2) * x) * (real(1) - x) * (real(1) - x);
    real h10 = x * (real(1) - x) * (real(1) - x);
    real h01 = x * x * (real(3) - real(2) * x);
    real h11 = x * x * (x - real(1));
    real d00 = real(6) * x * (x - real(1));
    real d10 = (real(1) - x) * (real(1) - real(3) * x);
    real d11 = x * (real(3) * x - real(2));
    f.value = h00 * inner * m + h10 * width * m + h01 * outer + h11 * width;
    f.by_radius = (d00 * (inner * m - outer)) / width + d10 * m + d11;
    f.by_minification = h00 * inner + h10 * width;
  }
  return f;
}

// m on a plane at depth distance d ≥ 0 from the lens centre, and its derivative by d.
vec2 lamar_minification(LamarMap lens, real d) {
  real width = lens.depth_outer - lens.depth_inner;
  real x = clamp((d - lens.depth_inner) / width, real(0), real(1));
  real w = lens.border == lamar_cubic ? x * x * (real(3) - real(2) * x) : x;
  real slope = lens.border == lamar_cubic ? real(6) * x * (real(1) - x) : real(1);
  bool between = d > lens.depth_inner && d < lens.depth_outer;
  return vec2(mix(lens.minification, real(1), w), between ? (real(1) - lens.minification) * slope / width : real(0));
}

// Where a point is in the lens.
struct LamarPlace {
  vec3 axis_point;  // of the lens, in the point's plane
  vec3 offset;      // point − axis_point
  vec3 outward;     // derivative of the distance by the offset
  real depth;       // along forward, from the lens centre
  real scale;       // of the radii at this depth
  real radius;      // distance from the axis divided by scale
};

LamarPlace lamar_place(LamarMap lens, vec3 p) {
  LamarPlace place;
  place.depth = dot(p - lens.center, lens.forward);
  place.axis_point = lens.center + place.depth * lens.axis;
  place.offset = p - place.axis_point;
  place.scale = lens.center_depth > real(0) ? max(real(1) + place.depth / lens.center_depth, real(1e-6)) : real(1);
  real distance = length(place.offset);
  place.outward = place.offset / max(distance, real(1e-20));
  if (lens.square) {
    real x = dot(place.offset, lens.right);
    real y = dot(place.offset, lens.up);
    bool sideways = abs(x) >= abs(y);
    distance = sideways ? abs(x) : abs(y);
    place.outward = sideways ? (x < real(0) ? -lens.right : lens.right) : (y < real(0) ? -lens.up : lens.up);
  }
  place.radius = distance / place.scale;
  return place;
}

// The inverse map: the point of the data shown at p. The identity outside the lens.
vec3 lamar_texture_from_object(LamarMap lens, vec3 p) {
  LamarPlace place = lamar_place(lens, p);
  real m = lamar_minification(lens, abs(place.depth)).x;
  if (place.radius >= lens.outer || abs(place.depth) >= lens.depth_outer) {
    return p;
  }
  LamarProfile f = lamar_profile(lens.border, m, lens.inner, lens.outer, place.radius);
  real ratio = place.radius > lens.inner ? f.value / max(place.radius, real(1e-20)) : m;
  return place.axis_point + ratio * place.offset;
}

// Local tangential magnification q = r/f(r), the homogeneous weight of LaMar's vertices: 1 outside the lens.
real lamar_magnification(LamarMap lens, vec3 p) {
  LamarPlace place = lamar_place(lens, p);
  real m = lamar_minification(lens, abs(place.depth)).x;
  if (place.radius >= lens.outer || abs(place.depth) >= lens.depth_outer) {
    return real(1);
  }
  LamarProfile f = lamar_profile(lens.border, m, lens.inner, lens.outer, place.radius);
  return place.radius > lens.inner ? place.radius / f.value : real(1) / m;
}

// Its derivative: column j is the derivative by p_j. Exact; at the creases of a profile one of the two sides.
mat3 lamar_jacobian(LamarMap lens, vec3 p) {
  LamarPlace place = lamar_place(lens, p);
  mat3 identity = mat3(real(1));
  if (place.radius >= lens.outer || abs(place.depth) >= lens.depth_outer) {
    return identity;
  }
  vec2 m = lamar_minification(lens, abs(place.depth));
  LamarProfile f = lamar_profile(lens.border, m.x, lens.inner, lens.outer, place.radius);
  real r = max(place.radius, real(1e-20));
  bool zoomed = place.radius <= lens.inner;
  real ratio = zoomed ? m.x : f.value / r;
  real ratio_by_radius = zoomed ? real(0) : (f.by_radius * r - f.value) / (r * r);
  real ratio_by_minification = zoomed ? real(1) : f.by_minification / r;
  real minification_by_depth = place.depth < real(0) ? -m.y : m.y;
  real scale_by_depth = lens.center_depth > real(0) ? real(1) / lens.center_depth : real(0);

  // u = A + ratio·o with A the axis point, o = p − A; dA = axis ⊗ forward.
  mat3 axis_by_p = outerProduct(lens.axis, lens.forward);
  mat3 offset_by_p = identity - axis_by_p;
  vec3 radius_by_p = (place.outward * offset_by_p - (place.radius * scale_by_depth) * lens.forward) / place.scale;
  vec3 ratio_by_p = ratio_by_radius * radius_by_p + (ratio_by_minification * minification_by_depth) * lens.forward;
  return axis_by_p + ratio * offset_by_p + outerProduct(place.offset, ratio_by_p);
}
