// Cells of the volume that show nothing under the transfer function (OCCUPANCY; src/render/occupancy_texture.h).

#ifdef OCCUPANCY
uniform sampler3D occupancy;      // one texel a cell
uniform vec3 cells_from_texture;  // cells in one unit of texture coordinates, also fractions

#if defined(MODE_ISO) || defined(PREINTEGRATED)
// A texel is 1 where the cell shows something, else the number of a stretch of values.

// Of the cell that the ray looks into at `k` sample distances.
float stretch_at(PixelRay ray, float k) {
  vec3 p = ray_point(ray, k);
#if defined(AXIS_TABLES)
  vec3 t = axis_texture_from_object(fetch_axis_tables(p), p);
#elif defined(WARPED)
  vec3 t = texture_from_object(p);
#else
  vec3 t = p;
#endif
  ivec3 cell = clamp(ivec3(t * cells_from_texture), ivec3(0), textureSize(occupancy, 0) - 1);
  return texelFetch(occupancy, cell, 0).r;
}

// What shows between samples: the first `at` from `k` on with anything between at + start and at + start + 1. Both
// ends may lie in empty cells, one below what shows and one above.
int next_between(PixelRay ray, int k, int last, float start) {
  int at = k;
  float before = stretch_at(ray, float(k) + start);
  for (; at <= last; ++at) {
    float here = stretch_at(ray, float(at) + start + 1.0);
    if (here == 1.0 || here != before) break;
    before = here;
  }
  return at;
}
#else
// A texel is the number of cells to the nearest one that shows something, by 255; 0: itself.

// The first sample at or after `k` whose cell shows something; beyond `last` where there is none. Nothing but the number leaves
// this loop: on drivers that run pixels side by side it diverges.
#if defined(AXIS_TABLES) || defined(WARPED)
// One by one: how far it is in the data says nothing about how far it is on the ray.
int next_occupied(PixelRay ray, int k, int last, float offset) {
  int at = k;
  ivec3 top = textureSize(occupancy, 0) - 1;
  for (; at <= last; ++at) {
    vec3 p = ray_point(ray, float(at) + offset);
#if defined(AXIS_TABLES)
    vec3 t = axis_texture_from_object(fetch_axis_tables(p), p);
#else
    vec3 t = texture_from_object(p);
#endif
    if (texelFetch(occupancy, clamp(ivec3(t * cells_from_texture), ivec3(0), top), 0).r == 0.0) break;
  }
  return at;
}
#else
// The cells nearer than the nearest that shows something make a box, which the ray leaves in one leap. Numbers of cells are
// rounded, but a sample just outside of a cell reads no other voxels than one just inside.
int next_occupied(PixelRay ray, int k, int last, float offset) {
  int at = k;
  vec3 stride = (delta * cells_from_texture) * ray.direction;
  vec3 start = cells_from_texture * ray.origin + (0.5 + offset) * stride;
  vec3 inverse = 1.0 / mix(stride, vec3(1e-20), lessThan(abs(stride), vec3(1e-20)));
  ivec3 top = textureSize(occupancy, 0) - 1;
  for (; at <= last;) {
    vec3 place = start + float(at) * stride;
    vec3 cell = floor(place);
    float cells = 255.0 * texelFetch(occupancy, clamp(ivec3(cell), ivec3(0), top), 0).r;
    if (cells == 0.0) break;
    vec3 ways = (cells - 0.5) * abs(inverse) - (place - cell - 0.5) * inverse;
    at += int(min(min(ways.x, ways.y), ways.z)) + 1;
  }
  return at;
}
#endif
#endif
#endif
