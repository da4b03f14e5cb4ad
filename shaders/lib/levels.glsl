// Which level of a mip pyramid a sample reads, from how much the lens magnifies there: LaMar, Hamann and Joy 2001 leave
// the blending of two resolutions through the warp region open (§6).
//
//   level = (L−1)·(1 − ln q / ln Q), clamped to [0, L−1]
//
// q = r/f(r) is the local tangential magnification, the homogeneous weight that LaMar's vertices carry; Q the largest
// zoom of the scene's lenses; L the number of levels. Data shown as it is (q = 1) is read at the coarsest level L−1,
// the zoom region of the strongest lens (q = Q) at level 0, and each level in between has its equal share of ln q. A
// level between two whole numbers blends these two linearly. With Q = 2^(L−1) a voxel of the level read covers the same
// length of the picture everywhere.
//
// Both ends are stretched by band, so that they are reached exactly though q is interpolated and rounded: a level is
// then never asked for where no lens needs it.

real level_band() { return real(1) / real(1024); }

// q > 0; coarsest = L−1; log_zoom = ln Q, 0 without a lens: everything at the coarsest level.
real level_of(real q, real coarsest, real log_zoom) {
  real band = level_band();
  real share = log_zoom > real(0) ? real(1) - log(q) / log_zoom : real(1);
  return coarsest * clamp(share * (real(1) + real(2) * band) - band, real(0), real(1));
}

// Its inverse in the border: the q at which a level > 0 is read; smaller ones read coarser levels.
real magnification_of(real level, real coarsest, real log_zoom) {
  real band = level_band();
  real share = (level / coarsest + band) / (real(1) + real(2) * band);
  return exp((real(1) - share) * log_zoom);
}
