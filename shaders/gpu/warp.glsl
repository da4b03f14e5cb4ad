// The scene's warps. WARPED: there are some; their functions and uniforms are written by the host
// (src/render/warp_glsl.cpp) and come before this file.

#ifdef WARPED
uniform vec3 box_size;  // box space = texture coordinates · box_size
uniform vec3 texture_from_box;  // 1/box_size: a division for each fragment is dear on software drivers

// Where the data shown at p is: u = u_1 ∘ … ∘ u_n (docs/pipeline.md).
vec3 texture_from_object(vec3 p) { return chain_texture_from_object(p * box_size) * texture_from_box; }

// The gradient of the displayed volume v∘u from that of the data: Jᵀ∇v, both by texture coordinates.
vec3 displayed_gradient(vec3 gradient, vec3 p) {
  return ((gradient * texture_from_box) * chain_jacobian(p * box_size)) * box_size;
}

#if defined(LEVELS) && LEVELS > 1 && !defined(FOOTPRINT)
// How much of the lenses' magnification r/f(r) the point p is shown with (lib/levels.glsl); they do not overlap.
float magnification(vec3 p) { return chain_magnification(p * box_size); }
#endif

bool in_volume(vec3 t) { return all(greaterThanEqual(t, vec3(0.0))) && all(lessThanEqual(t, vec3(1.0))); }
#endif

#if defined(WARPED) || defined(AXIS_TABLES)
// User clipping planes of the data: dot(plane.xyz, t) + plane.w ≥ 0. DATA_PLANES: there are some; even an empty loop costs.
uniform int data_plane_count;
uniform vec4 data_planes[MAX_CLIP_PLANES];

bool in_data_planes(vec3 t) {
#ifndef DATA_PLANES
  return true;
#else
  bool inside = true;
  for (int i = 0; i < data_plane_count; ++i) inside = inside && dot(data_planes[i].xyz, t) + data_planes[i].w >= 0.0;
  return inside;
#endif
}
#endif
