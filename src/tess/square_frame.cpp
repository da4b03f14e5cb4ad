#include "tess/square_frame.h"

#include <algorithm>

namespace slicelens {

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Counter-clockwise: no corner lies right of an edge (but for rounding), and some corner lies left of each.
bool is_convex(const std::vector<glm::dvec2>& polygon) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    double farthest = 0;
    for (const glm::dvec2& corner : polygon) {
      const double side = cross(edge, corner - polygon[i]);
      if (side < -1e-12 * glm::length(edge))
        return false;
      farthest = std::max(farthest, side);
    }
    if (farthest <= 1e-9 * glm::length(edge))
      return false;
  }
  return true;
}

} // namespace

std::vector<std::vector<std::size_t>> frame_around_square(const std::vector<glm::dvec2>& polygon,
                                                          double half) {
  const std::size_t n = polygon.size();
  double area = 0;
  for (std::size_t i = 0; i < n; ++i)
    area += cross(polygon[i], polygon[(i + 1) % n]);
  const std::size_t forward = area > 0 ? 1 : n - 1;
  std::array<std::size_t, 4> farthest{};
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 1; i < n; ++i) {
      if (glm::dot(polygon[i] - polygon[farthest[k]], square_corners[k]) > 0)
        farthest[k] = i;
    }
  }
  // Four convex parts cover the frame once when together they have its outline, as these have.
  std::vector<std::vector<std::size_t>> parts;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    std::vector<std::size_t> part = {next, k};
    std::vector<glm::dvec2> shape = {half * square_corners[next], half * square_corners[k]};
    for (std::size_t i = farthest[k];; i = (i + forward) % n) {
      part.push_back(4 + i);
      shape.push_back(polygon[i]);
      if (i == farthest[next])
        break;
    }
    if (!is_convex(shape))
      return {};
    parts.push_back(std::move(part));
  }
  return parts;
}

} // namespace slicelens
