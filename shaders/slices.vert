// A corner of a slice polygon: its texture coordinate, and where it lies in the picture.

uniform mat4 clip_from_texture;
in vec3 corner;
out vec3 texture_coordinate;

void main() {
  texture_coordinate = corner;
  gl_Position = clip_from_texture * vec4(corner, 1.0);
}
