// A sphere expander, after the one that McGuffin, Tancau and Balakrishnan 2003 name (the definition is ours:
// docs/papers/brunet.md). The centre is pushed open into an empty ball of radius r_0; what lay within the radius R is squeezed
// into the shell from r_0 to R: data distance R(r − r_0)/(R − r_0).
//
// Worked by hand, centre (1/2, 1/2, 1/2), r_0 = 0.1, R = 0.3, on the line through the centre along x: 0.05 is in the ball: nowhere; 0.1
// shows the centre; 0.2 shows 0.15; 0.25 shows 0.225; 0.3 and beyond show themselves.

struct ExpanderMap {
  vec3 center;
  real opening;  // r_0
  real radius;   // R
};

// −1 in the empty ball, else 0.
int expander_piece(ExpanderMap map, vec3 p) { return length(p - map.center) < map.opening ? -1 : 0; }

// The inverse map: the point of the data shown at p, box space.
vec3 expander_texture_from_object(ExpanderMap map, vec3 p) {
  vec3 q = p - map.center;
  real r = length(q);
  if (r < map.opening) return nowhere(p);
  if (r >= map.radius) return p;
  real distance = map.radius * (r - map.opening) / (map.radius - map.opening);
  return map.center + (distance / max(r, real(1e-20))) * q;
}

// Its derivative: column j is the derivative by p_j.
mat3 expander_jacobian(ExpanderMap map, vec3 p) {
  vec3 q = p - map.center;
  real r = length(q);
  if (r < map.opening || r >= map.radius || map.opening == real(0)) return mat3(real(1));
  real slope = map.radius / (map.radius - map.opening);
  real ratio = slope * (r - map.opening) / r;
  return mat3(ratio) + outerProduct(q, ((slope - ratio) / (r * r)) * q);
}
