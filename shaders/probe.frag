// What a probed line meets. PROBE_PLACE: texture coordinate of the data, and whether there is any; otherwise data value,
// opacity per reference length, and length of the displayed volume's gradient (data units per world unit).

#include "lib/composite.glsl"
#include "gpu/volume.glsl"
#include "gpu/classify.glsl"
#include "generated/warps.glsl"
#include "gpu/warp.glsl"
#include "gpu/focus_effects.glsl"
#include "gpu/gradient.glsl"

uniform mat3 world_from_gradient;

in vec3 object_coordinate;
out vec4 result;

void main() {
#ifdef WARPED
  vec3 t = texture_from_object(object_coordinate);
  bool inside = in_volume(t) && in_data_planes(t);
#else
  vec3 t = object_coordinate;
  bool inside = true;  // the host cuts the line
#endif
#ifdef PROBE_PLACE
  result = vec4(t, inside ? 1.0 : 0.0);
#else
  vec4 color = classify_texel(displayed_texel(t));
#ifdef FOCUS_EFFECTS
  color = with_effects(color, effects_at(object_coordinate));
#endif
  vec3 gradient = shown_gradient(t, object_coordinate);
  result = vec4(displayed_value(t), color.a, length(world_from_gradient * gradient), 1.0);
#endif
}
