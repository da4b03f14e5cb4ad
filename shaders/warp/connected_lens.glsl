// The volume lens without its cut: u = x + w_x·w_y·w_z·offset, with the masks of Cohen's tables grown into weights that
// fade out together (docs/papers/cohen.md has the proof that it is continuous and does not fold).
// lib/axis_maps.glsl has offset and weight of an axis.
//
// Worked by hand, c = 1/2, i = 0.1, o = 0.3, m = 2 on all axes, size 1: at (0.55, 0.5, 0.5) all weights are 1, so u =
// (0.525, 0.5, 0.5); at (0.7, 0.5, 0.5) w_x = 1/2 and the offset is −0.0625, so u = (0.66875, 0.5, 0.5); at (0.7, 0.55, 0.5)
// also u_y = 0.55 − 0.025/2 = 0.5375; at (0.8, 0.55, 0.5) and beyond u = p.

struct ConnectedLensMap {
  vec3 size;           // of the box: box space = size · texture coordinates
  vec3 center;         // texture coordinates
  vec3 inner;          // half-widths, texture coordinates: magnified within
  vec3 outer;          // untouched beyond
  real magnification;
};

// u − x of one axis, and its derivative.
vec2 connected_lens_offset(ConnectedLensMap map, vec3 t, int a) {
  vec2 u = lens_axis(t[a], map.center[a], map.inner[a], map.outer[a], map.magnification);
  return vec2(u.x - t[a], u.y - real(1));
}

vec2 connected_lens_weight(ConnectedLensMap map, vec3 t, int a) {
  return lens_weight(t[a], map.center[a], map.inner[a], map.outer[a]);
}

// The inverse map: the point of the data shown at p, box space.
vec3 connected_lens_texture_from_object(ConnectedLensMap map, vec3 p) {
  vec3 t = p / map.size;
  vec3 offset = vec3(connected_lens_offset(map, t, 0).x, connected_lens_offset(map, t, 1).x,
                     connected_lens_offset(map, t, 2).x);
  real weight = connected_lens_weight(map, t, 0).x * connected_lens_weight(map, t, 1).x *
                connected_lens_weight(map, t, 2).x;
  return p + map.size * (weight * offset);
}

// Its derivative: column j is the derivative by p_j.
mat3 connected_lens_jacobian(ConnectedLensMap map, vec3 p) {
  vec3 t = p / map.size;
  vec2 x = connected_lens_offset(map, t, 0);
  vec2 y = connected_lens_offset(map, t, 1);
  vec2 z = connected_lens_offset(map, t, 2);
  vec2 wx = connected_lens_weight(map, t, 0);
  vec2 wy = connected_lens_weight(map, t, 1);
  vec2 wz = connected_lens_weight(map, t, 2);
  real weight = wx.x * wy.x * wz.x;
  vec3 slope = vec3(wx.y * wy.x * wz.x, wx.x * wy.y * wz.x, wx.x * wy.x * wz.y);
  // By box coordinates: offsets grow by size, derivatives shrink by it.
  mat3 stretch = mat3(vec3(real(1) + weight * x.y, real(0), real(0)), vec3(real(0), real(1) + weight * y.y, real(0)),
                      vec3(real(0), real(0), real(1) + weight * z.y));
  return stretch + outerProduct(map.size * vec3(x.x, y.x, z.x), slope / map.size);
}
