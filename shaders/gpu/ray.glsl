// The rays of a picture and the part of each that is sampled (lib/ray.glsl).

uniform RayFrame frame;
uniform float delta;       // Δ, world units
uniform vec3 object_low;   // bounds of the displayed volume, texture coordinates
uniform vec3 object_high;
uniform int clip_count;
uniform vec4 clip_planes[MAX_CLIP_PLANES];

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

// Sample k.
vec3 ray_point(PixelRay ray, float k) { return ray.origin + ((k + 0.5) * delta) * ray.direction; }
