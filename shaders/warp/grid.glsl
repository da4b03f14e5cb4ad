// A map held on a grid of nodes (Brunet, Nowak and Gleicher 2006 §4: deformations in a 3D texture). Each node holds the
// displacement u − p there, in box space; between nodes it is trilinear, beyond the grid's box it is that of the nearest
// point of its faces, so the map is continuous everywhere.
//
// The host gives GridRef, sample_grid(grid, x, texel) = the displacement at x ∈ [0, cells], counted in nodes, and grid_node(grid, i).
//
// Worked by hand, low = 0, high = 1, 2 nodes on each axis, displacement 0 at x = 0 and (0.1, 0, 0) at x = 1: at (0.5, 0.2,
// 0.7) u = (0.55, 0.2, 0.7) and the Jacobian has 1.1 in its corner; at (2, 0.5, 0.5), outside, u = (2.1, 0.5, 0.5) and the
// Jacobian is 1; at (−1, 0.5, 0.5) u = p; at (1, 0, 0) u = (1.1, 0, 0); at (0.25, 0, 0) u = (0.275, 0, 0).

struct GridMap {
  vec3 low;    // box space: where the first node is
  vec3 high;   // where the last node is
  vec3 cells;  // nodes − 1 on each axis
  vec3 scale;  // cells / (high − low): made by the host, since a division for each fragment is dear
  vec3 texel;  // 1/nodes on each axis
  GridRef grid;
};

// Where p is, counted in nodes, taken into the grid's box.
vec3 grid_position(GridMap map, vec3 p) {
  return clamp((p - map.low) * map.scale, vec3(real(0)), map.cells);
}

// The inverse map: the point of the data shown at p, box space.
vec3 grid_texture_from_object(GridMap map, vec3 p) { return p + sample_grid(map.grid, grid_position(map, p), map.texel); }

// Linear between the values at 0 and 1.
vec3 grid_mix(vec3 a, vec3 b, real t) { return a + t * (b - a); }

// Its derivative: column j is the derivative by p_j, that of the trilinear cell.
mat3 grid_jacobian(GridMap map, vec3 p) {
  vec3 x = grid_position(map, p);
  ivec3 i = min(ivec3(x), ivec3(map.cells) - 1);
  vec3 f = x - vec3(i);
  vec3 v000 = grid_node(map.grid, i);
  vec3 v100 = grid_node(map.grid, i + ivec3(1, 0, 0));
  vec3 v010 = grid_node(map.grid, i + ivec3(0, 1, 0));
  vec3 v110 = grid_node(map.grid, i + ivec3(1, 1, 0));
  vec3 v001 = grid_node(map.grid, i + ivec3(0, 0, 1));
  vec3 v101 = grid_node(map.grid, i + ivec3(1, 0, 1));
  vec3 v011 = grid_node(map.grid, i + ivec3(0, 1, 1));
  vec3 v111 = grid_node(map.grid, i + ivec3(1, 1, 1));
  vec3 by_x = grid_mix(grid_mix(v100 - v000, v110 - v010, f.y), grid_mix(v101 - v001, v111 - v011, f.y), f.z);
  vec3 by_y = grid_mix(grid_mix(v010 - v000, v110 - v100, f.x), grid_mix(v011 - v001, v111 - v101, f.x), f.z);
  vec3 by_z = grid_mix(grid_mix(v001 - v000, v101 - v100, f.x), grid_mix(v011 - v010, v111 - v110, f.x), f.y);
  // Nodes in one unit of box space, and none of it where the point was taken back to a face.
  vec3 scale = map.scale *
               vec3(lessThanEqual(abs(p - real(0.5) * (map.low + map.high)), real(0.5) * (map.high - map.low)));
  return mat3(vec3(real(1), real(0), real(0)) + scale.x * by_x, vec3(real(0), real(1), real(0)) + scale.y * by_y,
              vec3(real(0), real(0), real(1)) + scale.z * by_z);
}
