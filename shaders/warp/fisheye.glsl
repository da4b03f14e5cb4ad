// Fisheye display in three dimensions: one map for each axis (Cohen, Brodlie and Phillips 2008 §3.1; Sarkar and Brown
// 1992 for the formula). lib/axis_maps.glsl has the map of an axis and points worked by hand.

struct FisheyeMap {
  vec3 size;        // of the box: box space = size · texture coordinates
  vec3 center;      // focal point, texture coordinates
  vec3 distortion;  // d of each axis
};

vec2 fisheye_on_axis(FisheyeMap map, vec3 t, int a) { return fisheye_axis(t[a], map.center[a], map.distortion[a]); }

// The inverse map: the point of the data shown at p, box space.
vec3 fisheye_texture_from_object(FisheyeMap map, vec3 p) {
  vec3 t = p / map.size;
  return map.size * vec3(fisheye_on_axis(map, t, 0).x, fisheye_on_axis(map, t, 1).x, fisheye_on_axis(map, t, 2).x);
}

// Its derivative: column j is the derivative by p_j.
mat3 fisheye_jacobian(FisheyeMap map, vec3 p) {
  vec3 t = p / map.size;
  return mat3(vec3(fisheye_on_axis(map, t, 0).y, real(0), real(0)), vec3(real(0), fisheye_on_axis(map, t, 1).y, real(0)),
              vec3(real(0), real(0), fisheye_on_axis(map, t, 2).y));
}
