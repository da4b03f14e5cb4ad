#include "tess/lens_footprint.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

/// Largest radius at which the exact profile magnifies by more than q; 1/m > q. The magnification r/f(r)
/// falls from 1/m at the inner radius to 1 at the outer one.
double exact_reach(const LensTessellation& lens, double m, double q) {
  const LamarMap& map = lens.map;
  const auto magnifies = [&](double r) {
    return r > q * radial_profile(lens.border, m, map.inner, map.outer, r).value;
  };
  double near = map.inner;
  double far = map.outer;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (near + far);
    (magnifies(middle) ? near : far) = middle;
  }
  return far;
}

/// The same for the tessellation, whose weights are linear between rings.
double tessellated_reach(const LensTessellation& lens, double m, double q) {
  const LamarMap& map = lens.map;
  const std::size_t n = lens.radial_segments;
  double reach = map.inner;
  double last_radius = map.inner;
  double last_weight = 1 / m;
  for (std::size_t k = 1; k <= n; ++k) {
    const double r = map.inner + (map.outer - map.inner) * static_cast<double>(k) / static_cast<double>(n);
    const double weight = k == n ? 1 : r / radial_profile(lens.border, m, map.inner, map.outer, r).value;
    if (last_weight > q)
      reach = weight > q ? r : glm::mix(last_radius, r, (last_weight - q) / (last_weight - weight));
    last_radius = r;
    last_weight = weight;
  }
  return reach;
}

} // namespace

std::optional<TextureBox> magnified_data(const LensTessellation& lens, const BoxSpace& space, double q) {
  const LamarMap& map = lens.map;
  constexpr int steps = 32; // on either side of the centre
  glm::dvec3 low(1e300);
  glm::dvec3 high(-1e300);
  bool found = false;
  for (int i = -steps; i < steps; ++i) {
    // Of a step's planes the one nearest to the centre magnifies most; magnification falls with depth.
    const double z[2] = {map.depth_outer * i / steps, map.depth_outer * (i + 1) / steps};
    const double m = minification_at(map, std::min(std::abs(z[0]), std::abs(z[1])));
    if (1 / m <= q)
      continue;
    found = true;
    const double reach = std::max(exact_reach(lens, m, q), tessellated_reach(lens, m, q));
    const LensPlane planes[2] = {lens_plane(map, z[0]), lens_plane(map, z[1])};
    const double radius = reach / q * std::max(planes[0].scale, planes[1].scale);
    for (const LensPlane& plane : planes) {
      const glm::dvec3 half = radius * (map.square ? glm::abs(map.right) + glm::abs(map.up)
                                                   : glm::sqrt(map.right * map.right + map.up * map.up));
      low = glm::min(low, plane.axis_point - half);
      high = glm::max(high, plane.axis_point + half);
    }
  }
  if (!found)
    return std::nullopt;
  return TextureBox{texture_from_box(space, low), texture_from_box(space, high)};
}

} // namespace slicelens
