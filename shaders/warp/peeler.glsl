// A peeler, after the one that McGuffin, Tancau and Balakrishnan 2003 name (the definition is ours: docs/papers/brunet.md). The
// layer on the side that `toward` points to, from the plane through the centre on, is cut off what lies below it, as far as it
// lies beyond the centre along `axis`. It is rolled up: first along an arc of the radius R about an axis at the distance R, then
// straight on. What is below stays, and what the layer uncovers is empty.
//
// Worked by hand, R = 1, angle 90 degrees, X and Y from the centre along toward and axis: (0.2, −0.5) and (−0.2, 0.5) stay; with
// r = |(1 − X, Y)|: (0.5, 0.5) has r = √½ at 45 degrees: u = (1 − √½, π/4); (1, 0.8) at 90 degrees, an end: u = (0.2, π/2); straight on
// from there (1.3, 0.8): u = (0.2, π/2 + 0.3); (0.1, 0.9) has r > 1: in the gap, nowhere.

struct PeelerMap {
  vec3 center;
  vec3 axis;     // unit, along the layer
  vec3 toward;   // unit, out of it
  real radius;   // R
  real angle;    // radians, of the arc
  real end_cos;  // of the angle
  real end_sin;
};

// Where the layer's data is that is shown at p, (X, Y), and cosine and sine of the turn there.
struct PeelerPlace {
  int piece;  // 0: what stays, 1: the layer, −1: nothing is shown
  vec2 data;
  vec2 turn;
  real r;     // distance from the arc's axis over R beside the arc, 1 beside the straight part
};

PeelerPlace peeler_place(PeelerMap map, vec3 p) {
  vec3 q = p - map.center;
  real x = dot(q, map.toward);
  real y = dot(q, map.axis);
  PeelerPlace place;
  place.piece = 0;
  place.data = vec2(x, y);
  place.turn = vec2(real(1), real(0));
  place.r = real(1);
  if (x < real(0) || (y < real(0) && x < map.radius)) return place;
  real arm = map.radius - x;
  real angle = polar_angle(y, arm);
  if (angle < real(0)) angle += real(6.283185307179586);
  if (angle <= map.angle) {
    real r = max(length(vec2(arm, y)), real(1e-20));
    place.data = vec2(map.radius - r, map.radius * angle);
    place.turn = vec2(arm, y) / r;
    place.r = r / map.radius;
  } else {
    place.data = vec2(map.radius - arm * map.end_cos - y * map.end_sin,
                      map.radius * map.angle + y * map.end_cos - arm * map.end_sin);
    place.turn = vec2(map.end_cos, map.end_sin);
  }
  place.piece = place.data.x < real(0) || place.data.x >= map.radius ? -1 : 1;
  return place;
}

int peeler_piece(PeelerMap map, vec3 p) { return peeler_place(map, p).piece; }

// The inverse map: the point of the data shown at p, box space.
vec3 peeler_texture_from_object(PeelerMap map, vec3 p) {
  PeelerPlace place = peeler_place(map, p);
  if (place.piece < 0) return nowhere(p);
  if (place.piece == 0) return p;
  vec3 q = p - map.center;
  return p + (place.data.x - dot(q, map.toward)) * map.toward + (place.data.y - dot(q, map.axis)) * map.axis;
}

// Its derivative: column j is the derivative by p_j.
mat3 peeler_jacobian(PeelerMap map, vec3 p) {
  PeelerPlace place = peeler_place(map, p);
  if (place.piece <= 0) return mat3(real(1));
  return plane_jacobian(map.toward, map.axis, vec2(place.turn.x, -place.turn.y),
                        vec2(place.turn.y, place.turn.x) / place.r);
}
