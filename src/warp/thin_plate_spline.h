// Thin-plate splines in space (docs/papers/brunet_maps.md).
#pragma once

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace slicelens {

/// f(p) = Σ weights_i·|p − centers_i| + linear·p + constant, with Σ weights_i = 0 and Σ weights_i·centers_iᵀ
/// = 0: of all functions with these values at these centres the one that bends least (kernel U(r) = r of
/// three dimensions; Bookstein 1989, Davis et al. 1997).
struct ThinPlateSpline {
  std::vector<glm::dvec3> centers;
  std::vector<glm::dvec3> weights;
  glm::dmat3 linear{1};
  glm::dvec3 constant{0};
};

/// The spline with f(at_i) = values_i. `stiffness` λ ≥ 0 gives up hitting them for bending less: the diagonal
/// of the kernel's matrix is −λ (a length; λ → ∞ leaves the least-squares affine map). Solved in double
/// precision by Gauss's elimination with pivots. Throws UsageError where the centres do not determine it:
/// fewer than four, or all in one plane, or two of them equal.
ThinPlateSpline fit_thin_plate_spline(std::span<const glm::dvec3> at, std::span<const glm::dvec3> values,
                                      double stiffness);

glm::dvec3 evaluate(const ThinPlateSpline& spline, const glm::dvec3& p);

} // namespace slicelens
