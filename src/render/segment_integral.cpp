#include "render/segment_integral.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

glm::dvec4 segment_integral(const TransferFunction& transfer, double front, double back, double ratio,
                            int steps) {
  glm::dvec4 gathered(0);
  const auto add = [&](double value, double share) {
    const glm::dvec4 rgba = evaluate(transfer, value);
    const double extinction = -std::log(std::max(1 - rgba.a, 1e-30));
    const double through = 1 - gathered.a;
    const double opacity = -std::expm1(-ratio * share * extinction);
    gathered += through * opacity * glm::dvec4(glm::dvec3(rgba), 1);
  };
  if (front == back) {
    add(front, 1);
    return gathered;
  }
  const auto piece = [&](double from, double to) { // shares of the way from front to back
    for (int i = 0; i < steps && to > from; ++i) {
      const double s = from + (to - from) * (i + 0.5) / steps;
      add(front + s * (back - front), (to - from) / steps);
    }
  };
  const auto& points = transfer.points;
  const auto count = points.size();
  double from = 0;
  for (std::size_t i = 0; i < count; ++i) { // knots in the order in which the segment meets them
    const double knot = points[front < back ? i : count - 1 - i].value;
    const double s = (knot - front) / (back - front);
    if (s <= from || s >= 1)
      continue;
    piece(from, s);
    from = s;
  }
  piece(from, 1);
  return gathered;
}

} // namespace slicelens
