// A corner of a slice polygon: where it is shown, and with WARP_TESSELLATED the homogeneous texture coordinate that it
// looks at (LaMar 2001 §3), with SHELLS the number of its shell.

uniform mat4 clip_from_texture;
in vec3 corner;
#if defined(JITTER) || defined(SHELLS)
#define object_coordinate slice_coordinate
#endif
out vec3 object_coordinate;
#ifdef WARP_TESSELLATED
in vec4 look;
out vec4 homogeneous_coordinate;
#endif
#ifdef SHELLS
in vec4 look;
flat out float shell;
#endif

void main() {
  object_coordinate = corner;
#ifdef WARP_TESSELLATED
  homogeneous_coordinate = look;
#endif
#ifdef SHELLS
  shell = look.x;
#endif
  gl_Position = clip_from_texture * vec4(corner, 1.0);
}
