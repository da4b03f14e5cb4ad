// Compositing of associated colours (Porter and Duff 1984), the same for every pipeline.

// What a sample of straight colour and opacity adds to a picture.
vec4 associated(vec3 color, real alpha) { return vec4(color * alpha, alpha); }

// Front to back: `behind` seen through what has gathered in front.
vec4 under(vec4 front, vec4 behind) { return front + (real(1) - front.w) * behind; }
