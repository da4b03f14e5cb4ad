// Cells of the volume that show nothing under the transfer function (OCCUPANCY; src/render/occupancy.h).

#ifdef OCCUPANCY
uniform sampler3D occupancy;        // one texel a cell: 1 where something shows, else the number of a stretch of values
uniform vec3 cells_from_texture;    // cells in one unit of texture coordinates, also fractions

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

// The first sample at or after `k` whose cell shows something; last + 1 where there is none. Nothing but the number leaves this
// loop: on drivers that run pixels side by side it diverges.
int next_occupied(PixelRay ray, int k, int last, float offset) {
  int at = k;
  for (; at <= last; ++at) {
    if (stretch_at(ray, float(at) + offset) == 1.0) break;
  }
  return at;
}

// The same for what shows between samples: the first `at` from `k` on with anything between at + start and at + start + 1. Both
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
#endif
