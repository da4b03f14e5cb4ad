// The two ends of a probed line, as the left and the right end of one row of pixels (Brunet, Nowak and Gleicher 2006 §4.1):
// pixel k samples the line at (k + ½)/N.

uniform vec3 line_begin;  // texture coordinates of the displayed volume
uniform vec3 line_end;
uniform float line_row;   // clip space

out vec3 object_coordinate;

void main() {
  object_coordinate = gl_VertexID == 0 ? line_begin : line_end;
  gl_Position = vec4(gl_VertexID == 0 ? -1.0 : 1.0, line_row, 0.0, 1.0);
}
