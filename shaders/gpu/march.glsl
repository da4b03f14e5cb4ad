// A ray's samples one after the other, front to back: what slabs.frag and rays.frag do with their planes and steps. END_OPACITY:
// the ray ends where that much is gathered. The loops gather in their own variables only, and nothing that a diverging loop
// computes is read but through them.

#if defined(OCCUPANCY) && defined(SHADED) && defined(MODE_DVR) && !defined(MODULATED) && !defined(TRANSFER_2D) && \
    !defined(ONE_FETCH) && !defined(CLASSIFICATION_PRE)
#define SHADE_VISIBLE
#endif

#ifdef OCCUPANCY
// Samples that are taken before empty cells are looked for again. Looking costs a fetch for each; not looking, samples that
// show nothing. All pixels take the same number, which spares those that drivers run side by side waiting for each other.
const int run_length = 8;
#endif

vec4 gathered_along(vec4 before, PixelRay ray, int first, int last, float offset, vec3 to_eye) {
  vec4 gathered = before;
#if defined(SHADE_VISIBLE)
  // Gradients and light only where there is opacity: an inner loop goes on to the next such sample, and what is dear comes after.
  for (int k = first; k <= last; ++k) {
    vec4 color = vec4(0.0);
    for (; k <= last; ++k) {
      k = next_occupied(ray, k, last, offset);
      if (k > last) break;
      color = color_without_light(ray_point(ray, float(k) + offset));
      if (color.a > 0.0) break;
    }
    if (k > last) break;
    gathered = gather_colored(gathered, color, ray_point(ray, float(k) + offset), to_eye);
#ifdef END_OPACITY
    if (gathered.a >= END_OPACITY) break;
#endif
  }
#elif defined(OCCUPANCY)
  for (int k = first; k <= last;) {
    k = next_occupied(ray, k, last, offset);
    if (k > last) break;
    int stop = min(k + run_length, last + 1);
    for (; k < stop; ++k) {
      gathered = gather(gathered, ray_point(ray, float(k) + offset), to_eye);
#ifdef END_OPACITY
      if (gathered.a >= END_OPACITY) {
        k = last + 1;
        break;
      }
#endif
    }
  }
#else
  for (int k = first; k <= last; ++k) {
    gathered = gather(gathered, ray_point(ray, float(k) + offset), to_eye);
#ifdef END_OPACITY
    if (gathered.a >= END_OPACITY) break;
#endif
  }
#endif
  return gathered;
}
