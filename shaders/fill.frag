// FILL 0: a constant; 1: a trilinear fetch; 2: and its colour from a table.

uniform sampler3D volume;
uniform sampler1D table;

in vec3 t;
out vec4 color;

void main() {
#if FILL == 0
  color = vec4(0.01, 0.01, 0.01, 0.01);
#elif FILL == 1
  color = vec4(0.01 * texture(volume, t).r);
#else
  vec4 straight = texture(table, texture(volume, t).r);
  color = vec4(straight.rgb * straight.a, straight.a);
#endif
}
