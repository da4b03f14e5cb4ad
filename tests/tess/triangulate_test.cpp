// Convex polygons as triangles: they cover it once, none is flat, and their edges are short.

#include "catch.h"
#include "tess/shared_corners.h"

#include <cmath>
#include <map>
#include <utility>

using namespace slicelens;

namespace {

constexpr double pi = 3.14159265358979323846;

/// Corners of a regular polygon about (2, 1) on a circle of radius 1.
LensPolygon regular(std::size_t n) {
  LensPolygon polygon;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(n);
    polygon.push_back({{2 + std::cos(angle), 1 + std::sin(angle), 0}, glm::dvec4(0, 0, 0, 1)});
  }
  return polygon;
}

struct Measures {
  std::size_t triangles = 0;
  double area = 0;
  double least_area = 1e9;
  double inner_edges = 0; ///< length of the edges that two triangles share, each once
  bool whole = true;      ///< no edge belongs to three triangles, and those of one are the polygon's
};

Measures measured(const LensPolygon& polygon) {
  Measures result;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : triangulate(polygon)) {
    const glm::dvec3 a = polygon[t[0]].position;
    const double area = 0.5 * glm::cross(polygon[t[1]].position - a, polygon[t[2]].position - a).z;
    ++result.triangles;
    result.area += area;
    result.least_area = std::min(result.least_area, area);
    for (std::size_t k = 0; k < 3; ++k)
      ++edges[std::minmax(t[k], t[(k + 1) % 3])];
  }
  for (const auto& [edge, count] : edges) {
    const std::size_t apart = edge.second - edge.first;
    const bool outline = apart == 1 || apart == polygon.size() - 1;
    result.whole = result.whole && count == (outline ? 1 : 2);
    if (!outline)
      result.inner_edges += glm::length(polygon[edge.first].position - polygon[edge.second].position);
  }
  return result;
}

} // namespace

TEST_CASE("a convex polygon of any number of corners is covered once by counter-clockwise triangles") {
  for (std::size_t n = 3; n <= 70; ++n) {
    CAPTURE(n);
    const Measures m = measured(regular(n));
    const auto sides = static_cast<double>(n);
    CHECK(m.triangles == n - 2);
    CHECK(m.whole);
    CHECK(std::abs(m.area - 0.5 * sides * std::sin(2 * pi / sides)) < 1e-13); // rounding of sums
    // The smallest triangle there can be: two neighbouring edges.
    const double step = 2 * pi / sides;
    CHECK(m.least_area > (std::sin(step) - 0.5 * std::sin(2 * step)) * (1 - 1e-9));
  }
}

TEST_CASE("a polygon of 32 corners is cut by half the edge length of a fan") {
  // Every second corner cut off, again and again: 16 chords over 2 edges, 8 over 4, 4 over 8, one diagonal.
  const auto chord = [](int edges) { return 2 * std::sin(pi * edges / 32); };
  const double rounds = 16 * chord(2) + 8 * chord(4) + 4 * chord(8) + chord(16);
  double fan = 0;
  for (int edges = 2; edges <= 30; ++edges)
    fan += chord(edges);
  const double length = measured(regular(32)).inner_edges;
  CHECK(std::abs(length - rounds) < 1e-12);
  CHECK(length < 0.5 * fan);
}

TEST_CASE("corners inside edges are used and make no flat triangle") {
  // A square with every edge cut in k parts.
  for (const int k : {2, 3, 5, 8}) {
    CAPTURE(k);
    LensPolygon polygon;
    const glm::dvec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (std::size_t i = 0; i < 4; ++i) {
      for (int j = 0; j < k; ++j)
        polygon.push_back({glm::mix(corners[i], corners[(i + 1) % 4], static_cast<double>(j) / k), {}});
    }
    const Measures m = measured(polygon);
    CHECK(m.triangles == polygon.size() - 2);
    CHECK(m.whole);
    CHECK(std::abs(m.area - 1) < 1e-14);
    CHECK(m.least_area > 0.49 / (k * k)); // on a lattice of k × k none is below 1/2k²
  }
}
