// What a cutting plane shows. gpu/volume.glsl and gpu/classify.glsl come first.

struct CutPlane {
  vec4 place;        // texture coordinates of the displayed volume: dot(place.xyz, p) + place.w = 0
  bool classified;   // the transfer function's colours instead of grey
  vec2 grey;         // grey = x · value + y
};

// Grey below black is not drawn: so air does not hide what lies behind a plane.
bool plane_shows(CutPlane plane, vec3 t) {
  return plane.classified || plane.grey.x * displayed_value(t) + plane.grey.y >= 0.0;
}

vec3 plane_color(CutPlane plane, vec3 t) {
  float value = displayed_value(t);
  vec3 grey = vec3(clamp(plane.grey.x * value + plane.grey.y, 0.0, 1.0));
  return plane.classified ? classify(value).rgb : grey;
}
