// Maps of one axis of the volume, from where a point is shown to where its data is (Cohen, Brodlie and Phillips 2008
// §3.1; docs/papers/cohen.md). Texture coordinates of that axis, [0,1]; the identity outside.
//
// Each gives (u, du/dx); at a crease the slope of one of the two sides.
//
// Worked by hand. Bifocal, data [0.4, 0.6] shown in [0.2, 0.8]: u(0.1) = 0.2 (slope 2), u(0.2) = 0.4, u(0.5) = 0.5 (slope
// 1/3), u(0.9) = 0.8. Fisheye about 1/2 with d = 3: u(1/2) = 1/2 (slope 1/4), u(3/4): g = 1/2, 1/2 / (4 − 3/2) = 1/5, so
// 1/2 + 1/10 = 0.6. Lens, c = 1/2, i = 0.1, o = 0.3, m = 2: u(0.55) = 0.525, u(0.6) = 0.55, u(0.7): 0.05 + 0.1/2 +
// 0.3·(1/2)·(1/4) = 0.1375, so 0.6375; u(0.8) = 0.8; slope at 0.8: 1/2 + 2·0.15/0.2 = 2.

// Piecewise linear through (0,0), (shown_low, low), (shown_high, high), (1,1).
vec2 bifocal_axis(real x, real low, real high, real shown_low, real shown_high) {
  if (x < real(0) || x > real(1)) return vec2(x, real(1));
  if (x < shown_low) return vec2(x * low / shown_low, low / shown_low);
  if (x <= shown_high) {
    real slope = (high - low) / (shown_high - shown_low);
    return vec2(low + (x - shown_low) * slope, slope);
  }
  real slope = (real(1) - high) / (real(1) - shown_high);
  return vec2(high + (x - shown_high) * slope, slope);
}

// Sarkar and Brown's form: with g the distance from the focal point as a fraction of the distance to the border on that
// side, the data's fraction is g/(d + 1 − d·g). Magnification d + 1 at the focal point.
vec2 fisheye_axis(real x, real focal_point, real distortion) {
  if (x < real(0) || x > real(1)) return vec2(x, real(1));
  real border = x < focal_point ? -focal_point : real(1) - focal_point;
  real g = (x - focal_point) / border;
  real divisor = distortion + real(1) - distortion * g;
  return vec2(focal_point + border * g / divisor, (distortion + real(1)) / (divisor * divisor));
}

// Volume lens about `center`: magnified within `inner`, a quadratic with slope 1/m at `inner` and value `outer` at
// `outer`, untouched beyond.
vec2 lens_axis(real x, real center, real inner, real outer, real magnification) {
  real side = x < center ? real(-1) : real(1);
  real d = side * (x - center);
  real m = real(1) / magnification;
  if (d >= outer) return vec2(x, real(1));
  if (d <= inner) return vec2(center + side * d * m, m);
  real s = d - inner;
  real bend = outer * (real(1) - m) / ((outer - inner) * (outer - inner));
  return vec2(center + side * (inner * m + s * m + bend * s * s), m + real(2) * bend * s);
}

// Weight of the connected lens: 1 within `inner`, 0 from `outer` on, 1 − smoothstep between; and its derivative by x.
vec2 lens_weight(real x, real center, real inner, real outer) {
  real side = x < center ? real(-1) : real(1);
  real s = clamp((side * (x - center) - inner) / (outer - inner), real(0), real(1));
  return vec2(real(1) - s * s * (real(3) - real(2) * s), -side * real(6) * s * (real(1) - s) / (outer - inner));
}
