// Samples of several volumes at one place as one sample (Brunet, Nowak and Gleicher 2006 §4.3: "sum, difference, emitted
// color mixing"): straight colour, and opacity per reference length. All before the correction for the sample distance, so
// that the picture does not depend on it.
//
// With opacities a_i and colours c_i:
//   0  mix         all in one place, each in the way of all: a = 1 − Π(1 − a_i), c = Σ a_i c_i / Σ a_i
//   1  sum         a = min(Σ a_i, 1), the same colour
//   2  max         the sample with the largest a_i; of equal ones the first
//   3  difference  between the first and the sum of the others: a = |a_0 − min(Σ a_i, 1)|, in the colour of the larger side
//
// By hand, red with 1/2 and green with 1/4: mix a = 5/8, c = (2/3, 1/3, 0); sum a = 3/4, the same c; max a = 1/2, red;
// difference a = 1/4, red.

vec4 combined(vec4 samples[4], int count, int how) {
  vec3 emitted = vec3(real(0), real(0), real(0));  // Σ a c
  real absorbed = real(0);                         // Σ a
  real through = real(1);                          // Π (1 − a)
  vec4 largest = samples[0];
  for (int i = 0; i < count; ++i) {
    vec3 color = vec3(samples[i].x, samples[i].y, samples[i].z);
    emitted = emitted + samples[i].w * color;
    absorbed = absorbed + samples[i].w;
    through = through * (real(1) - samples[i].w);
    if (samples[i].w > largest.w) largest = samples[i];
  }
  vec3 mixed = absorbed > real(0) ? emitted / absorbed : emitted;
  if (how == 0) return vec4(mixed, real(1) - through);
  if (how == 1) return vec4(mixed, min(absorbed, real(1)));
  if (how == 2) return largest;
  vec3 first = vec3(samples[0].x, samples[0].y, samples[0].z);
  real rest = absorbed - samples[0].w;
  vec3 other = rest > real(0) ? (emitted - samples[0].w * first) / rest : emitted;
  real difference = samples[0].w - min(rest, real(1));
  return difference >= real(0) ? vec4(first, difference) : vec4(other, -difference);
}
