// A leafer (Brunet, Nowak and Gleicher 2006, Figure 7, after McGuffin, Tancau and Balakrishnan 2003; the definition is ours:
// docs/papers/brunet.md). The volume is cut into leaves of one thickness, stacked along `axis`. All are turned about one edge
// of the box, the spine, like the pages of a book: leaf i of n by i/(n − 1) of the whole angle, away from leaf 0, which stays.
// What lies behind the spine or beside the stack is no page: nothing is shown of it.
//
// With X and Y the coordinates along toward and axis from the spine, leaf i lies at i·t ≤ Y ≤ (i + 1)·t, X ≥ 0.
//
// Worked by hand, n = 2, t = 1/2, a quarter turn, (X, Y) only: (0.8, 0.2) is in leaf 0 and stays; (0.8, 0.6) is above it: nowhere;
// (−0.6, 0.8) turned back is (0.8, 0.6), in leaf 1: u = (0.8, 0.6); (−0.5, 0.3) is the corner (0.3, 0.5) of leaf 1; (−0.4, 0.5) turned
// back is (0.5, 0.4), below leaf 1: nowhere.

struct LeaferMap {
  vec3 spine;      // a point of the edge of the box
  vec3 axis;       // unit, through the stack
  vec3 toward;     // unit, from the spine across the pages
  int leaves;
  real thickness;  // of a leaf
  real step_cos;   // of the angle between two leaves
  real step_sin;
};

// Which leaf shows p: from 0; −1: none.
int leafer_piece(LeaferMap map, vec3 p) {
  real x = dot(p - map.spine, map.toward);
  real y = dot(p - map.spine, map.axis);
  int piece = -1;
  for (int i = 0; i < map.leaves; ++i) {
    real low = real(i) * map.thickness;
    if (piece < 0 && x >= real(0) && y >= low && y <= low + map.thickness) piece = i;
    real back = x * map.step_cos + y * map.step_sin;
    y = y * map.step_cos - x * map.step_sin;
    x = back;
  }
  return piece;
}

// Cosine and sine of the angle of leaf i.
vec2 leafer_turn(LeaferMap map, int leaf) {
  real c = real(1);
  real s = real(0);
  for (int i = 0; i < leaf; ++i) {
    real next = c * map.step_cos - s * map.step_sin;
    s = s * map.step_cos + c * map.step_sin;
    c = next;
  }
  return vec2(c, s);
}

// The inverse map: the point of the data shown at p, box space.
vec3 leafer_texture_from_object(LeaferMap map, vec3 p) {
  int piece = leafer_piece(map, p);
  if (piece < 0) return nowhere(p);
  vec2 turn = leafer_turn(map, piece);
  real x = dot(p - map.spine, map.toward);
  real y = dot(p - map.spine, map.axis);
  return p + (x * turn.x + y * turn.y - x) * map.toward + (y * turn.x - x * turn.y - y) * map.axis;
}

// Its derivative: column j is the derivative by p_j.
mat3 leafer_jacobian(LeaferMap map, vec3 p) {
  int piece = leafer_piece(map, p);
  if (piece < 0) return mat3(real(1));
  vec2 turn = leafer_turn(map, piece);
  return plane_jacobian(map.toward, map.axis, vec2(turn.x, turn.y), vec2(-turn.y, turn.x));
}
