// Cells of the volume that show nothing under the transfer function (OCCUPANCY; src/render/occupancy.h).

#ifdef OCCUPANCY
uniform sampler3D occupancy;        // one texel a cell: above 0 where something shows
uniform vec3 cells_from_texture;    // cells in one unit of texture coordinates, also fractions

// The first sample at or after `k` whose cell shows something; last + 1 where there is none. Nothing but the number leaves this
// loop: on drivers that run pixels side by side it diverges.
int next_occupied(PixelRay ray, int k, int last, float offset) {
  int at = k;
  for (; at <= last; ++at) {
    vec3 p = ray_point(ray, float(at) + offset);
#if defined(AXIS_TABLES)
    vec3 t = axis_texture_from_object(fetch_axis_tables(p), p);
#elif defined(WARPED)
    vec3 t = texture_from_object(p);
#else
    vec3 t = p;
#endif
    ivec3 cell = clamp(ivec3(t * cells_from_texture), ivec3(0), textureSize(occupancy, 0) - 1);
    if (texelFetch(occupancy, cell, 0).r > 0.0) break;
  }
  return at;
}
#endif
