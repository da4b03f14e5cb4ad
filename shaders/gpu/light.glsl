// Shading of a sample from gradients taken on the fly. SHADING_DIFFUSE with GRADIENT_FORWARD or GRADIENT_CENTRAL.

#ifdef SHADING_DIFFUSE
uniform vec3 voxel;                  // size of one voxel in texture coordinates
uniform mat3 world_from_gradient;    // inverse transpose of world_from_texture
uniform vec3 to_light;               // world space, unit; ignored with LIGHT_AT_EYE
uniform float ambient;
uniform float diffuse;
uniform bool two_sided;

// `t`: where the data is looked at; `p`: where it is shown.
vec3 shade(vec3 color, vec3 t, vec3 p, vec3 to_eye) {
#if defined(LEVELS) && LEVELS > 1
  vec3 h = level_step(voxel);
#else
  vec3 h = voxel;
#endif
#ifdef GRADIENT_FORWARD
  vec3 gradient = forward_gradient(t, h);
#else
  vec3 gradient = central_gradient(t, h);
#endif
#if defined(WARPED) || defined(AXIS_TABLES)
  gradient = displayed_gradient(gradient, p);
#endif
  gradient = world_from_gradient * gradient;
#ifdef LIGHT_AT_EYE
  vec3 light = to_eye;
#else
  vec3 light = to_light;
#endif
  return color * diffuse_factor(gradient, light, ambient, diffuse, two_sided);
}
#endif
