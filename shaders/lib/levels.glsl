// Which level of a mip pyramid a sample reads. A level between two whole numbers blends these two linearly.
//
// render.levels: from how much the lens magnifies there. LaMar, Hamann and Joy 2001 leave the blending of two resolutions
// through the warp region open (§6).
//
//   level = (L−1)·(1 − ln q / ln Q), clamped to [0, L−1]
//
// q = r/f(r) is the local tangential magnification, the homogeneous weight that LaMar's vertices carry; Q the largest
// zoom of the scene's lenses; L the number of levels. Data shown as it is (q = 1) is read at the coarsest level L−1,
// the zoom region of the strongest lens (q = Q) at level 0, and each level in between has its equal share of ln q. With
// Q = 2^(L−1) a voxel of the level read covers the same length of the picture everywhere.
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

// render.footprint: from the spacing of samples in the data (Brunet, Nowak and Gleicher 2006 §3.2).
//
//   level = log2 s, clamped to [0, L−1]
//
// s is the largest singular value of d(voxel index)/d(pixel, sample): the longest way, in voxels of the data, that a unit
// step among the samples goes. Voxels of level log2 s are as long. The widest direction decides, so nothing aliases; where a
// map squeezes one direction only, the others become softer than they need be.

// The square root of the largest eigenvalue of mᵀm in closed form (Smith 1961): of the symmetric matrix q + p·b, with q the
// mean of the eigenvalues, p their spread and tr b = 0, it is q + 2p·cos(acos(det b/2)/3). Exact where three values are
// one (p = 0); in floats right to 1e-3 where two are (the derivative of acos is unbounded there), and better elsewhere. A power
// iteration is slowest in just that case, and Frobenius' bound is up to √3 too large: 0.8 levels too soft.
real largest_singular_value(mat3 m) {
  mat3 a = transpose(m) * m;
  real q = (a[0][0] + a[1][1] + a[2][2]) / real(3);
  vec3 d = vec3(a[0][0] - q, a[1][1] - q, a[2][2] - q);
  vec3 e = vec3(a[1][0], a[2][0], a[2][1]);
  real p = sqrt((dot(d, d) + real(2) * dot(e, e)) / real(6));
  real inverse = real(1) / max(p, real(1e-6) * q + real(1e-30));
  d = d * inverse;
  e = e * inverse;
  real determinant = d.x * (d.y * d.z - e.z * e.z) - e.x * (e.x * d.z - e.z * e.y) + e.y * (e.x * e.z - d.y * e.y);
  real angle = acos(clamp(real(0.5) * determinant, real(-1), real(1))) / real(3);
  return sqrt(max(q + real(2) * p * cos(angle), real(0)));
}

// `steps`: d(voxel index)/d(pixel, sample); coarsest = L−1.
real footprint_level(mat3 steps, real coarsest) {
  return clamp(log2(max(largest_singular_value(steps), real(1e-6))), real(0), coarsest);
}
