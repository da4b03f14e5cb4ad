// Where a sample finds its label: labels are numbers of objects and are never interpolated.

// The voxel of n that holds the coordinate t in [0, 1]. A point within a thousandth of a voxel of the face between two
// belongs to the upper one: slices and rays often pass exactly there, and rounding must not decide.
int label_voxel(real t, int n) {
  int i = int(floor(t * real(n) + real(0.001)));
  return i < 0 ? 0 : (i >= n ? n - 1 : i);
}
