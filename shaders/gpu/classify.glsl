// The transfer function as a table in a 1D texture: straight colour, and opacity per reference length.

uniform sampler1D transfer_texture;
uniform vec2 transfer_from_value;  // table coordinate = x · value + y
uniform vec2 transfer_from_texel;  // the same from what the volume's texture holds

vec4 classify(float value) { return texture(transfer_texture, transfer_from_value.x * value + transfer_from_value.y); }

#ifdef TRANSFER_2D
// Of value and gradient magnitude: associated colour.
uniform sampler2D transfer_2d_texture;
uniform vec4 transfer_2d_place;  // table coordinates = xy · (value, gradient) + zw

vec4 classify_2d(float value, float gradient) {
  vec4 color = textureLod(transfer_2d_texture, transfer_2d_place.xy * vec2(value, gradient) + transfer_2d_place.zw, 0.0);
  return vec4(color.rgb / max(color.a, 1.0e-12), color.a);
}
#endif

// Texel → value → table coordinate in one step: as two they cost a plain slice 7 % of its time on llvmpipe.
vec4 classify_texel(float texel) {
  return texture(transfer_texture, transfer_from_texel.x * texel + transfer_from_texel.y);
}
