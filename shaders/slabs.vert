// A corner of what a pass of several planes covers (render.planes_per_pass).

in vec3 corner;  // xy: [−1, 1]², y up
in vec4 look;    // x, y: numbers of its first and last plane
flat out vec2 planes;

void main() {
  planes = look.xy;
  gl_Position = vec4(corner.xy, 0.0, 1.0);
}
