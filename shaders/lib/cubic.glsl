// The cubic B-spline between voxels of one axis: its weights (Sigg and Hadwiger 2005, GPU Gems 2 chapter 20, §20.2), and
// the two linear fetches that stand for its four voxels.
//
// At position i + f, 0 ≤ f < 1, the voxels i−1, i, i+1, i+2 weigh
//
//   (1−f)³/6,  (4 − 6f² + 3f³)/6,  (4 − 6(1−f)² + 3(1−f)³)/6,  f³/6
//
// By hand: f = 0: 1/6, 2/3, 1/6, 0;  f = 1/2: 1/48, 23/48, 23/48, 1/48;  f = 1/4: 27/384, 235/384, 121/384, 1/384.
// The weights sum to 1 and Σ w·i = x: constants and ramps stay as they are. Σ w·i² = x² + 1/3: the filter smooths and
// goes through no voxel's own value.

vec4 cubic_weights(real f) {
  real g = real(1) - f;
  return vec4(g * g * g, real(4) + real(3) * f * f * (f - real(2)), real(4) + real(3) * g * g * (g - real(2)), f * f * f) /
         real(6);
}

// Voxels i−1 and i by one linear fetch, i+1 and i+2 by another: places from voxel i (in voxels), then their weights.
// By hand: f = 0: −1/5, 1, 5/6, 1/6;  f = 1/2: −1/24, 25/24, 1/2, 1/2.
vec4 cubic_fetches(real f) {
  vec4 w = cubic_weights(f);
  real below = w.x + w.y;
  real above = w.z + w.w;
  return vec4(w.y / below - real(1), real(1) + w.w / above, below, above);
}
