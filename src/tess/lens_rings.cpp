// Radial profile of the tessellation, and how many segments it needs.

#include "core/errors.h"
#include "tess/lens_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace slicelens {

namespace {

constexpr double pi = 3.14159265358979323846;

/// Calls `visit(r)` for positions that find the largest error of n segments: within one segment it is a
/// smooth hump, so 16 positions know it to a few percent, 64 with few segments to a permille.
void visit_border(double inner, double outer, std::size_t segments,
                  const std::function<void(double)>& visit) {
  const std::size_t steps = segments * (segments <= 16 ? 256 : 32);
  for (std::size_t i = 1; i < steps; ++i)
    visit(inner + (outer - inner) * static_cast<double>(i) / static_cast<double>(steps));
}

/// No point of the border is shown farther than `shift` (box space) from where the exact profile shows it:
/// f(r − shift) ≤ tessellated radius ≤ f(r + shift). Dividing the error by the slope instead asks for too
/// many segments where the slope changes within the shift.
bool shown_within(const LamarLens& lens, std::size_t segments, double shift) {
  const double m = 1 / lens.zoom;
  const auto exact = [&](double r) {
    return radial_profile(lens.border, m, lens.inner, lens.outer, std::max(r, 0.0)).value;
  };
  bool within = true;
  visit_border(lens.inner, lens.outer, segments, [&](double r) {
    if (!within)
      return;
    const double shown = tessellated_radius(lens.border, m, lens.inner, lens.outer, segments, r);
    within = exact(r - shift) <= shown && shown <= exact(r + shift);
  });
  return within;
}

std::size_t adaptive_segments(const LamarLens& lens, double pixels_per_unit) {
  const auto good = [&](std::size_t n) { return shown_within(lens, n, 0.5 / pixels_per_unit); };
  // The error falls with n, so bisection between powers of two finds the fewest.
  std::size_t high = 1;
  while (!good(high)) {
    high *= 2;
    if (high > max_radial_segments) {
      throw UsageError("warp 'lamar': no number of radial_segments up to " +
                       std::to_string(max_radial_segments) +
                       " keeps the error under half a pixel; lower zoom or widen the border");
    }
  }
  std::size_t low = high / 2;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (good(middle) ? high : low) = middle;
  }
  return high;
}

/// The ring's corners. Circles start on the right axis, so that a multiple of four touches the bounding
/// square's middles.
std::vector<glm::dvec2> ring_of(const LamarLens& lens) {
  if (lens.shape == LensShape::square)
    return {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  std::vector<glm::dvec2> ring;
  for (std::size_t j = 0; j < lens.angular_segments; ++j) {
    const double angle = 2 * pi * static_cast<double>(j) / static_cast<double>(lens.angular_segments);
    glm::dvec2 direction(std::cos(angle), std::sin(angle));
    for (int axis = 0; axis < 2; ++axis) {
      // cos(π/2) is 6e-17 in floating point; on the axes the ring must touch the square exactly.
      if (std::abs(direction[axis]) < 1e-15)
        direction[axis] = 0;
    }
    ring.push_back(direction);
  }
  return ring;
}

} // namespace

double tessellated_radius(LensBorder border, double minification, double inner, double outer,
                          std::size_t segments, double r) {
  const double width = (outer - inner) / static_cast<double>(segments);
  const double k = std::clamp(std::floor((r - inner) / width), 0.0, static_cast<double>(segments - 1));
  const double r0 = inner + k * width;
  const double r1 = r0 + width;
  // The simple border has no profile of its own: its ends are the zoom's and the normal region's.
  const double q0 = r0 / radial_profile(border, minification, inner, outer, r0).value;
  const double q1 = r1 / radial_profile(border, minification, inner, outer, r1).value;
  return r / glm::mix(q0, q1, (r - r0) / width);
}

double radial_error(LensBorder border, double minification, double inner, double outer,
                    std::size_t segments) {
  double largest = 0;
  visit_border(inner, outer, segments, [&](double r) {
    const double exact = radial_profile(border, minification, inner, outer, r).value;
    largest = std::max(largest,
                       std::abs(tessellated_radius(border, minification, inner, outer, segments, r) - exact));
  });
  return largest;
}

LensTessellation prepare_lens(const LamarLens& lens, const BoxSpace& space, const WarpView& view,
                              double pixels_per_unit) {
  validate(lens);
  validate_place(lens, space);
  LensTessellation result;
  result.map = lamar_map(lens, space, view);
  result.border = lens.border;
  result.homogeneous = lens.homogeneous;
  result.bounded = lens.bounded || lens.shape == LensShape::square;
  result.ring = ring_of(lens);
  result.radial_segments = lens.border == LensBorder::simple ? 1
                           : lens.radial_segments            ? *lens.radial_segments
                                                             : adaptive_segments(lens, pixels_per_unit);
  return result;
}

} // namespace slicelens
