// Marks in the depth buffer, at the depth of all slices, the pixels behind which nothing shows (src/render/hidden_marks.h).

uniform sampler2D colors;  // what is gathered so far, associated
uniform float nothing_behind;

void main() {
  if (texelFetch(colors, ivec2(gl_FragCoord.xy), 0).a < nothing_behind) discard;
}
