// The parts of a convex polygon around a square cover the rest of it once.

#include "catch.h"
#include "tess/square_frame.h"

#include <algorithm>
#include <cmath>
#include <random>

using namespace slicelens;

namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// How many of the polygons hold the point; -1 within 1e-9 of an edge's line, where rounding decides.
int count_at(const std::vector<std::vector<glm::dvec2>>& polygons, const glm::dvec2& p) {
  int found = 0;
  for (const auto& polygon : polygons) {
    bool inside = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const double side = cross(polygon[(i + 1) % polygon.size()] - polygon[i], p - polygon[i]);
      if (std::abs(side) < 1e-9)
        return -1;
      inside = inside && side > 0;
    }
    found += inside ? 1 : 0;
  }
  return found;
}

std::vector<std::vector<glm::dvec2>> parts_of(const std::vector<glm::dvec2>& polygon, double half) {
  std::vector<std::vector<glm::dvec2>> result;
  for (const auto& part : frame_around_square(polygon, half)) {
    result.emplace_back();
    for (const std::size_t i : part)
      result.back().push_back(i < 4 ? half * square_corners[i] : polygon[i - 4]);
  }
  return result;
}

} // namespace

TEST_CASE("a square in the middle of a square has four trapezoids around it") {
  const std::vector<glm::dvec2> outer = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
  const auto parts = frame_around_square(outer, 1);
  // Each: the square's edge and the outer edge on the same side.
  const std::vector<std::vector<std::size_t>> expected = {
      {1, 0, 6, 7}, {2, 1, 7, 4}, {3, 2, 4, 5}, {0, 3, 5, 6}};
  CHECK(parts == expected);
}

TEST_CASE("parts around a square cover random convex polygons once, in either sense") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int whole = 0;
  for (int round = 0; round < 400; ++round) {
    // Corners on an ellipse in order of angle: convex.
    std::vector<double> angles(3 + static_cast<std::size_t>(6 * unit(random)));
    for (double& angle : angles)
      angle = 2 * 3.14159265358979323846 * unit(random);
    std::sort(angles.begin(), angles.end());
    const glm::dvec2 center(unit(random) - 0.5, unit(random) - 0.5);
    std::vector<glm::dvec2> polygon;
    for (const double angle : angles)
      polygon.push_back(center + glm::dvec2(3 * std::cos(angle), 2 * std::sin(angle)));
    if (round % 2 == 1)
      std::reverse(polygon.begin(), polygon.end());
    const double half = 0.1 + 0.6 * unit(random);
    const auto parts = parts_of(polygon, half);
    if (parts.empty())
      continue;
    ++whole;
    std::vector<glm::dvec2> forward = polygon;
    if (round % 2 == 1)
      std::reverse(forward.begin(), forward.end());
    for (int i = 0; i < 200; ++i) {
      const glm::dvec2 p(8 * unit(random) - 4, 6 * unit(random) - 3);
      const int found = count_at(parts, p);
      const bool in_square = std::max(std::abs(p.x), std::abs(p.y)) < half;
      const int wanted = in_square ? 0 : count_at({forward}, p);
      if (found < 0 || wanted < 0)
        continue;
      CAPTURE(round, p.x, p.y);
      REQUIRE(found == wanted);
    }
  }
  CHECK(whole > 50); // of 400; the others' squares lie across the outline or are seen past a corner
}

TEST_CASE("a square across or touching the outline has no such parts") {
  const std::vector<glm::dvec2> outer = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}};
  CHECK(frame_around_square(outer, 3).empty());
  CHECK(frame_around_square(outer, 4).empty());
  CHECK(frame_around_square({{-0.5, -3}, {3, -3}, {3, 3}, {-0.5, 3}}, 1).empty());
}
