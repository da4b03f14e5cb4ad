// The transfer function as a table in a 1D texture: straight colour, and opacity per reference length.

uniform sampler1D transfer_texture;
uniform vec2 transfer_from_value;  // table coordinate = x · value + y

vec4 classify(float value) { return texture(transfer_texture, transfer_from_value.x * value + transfer_from_value.y); }
