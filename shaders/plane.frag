// A cutting plane of the displayed volume as an opaque polygon (Brunet, Nowak and Gleicher 2006 §4.2): the data's values as
// grey, or in the transfer function's colours.

#include "lib/composite.glsl"
#include "gpu/volume.glsl"
#include "gpu/classify.glsl"
#include "generated/warps.glsl"
#include "gpu/warp.glsl"
#include "gpu/axis_tables.glsl"
#include "gpu/plane.glsl"

uniform CutPlane plane;

in vec3 object_coordinate;
out vec4 result;

void main() {
#if defined(AXIS_TABLES)
  vec3 t = axis_texture_from_object(fetch_axis_tables(object_coordinate), object_coordinate);
#elif defined(WARPED)
  vec3 t = texture_from_object(object_coordinate);
#else
  vec3 t = object_coordinate;
#endif
  if (any(lessThan(t, vec3(0.0))) || any(greaterThan(t, vec3(1.0))) || !plane_shows(plane, t)) discard;
  result = vec4(plane_color(plane, t), 1.0);
}
