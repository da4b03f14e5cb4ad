// The transfer function as a table in a 1D texture: straight colour, and opacity per reference length.

uniform sampler1D transfer_texture;
uniform vec2 transfer_from_value;  // table coordinate = x · value + y
uniform vec2 transfer_from_texel;  // the same from what the volume's texture holds

vec4 classify(float value) { return texture(transfer_texture, transfer_from_value.x * value + transfer_from_value.y); }

// Texel → value → table coordinate in one step: as two they cost a plain slice 7 % of its time on llvmpipe.
vec4 classify_texel(float texel) {
  return texture(transfer_texture, transfer_from_texel.x * texel + transfer_from_texel.y);
}
