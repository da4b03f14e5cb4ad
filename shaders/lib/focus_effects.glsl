// Highlight and attenuation of a focus region (Cohen, Brodlie and Phillips 2008 §3.2 and §3.3; docs/papers/cohen.md). Both are
// products of one factor for each axis, at the coordinate where a point is shown, [0,1]; regions are those on display.

const int highlight_off = 0;
const int highlight_distance = 1;
const int highlight_focus = 2;
const int attenuation_off = 0;
const int attenuation_distance = 1;
const int attenuation_viewpoint = 2;

struct FocusEffects {
  int highlight;
  real highlight_power;
  vec3 highlight_color;  // H
  vec3 highlight_low;    // focus region of the highlight
  vec3 highlight_high;
  int attenuation;
  real attenuation_power;
  vec3 attenuation_low;   // x'_min
  vec3 attenuation_high;  // x'_max
  vec3 gaze;              // unit vector from the focus centre to the viewer, along the volume's axes
};

// x ≥ 0 to a power ≥ 0; the papers' three exactly, because drivers compute pow to about 1e-5.
real raised(real x, real power) {
  if (power == real(1)) return x;
  if (power == real(2)) return x * x;
  if (power == real(3)) return x * x * x;
  if (power == real(0)) return real(1);
  return x > real(0) ? pow(x, power) : real(0);
}

// h of one axis (eq. 1): a hat about the region's centre, or 1 within the region.
real highlight_on_axis(FocusEffects effects, real x, int a) {
  if (effects.highlight == highlight_off) return real(0);
  real low = effects.highlight_low[a];
  real high = effects.highlight_high[a];
  if (effects.highlight == highlight_focus) return x >= low && x <= high ? real(1) : real(0);
  return raised(max(real(1) - real(2) * abs(real(0.5) * (low + high) - x), real(0)), effects.highlight_power);
}

// a of one axis (eq. 3 and eq. 4): falls towards the faces, or towards the faces that look at the viewer.
real attenuation_on_axis(FocusEffects effects, real x, int a) {
  if (effects.attenuation == attenuation_off) return real(1);
  real low = effects.attenuation_low[a];
  real high = effects.attenuation_high[a];
  real factor = real(1);
  if (x < low) factor = max(x, real(0)) / low;
  if (x > high) factor = max(real(1) - x, real(0)) / (real(1) - high);
  if (effects.attenuation == attenuation_viewpoint) {
    bool in_front = (x < low && effects.gaze[a] < real(0)) || (x > high && effects.gaze[a] > real(0));
    factor = in_front ? real(1) - (real(1) - factor) * abs(effects.gaze[a]) : real(1);
  }
  return raised(factor, effects.attenuation_power);
}

real highlight_at(FocusEffects effects, vec3 t) {
  return highlight_on_axis(effects, t[0], 0) * highlight_on_axis(effects, t[1], 1) * highlight_on_axis(effects, t[2], 2);
}

real attenuation_at(FocusEffects effects, vec3 t) {
  return attenuation_on_axis(effects, t[0], 0) * attenuation_on_axis(effects, t[1], 1) *
         attenuation_on_axis(effects, t[2], 2);
}

// V' = V(1 − h) + H·h (eq. 2).
vec3 highlighted(vec3 color, vec3 highlight_color, real h) { return color * (real(1) - h) + highlight_color * h; }
