// Triangles that cover the picture one over the other: what a driver fills at best.

uniform int layers;

out vec3 t;  // texture coordinates of the fragment

void main() {
  int number = gl_VertexID % 3;
  vec2 corner = vec2(float((number << 1) & 2), float(number & 2));
  t = vec3(corner, (float(gl_VertexID / 3) + 0.5) / float(layers));
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
