// Where a ray crosses a surface between two samples (render.mode iso). The host provides: real iso_value(vec3 p), the value
// that is shown at p.

// The crossing of `iso` between two samples of which one lies below it and the other does not: eight halvings, then a straight
// line, so the point is within 2⁻⁸ of the samples' distance, and exact where values are linear.
vec3 refined_crossing(vec3 a, vec3 b, real value_a, real value_b, real iso) {
  real low = real(0);
  real high = real(1);
  real low_value = value_a - iso;
  real high_value = value_b - iso;
  for (int i = 0; i < 8; ++i) {
    real middle = real(0.5) * (low + high);
    real value = iso_value(a + middle * (b - a)) - iso;
    bool before = (value < real(0)) == (low_value < real(0));
    low = before ? middle : low;
    low_value = before ? value : low_value;
    high = before ? high : middle;
    high_value = before ? high_value : value;
  }
  return a + (low + (high - low) * low_value / (low_value - high_value)) * (b - a);
}
