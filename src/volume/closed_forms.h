// What renderings of the phantoms must show, as formulas of the ray: docs/spaces.md. Everything
// in double precision. Boxes are volume boxes (box_of); rays are in world space and stand for the whole line
// through them, both ways, with any length of direction; lengths and distances are in world units. Colours
// are given straight and returned associated, on a transparent background.
#pragma once

#include "core/box.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>

namespace slicelens {

/// Extinction τ per unit length of a medium whose opacity over `unit_distance` (Δ₀ > 0) is α ∈ [0,1]:
/// τ = −ln(1 − α)/Δ₀; infinite for α = 1.
double extinction_from_opacity(double alpha, double unit_distance);

/// Opacity of a path of `length` ≥ 0 through constant extinction τ ≥ 0: 1 − e^(−τ·length); 0 for length 0.
double opacity_from_extinction(double tau, double length);

/// Length of the line inside the box.
double box_chord(const Box& box, const Ray& ray);

/// Length of the line inside a sphere.
double sphere_chord(const glm::dvec3& center, double radius, const Ray& ray);

/// Length of the line inside the ball of phantom `ball`, whose box is a cube: radius kBallRadius · edge. That
/// is where the phantom's value is > 0.
double ball_chord(const Box& box, const Ray& ray);

/// Distance from the ray's origin, in units of its direction, at which its line first meets a sphere (the
/// smaller of the two, which may be negative); nothing where it misses.
std::optional<double> sphere_hit(const glm::dvec3& center, double radius, const Ray& ray);

/// Distance of the line from a point.
double impact_distance(const glm::dvec3& point, const Ray& ray);

/// X-ray S = ∫ v ds/Δ₀ of phantom `blob` with α(v) = v, along the whole line: as if the Gaussian filled
/// space, S = (σ/Δ₀)·√(2π)·amplitude·e^(−b²/2σ²), b the impact distance. σ = kBlobSigma·edge. Along a chord
/// through the middle of a face, 4σ from the centre, the part outside the box is 6.3e-5 of S.
double blob_xray(const Box& box, const Ray& ray, double unit_distance);

/// The same integral over the part of the line inside the box, by the error function. Exact for what a
/// renderer of the box sees; 0 where the line misses the box.
double blob_xray_clipped(const Box& box, const Ray& ray, double unit_distance);

/// Largest value of `blob` along the line inside the box (amplitude·e^(−b²/2σ²) where the nearest point to
/// the centre is inside); 0 where the line misses the box.
double blob_mip(const Box& box, const Ray& ray);

/// Mean of `blob` along the line inside the box: its X-ray over the chord. 0 where the line misses the box.
double blob_average(const Box& box, const Ray& ray);

/// What trilinear sampling, clamped to the edge, of the voxels of phantom `ramp` with `nx` voxels along x
/// gives at texture coordinate t_x: linear between the outer voxel centres and constant in the outer half
/// voxels, clamp(t_x, ½/nx, 1 − ½/nx).
double ramp_value(double t_x, std::size_t nx);

/// Smallest, largest and mean value of `ramp` so sampled, along the line inside the box.
struct RampRange {
  double least = 0;
  double most = 0;
  double average = 0;
};
std::optional<RampRange> ramp_range(const Box& box, const Ray& ray,
                                    std::size_t nx); ///< nothing where it misses

/// DVR of phantom `ramp` with `nx` voxels along x, trilinearly sampled (see ramp_value), under the transfer
/// function that goes linearly from `low` at value 0 to `high` at value 1 (straight r, g, b, opacity per
/// `unit_distance`): the limit of infinitely dense sampling,
///   C = ∫ c(s)·τ(s)·T(s) ds, A = 1 − T(end), τ = −ln(1 − α(s))/Δ₀, T(s) = exp(−∫τ),
/// integrated from the ray's origin side (along `direction`). The transmittance T is in closed form
/// (∫ −ln u du = u − u·ln u); the colour is c·dT integrated by parts, whose remaining ∫ T ds is by adaptive
/// Gauss-Legendre quadrature to 1e-13 of the chord.
glm::dvec4 ramp_dvr(const Box& box, const Ray& ray, std::size_t nx, const glm::dvec4& low,
                    const glm::dvec4& high, double unit_distance);

/// DVR of phantom `slabs` cut by a step transfer function at the value between the slabs: `front` where
/// t_y < ½ and `back` where t_y > ½ (straight r, g, b, opacity per `unit_distance`), composited in the order
/// in which the ray meets them. Exact for trilinear sampling as well: the value crosses the middle at t_y =
/// ½.
glm::dvec4 slabs_dvr(const Box& box, const Ray& ray, const glm::dvec4& front, const glm::dvec4& back,
                     double unit_distance);

/// The same slabs as two objects of a two-level picture: the half t_y < ½ shows its line integral,
/// min(scale·S, 1) with S = α·length/Δ₀, in `front`'s colour; the other half is composited as above.
glm::dvec4 slabs_xray_front(const Box& box, const Ray& ray, const glm::dvec4& front, const glm::dvec4& back,
                            double unit_distance, double scale);

/// Phantom `marschner-lobb` between its voxels: ρ at texture coordinates t (Marschner and Lobb, An Evaluation
/// of Reconstruction Filters for Volume Rendering, IEEE Visualization 1994, §5, with the paper's f_M = 6 and
/// α = 0.25 on [−1,1]³), in [0, 1].
double marschner_lobb(const glm::dvec3& t);

/// Its derivatives by t.
glm::dvec3 marschner_lobb_gradient(const glm::dvec3& t);

} // namespace slicelens
