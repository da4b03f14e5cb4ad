// Two-level rendering (Hauser, Mroz, Bischi and Gröller 2001): a ray's run of samples through one object becomes one
// associated colour by that object's own mode, and these are composited front to back. lib/composite.glsl comes before.
//
// Modes: 0 dvr, its samples one by one, which is the same as compositing the run first (over is associative);
//        1 mip, colour and opacity of the run's largest value, not corrected for any distance, as it has none;
//        2 xray, with S = Σ α·Δ/Δ₀ the opacity min(xray_scale · S, 1) in the mean of the samples' colours by opacity.

struct TwoLevel {
  vec4 gathered;  // associated
  int row;        // of the table: the object whose run is under way; −1: none
  int mode;
  real largest;   // mip
  vec4 shown;     // mip: straight colour and opacity of the largest value; xray: Σ α·Δ/Δ₀ (r, g, b, 1)
};

TwoLevel nothing_gathered() {
  TwoLevel state;
  state.gathered = vec4(real(0));
  state.row = -1;
  state.mode = 0;
  state.largest = real(-3e38);
  state.shown = vec4(real(0));
  return state;
}

// The run so far, with what it adds composited.
TwoLevel ended_run(TwoLevel state, real xray_scale) {
  TwoLevel ended = nothing_gathered();
  vec4 adds = vec4(real(0));
  if (state.mode == 1) adds = associated(vec3(state.shown.x, state.shown.y, state.shown.z), state.shown.w);
  if (state.mode == 2 && state.shown.w > real(0))
    adds = state.shown * (min(xray_scale * state.shown.w, real(1)) / state.shown.w);
  ended.gathered = under(state.gathered, adds);
  return ended;
}

// One more sample, of straight colour and opacity per reference length; `alpha` is that opacity for the sample distance.
TwoLevel with_sample(TwoLevel state, int row, int mode, real value, vec4 color, real alpha, real distance_ratio,
                     real xray_scale) {
  TwoLevel next = state;
  if (row != state.row) next = ended_run(state, xray_scale);
  next.row = row;
  next.mode = mode;
  vec3 straight = vec3(color.x, color.y, color.z);
  if (mode == 0) next.gathered = under(next.gathered, associated(straight, alpha));
  if (mode == 1 && value > next.largest) {
    next.largest = value;
    next.shown = color;
  }
  if (mode == 2) next.shown = next.shown + associated(straight, color.w * distance_ratio);
  return next;
}
