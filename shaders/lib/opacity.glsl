// Opacity for another sample distance (docs/pipeline.md): α' = 1 − (1 − α)^ratio, ratio = Δ/Δ₀.
//
// Written as −expm1(ratio · log1p(−α)), because 1 − pow(1 − α, ratio) loses what a thin transfer function is made of:
// at α = 1e-4 the float subtraction alone costs 3e-4 of the result, and drivers compute pow to about 1e-5.

// log(1 − a) for a in [0, 1): 2·atanh(−a/(2 − a)), by its series where that converges fast.
real log_one_minus(real a) {
  real z = a / (real(2) - a);
  real z2 = z * z;
  real series = real(-2) * z * (real(1) + z2 * (real(1) / real(3) + z2 * (real(1) / real(5) + z2 * (real(1) / real(7) +
                z2 * (real(1) / real(9) + z2 * (real(1) / real(11) + z2 * (real(1) / real(13))))))));
  return a < real(0.3) ? series : log(max(real(1) - a, real(1e-30)));
}

// 1 − exp(x) for x ≤ 0, by its series near 0. Degree 11 leaves 3e-14 at the switch.
real one_minus_exp(real x) {
  real series = -x * (real(1) + x / real(2) * (real(1) + x / real(3) * (real(1) + x / real(4) * (real(1) + x / real(5) *
                (real(1) + x / real(6) * (real(1) + x / real(7) * (real(1) + x / real(8) * (real(1) + x / real(9) *
                (real(1) + x / real(10) * (real(1) + x / real(11)))))))))));
  return x > real(-0.35) ? series : real(1) - exp(x);
}

// alpha in [0, 1] per reference length; ratio > 0, sample distance in reference lengths. Exactly 0 at 0, exactly 1 at 1.
real corrected_opacity(real alpha, real ratio) {
  real corrected = one_minus_exp(ratio * log_one_minus(alpha));
  return alpha >= real(1) ? real(1) : corrected;
}
