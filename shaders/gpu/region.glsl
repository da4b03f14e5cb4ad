// Where the displayed volume is: its bounds and the half-spaces that are kept, dot(plane.xyz, p) + plane.w ≥ 0. Planes of the
// data are among them where no warp moves the data.

uniform vec3 object_low;  // texture coordinates
uniform vec3 object_high;
uniform int clip_count;
uniform vec4 clip_planes[MAX_CLIP_PLANES];

bool in_region(vec3 p) {
  bool inside = all(greaterThanEqual(p, object_low)) && all(lessThanEqual(p, object_high));
  for (int i = 0; i < clip_count; ++i) inside = inside && dot(clip_planes[i].xyz, p) + clip_planes[i].w >= 0.0;
  return inside;
}
