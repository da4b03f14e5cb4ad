// Opacity of a pre-integrated segment (Engel, Kraus and Ertl 2001). Needs lib/opacity.glsl.

// `alpha` of a segment of `ratio` reference lengths, whose opacity per reference length is multiplied by `attenuation` in
// [0, 1], and which is `stretch` times as long: 1 − (1 − attenuation·α₀)^(ratio·stretch) with α₀ = 1 − (1 − α)^(1/ratio).
// An α₀ near 1 is never formed: floats would take it for 1.
real segment_opacity(real alpha, real attenuation, real ratio, real stretch) {
  real reference = log_one_minus(alpha) / ratio;  // ln of what goes through a reference length
  real thin = log_one_minus(attenuation * one_minus_exp(reference));
  real dense = log(max((real(1) - attenuation) + attenuation * exp(reference), real(1e-30)));
  real attenuated = reference > real(-0.35) ? thin : dense;
  return attenuation < real(1) ? one_minus_exp(ratio * stretch * attenuated) : corrected_opacity(alpha, stretch);
}
