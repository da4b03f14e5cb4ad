// The gradient of what is shown at a sample. GRADIENTS with GRADIENT_FORWARD, GRADIENT_CENTRAL, GRADIENT_PREFILTERED or
// GRADIENT_PRECOMPUTED; GRADIENT_IN_OBJECT_SPACE: differences of v∘u over one voxel of the displayed volume (Brunet, Nowak
// and Gleicher 2006, eq. 1), for which each tap evaluates the map (pipeline `axis`: reads the tables). Otherwise they are
// taken in the data and carried by the Jacobian. Taps outside the volume clamp to its edge, as the filter's do.

#ifdef GRADIENTS
uniform vec3 voxel;  // step of differences in texture coordinates: one voxel, of the Gaussian copy where there is one

#if defined(GRADIENT_PREFILTERED) || defined(GRADIENT_PRECOMPUTED)
uniform sampler3D gradient_texture;  // the copy, or derivatives by texture coordinates · gradient_scale
#endif

#if defined(GRADIENT_PRECOMPUTED)
uniform vec3 gradient_scale;
vec3 gradient_at(vec3 t, vec3 p) { return gradient_scale * linear_texels(gradient_texture, t).rgb; }
#else

#ifdef GRADIENT_PREFILTERED
float tap(vec3 t) { return linear_texels(gradient_texture, t).r; }
#elif defined(PAGED) && !defined(GRADIENT_IN_OBJECT_SPACE)
float tap(vec3 t) { return value_from_texel.x * held_texel(t) + value_from_texel.y; }
#else
float tap(vec3 t) { return displayed_value(t); }
#endif

#if !defined(GRADIENT_IN_OBJECT_SPACE)
float gradient_value(vec3 t) { return tap(t); }
#elif defined(AXIS_TABLES)
float gradient_value(vec3 p) { return tap(axis_texture_from_object(fetch_axis_tables(p), p)); }
#else
float gradient_value(vec3 p) { return tap(texture_from_object(p)); }
#endif

#include "lib/gradient.glsl"

vec3 gradient_at(vec3 t, vec3 p) {
#if defined(FOOTPRINT)
  vec3 h = voxel * exp2(step_level(p));
#elif defined(LEVELS) && LEVELS > 1
  vec3 h = level_step(voxel);
#else
  vec3 h = voxel;
#endif
#ifdef GRADIENT_IN_OBJECT_SPACE
  vec3 at = p;
#else
  vec3 at = t;
#ifdef PAGED
  hold_page(t);
#endif
#endif
#ifdef GRADIENT_FORWARD
  return forward_gradient(at, h);
#else
  return central_gradient(at, h);
#endif
}
#endif

// A gradient of the data as one of what is shown at p.
vec3 carried_gradient(vec3 gradient, vec3 p) {
#if (defined(WARPED) || defined(AXIS_TABLES)) && !defined(GRADIENT_IN_OBJECT_SPACE)
  return displayed_gradient(gradient, p);
#else
  return gradient;
#endif
}

// By texture coordinates of the displayed volume. `t`: where the data is looked at; `p`: where it is shown.
vec3 shown_gradient(vec3 t, vec3 p) { return carried_gradient(gradient_at(t, p), p); }
#endif
