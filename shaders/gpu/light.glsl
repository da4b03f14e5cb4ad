// Shading of a sample (lib/shade.glsl): SHADED with SHADING_DIFFUSE, SHADING_PHONG or SHADING_TONE.

// MODULATED: opacities that follow the gradient (Levoy 1988).

#if defined(SHADED) || defined(MODULATED) || defined(TRANSFER_2D)
uniform mat3 world_from_gradient;    // inverse transpose of world_from_texture
#endif

#ifdef MODULATED
uniform float full_gradient;  // data units per world unit

// The factor on the opacity of a sample.
float opacity_factor(vec3 t, vec3 p) {
  return min(length(world_from_gradient * shown_gradient(t, p)) / full_gradient, 1.0);
}
#endif

// Straight colour and opacity per reference length of the data at t, shown at p, without light.
vec4 plain_color(vec3 t, vec3 p) {
#if defined(TRANSFER_2D)
  return classify_2d(displayed_value(t), length(world_from_gradient * shown_gradient(t, p)));
#else
#ifdef LABELS
  vec4 color = classify_at(t);
#else
  vec4 color = classify_texel(displayed_texel(t));
#endif
#ifdef MODULATED
  color.a *= opacity_factor(t, p);
#endif
  return color;
#endif
}

#ifdef SHADED
uniform vec3 to_light;               // world space, unit; ignored with LIGHT_AT_EYE
uniform float ambient;
uniform float diffuse;
uniform float specular;
uniform float power;
uniform vec3 cool;
uniform vec3 warm;
uniform bool two_sided;

// `by_texture`: the gradient of what is shown, by texture coordinates.
vec3 shade_with(vec3 color, vec3 by_texture, vec3 to_eye) {
  vec3 gradient = world_from_gradient * by_texture;
#ifdef LIGHT_AT_EYE
  vec3 light = to_eye;
#else
  vec3 light = to_light;
#endif
#if defined(SHADING_TONE)
  return tone_color(color, gradient, light, cool, warm);
#elif defined(SHADING_PHONG)
  return phong_color(color, gradient, light, to_eye, ambient, diffuse, specular, power, two_sided);
#else
  return color * diffuse_factor(gradient, light, ambient, diffuse, two_sided);
#endif
}

// `t`: where the data is looked at; `p`: where it is shown.
vec3 shade(vec3 color, vec3 t, vec3 p, vec3 to_eye) { return shade_with(color, shown_gradient(t, p), to_eye); }

#if defined(VALUE_WITH_GRADIENT) && !defined(MODULATED) && !defined(TRANSFER_2D) && !defined(LABELS)
#define ONE_FETCH
// Colour with light and opacity from the texture that holds both.
vec4 lit_color(vec3 t, vec3 p, vec3 to_eye) {
  vec4 both = linear_texels(gradient_texture, t);
  vec4 color = classify_texel(both.a);
  color.rgb = shade_with(color.rgb, carried_gradient(gradient_scale * both.rgb, p), to_eye);
  return color;
}
#endif
#endif
