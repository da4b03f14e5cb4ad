// Cohen's volume lens, a box fixed in the data (Cohen, Brodlie and Phillips 2008 §3.1): offsets apply where the masks of all
// three axes are 1. On the box's faces one axis still has an offset where another's mask ends: there the map jumps.
// lib/axis_maps.glsl has the map of an axis and points worked by hand.

struct VolumeLensMap {
  vec3 size;           // of the box: box space = size · texture coordinates
  vec3 center;         // texture coordinates
  vec3 inner;          // half-widths, texture coordinates: magnified within
  vec3 outer;          // untouched beyond
  real magnification;
};

vec2 volume_lens_on_axis(VolumeLensMap map, vec3 t, int a) {
  return lens_axis(t[a], map.center[a], map.inner[a], map.outer[a], map.magnification);
}

// The mask of an axis.
bool volume_lens_masks(VolumeLensMap map, vec3 t) { return all(lessThan(abs(t - map.center), map.outer)); }

// The inverse map: the point of the data shown at p, box space.
vec3 volume_lens_texture_from_object(VolumeLensMap map, vec3 p) {
  vec3 t = p / map.size;
  vec3 u = vec3(volume_lens_on_axis(map, t, 0).x, volume_lens_on_axis(map, t, 1).x, volume_lens_on_axis(map, t, 2).x);
  return volume_lens_masks(map, t) ? map.size * u : p;
}

// Its derivative: column j is the derivative by p_j. On a face of the box, of the outside.
mat3 volume_lens_jacobian(VolumeLensMap map, vec3 p) {
  vec3 t = p / map.size;
  if (!volume_lens_masks(map, t)) return mat3(real(1));
  return mat3(vec3(volume_lens_on_axis(map, t, 0).y, real(0), real(0)),
              vec3(real(0), volume_lens_on_axis(map, t, 1).y, real(0)),
              vec3(real(0), real(0), volume_lens_on_axis(map, t, 2).y));
}
