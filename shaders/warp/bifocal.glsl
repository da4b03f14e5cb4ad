// Bifocal display in three dimensions: one piecewise linear map for each axis (Cohen, Brodlie and Phillips 2008 §3.1).
// lib/axis_maps.glsl has the map of an axis and points worked by hand.

struct BifocalMap {
  vec3 size;        // of the box: box space = size · texture coordinates
  vec3 low;         // focus region in the data, texture coordinates
  vec3 high;
  vec3 shown_low;   // where it is shown
  vec3 shown_high;
};

vec2 bifocal_on_axis(BifocalMap map, vec3 t, int a) {
  return bifocal_axis(t[a], map.low[a], map.high[a], map.shown_low[a], map.shown_high[a]);
}

// The inverse map: the point of the data shown at p, box space.
vec3 bifocal_texture_from_object(BifocalMap map, vec3 p) {
  vec3 t = p / map.size;
  return map.size * vec3(bifocal_on_axis(map, t, 0).x, bifocal_on_axis(map, t, 1).x, bifocal_on_axis(map, t, 2).x);
}

// Its derivative: column j is the derivative by p_j.
mat3 bifocal_jacobian(BifocalMap map, vec3 p) {
  vec3 t = p / map.size;
  return mat3(vec3(bifocal_on_axis(map, t, 0).y, real(0), real(0)), vec3(real(0), bifocal_on_axis(map, t, 1).y, real(0)),
              vec3(real(0), real(0), bifocal_on_axis(map, t, 2).y));
}
