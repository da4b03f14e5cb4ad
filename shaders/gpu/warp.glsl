// The scene's lenses. LENS_COUNT is their number; without it nothing is warped.

#ifdef LENS_COUNT
#include "warp/lamar.glsl"

uniform LamarMap lenses[LENS_COUNT];
uniform vec3 box_size;  // box space = texture coordinates · box_size

// Where the data shown at p is: u = u_1 ∘ … ∘ u_n (docs/pipeline.md).
vec3 texture_from_object(vec3 p) {
  vec3 b = p * box_size;
  for (int i = LENS_COUNT - 1; i >= 0; --i) b = lamar_texture_from_object(lenses[i], b);
  return b / box_size;
}

// The gradient of the displayed volume v∘u from that of the data: Jᵀ∇v, both by texture coordinates.
vec3 displayed_gradient(vec3 gradient, vec3 p) {
  vec3 b = p * box_size;
  mat3 jacobian = mat3(1.0);
  for (int i = LENS_COUNT - 1; i >= 0; --i) {
    jacobian = lamar_jacobian(lenses[i], b) * jacobian;
    b = lamar_texture_from_object(lenses[i], b);
  }
  return ((gradient / box_size) * jacobian) * box_size;
}

// How much of the lenses' magnification r/f(r) the point p is shown with (lib/levels.glsl); they do not overlap.
float magnification(vec3 p) {
  vec3 b = p * box_size;
  float q = 1.0;
  for (int i = LENS_COUNT - 1; i >= 0; --i) {
    q *= lamar_magnification(lenses[i], b);
    b = lamar_texture_from_object(lenses[i], b);
  }
  return q;
}

bool in_volume(vec3 t) { return all(greaterThanEqual(t, vec3(0.0))) && all(lessThanEqual(t, vec3(1.0))); }

// User clipping planes of the data: dot(plane.xyz, t) + plane.w ≥ 0.
uniform int data_plane_count;
uniform vec4 data_planes[MAX_CLIP_PLANES];

bool in_data_planes(vec3 t) {
  bool inside = true;
  for (int i = 0; i < data_plane_count; ++i) inside = inside && dot(data_planes[i].xyz, t) + data_planes[i].w >= 0.0;
  return inside;
}
#endif
