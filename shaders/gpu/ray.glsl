// The rays of a picture and the part of each that is sampled (lib/ray.glsl, gpu/region.glsl).

uniform RayFrame frame;
uniform float delta;  // Δ, world units

// (x, y) in [−1, 1]², y up.
PixelRay ray_through(vec2 place) {
#ifdef PERSPECTIVE
  return ray_from_pixel(frame, true, place.x, place.y);
#else
  return ray_from_pixel(frame, false, place.x, place.y);
#endif
}

// The interval on the kept side of all clipping planes.
vec2 clipped(vec2 interval, PixelRay ray) {
  for (int i = 0; i < clip_count; ++i) interval = clip_interval(interval, ray, clip_planes[i]);
  return interval;
}

// Sample k; fractions are between samples.
vec3 ray_point(PixelRay ray, float k) { return ray.origin + ((k + 0.5) * delta) * ray.direction; }
