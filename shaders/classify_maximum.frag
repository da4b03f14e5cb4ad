// Second pass of MIP by slices: classifies the largest value of each pixel once, at the end; MODE_MINIP the smallest,
// MODE_AVERAGE the mean.

#include "lib/composite.glsl"
#ifdef VOLUMES
#include "lib/opacity.glsl"
#include "lib/shade.glsl"
#include "generated/volumes.glsl"
#else
#include "gpu/classify.glsl"
#endif
#include "gpu/focus_effects.glsl"

uniform sampler2D maxima;
uniform vec2 value_from_unit;

in vec2 place;
out vec4 result;

void main() {
  vec4 largest = texelFetch(maxima, ivec2(gl_FragCoord.xy), 0);
#ifdef MODE_AVERAGE
  largest.r /= max(largest.a, 1.0);
#endif
#ifdef VOLUMES
  vec4 shown = color_of_units(largest);
  result = associated(shown.rgb, shown.a);
#else
  vec4 color = classify(value_from_unit.x * largest.r + value_from_unit.y);
#ifdef FOCUS_EFFECTS
  color = with_effects(color, largest.gb);  // those of the largest sample
#endif
  result = largest.a > 0.0 ? associated(color.rgb, color.a) : vec4(0.0);
#endif
}
