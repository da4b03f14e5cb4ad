// A corner of the 2D lens' mesh: where it is shown (clip space, worked out by the host in double precision) and the
// homogeneous texture coordinate (s·q, t·q, q) that it looks at (LaMar 2001 §3).

layout(location = 0) in vec2 corner;  // the same in every program that shares the buffer
layout(location = 1) in vec3 look;
out vec3 homogeneous_coordinate;

void main() {
  homogeneous_coordinate = look;
  gl_Position = vec4(corner, 0.0, 1.0);
}
