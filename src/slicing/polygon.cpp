#include "slicing/polygon.h"

#include <array>

namespace slicelens {

namespace {

/// The four edges of each face in order around it, as pairs of corner numbers (bit 0 x, bit 1 y, bit 2 z).
struct FaceEdge {
  int a;
  int b;
};
constexpr std::array<std::array<FaceEdge, 4>, 6> face_edges = {{
    {{{0, 2}, {2, 6}, {6, 4}, {4, 0}}}, // x = 0
    {{{1, 3}, {3, 7}, {7, 5}, {5, 1}}}, // x = 1
    {{{0, 1}, {1, 5}, {5, 4}, {4, 0}}}, // y = 0
    {{{2, 3}, {3, 7}, {7, 6}, {6, 2}}}, // y = 1
    {{{0, 1}, {1, 3}, {3, 2}, {2, 0}}}, // z = 0
    {{{4, 5}, {5, 7}, {7, 6}, {6, 4}}}, // z = 1
}};

glm::dvec3 corner(int k) { return {k & 1, (k >> 1) & 1, (k >> 2) & 1}; }

/// An edge of the cube that the plane crosses, named by its two corners in ascending order.
struct Crossing {
  int low;
  int high;
  bool operator==(const Crossing&) const = default;
};

/// The part of the cut that lies in one face.
struct Segment {
  Crossing from;
  Crossing to;
};

void append_distinct(Polygon& polygon, const glm::dvec3& point) {
  constexpr double merge =
      1e-12; // of the cube's edge: a plane through a corner gives that corner on several edges
  if (!polygon.empty() && glm::length(polygon.back() - point) < merge)
    return;
  polygon.push_back(point);
}

/// The cut as at most one segment a face. A corner on the plane counts as above it, so a convex plane crosses
/// two edges of a face or none.
std::vector<Segment> segments_of(const std::array<double, 8>& value) {
  std::vector<Segment> segments;
  for (const auto& face : face_edges) {
    std::array<Crossing, 4> found{};
    std::size_t count = 0;
    for (const auto& [a, b] : face) {
      const bool above_a = value[static_cast<std::size_t>(a)] >= 0;
      const bool above_b = value[static_cast<std::size_t>(b)] >= 0;
      if (above_a != above_b)
        found[count++] = {std::min(a, b), std::max(a, b)};
    }
    if (count == 2)
      segments.push_back({found[0], found[1]});
  }
  return segments;
}

} // namespace

double signed_value(const Plane& plane, const glm::dvec3& x) {
  return glm::dot(plane.normal, x) - plane.offset;
}

Plane pull_back(const Plane& plane, const glm::dmat4& to_from) {
  const glm::dvec4 row = glm::dvec4(plane.normal, -plane.offset) * to_from;
  return {glm::dvec3(row), -row.w};
}

Polygon cut_unit_cube(const Plane& plane) {
  std::array<double, 8> value{};
  for (int k = 0; k < 8; ++k)
    value[static_cast<std::size_t>(k)] = signed_value(plane, corner(k));
  std::vector<Segment> segments = segments_of(value);
  if (segments.empty())
    return {};

  // Neighbouring faces share the crossed edge between them: walk from segment to segment around the cube.
  Polygon polygon;
  Crossing at = segments.front().from;
  while (!segments.empty()) {
    std::size_t next = 0;
    while (next < segments.size() && !(segments[next].from == at) && !(segments[next].to == at))
      ++next;
    if (next == segments.size())
      break;
    const double v0 = value[static_cast<std::size_t>(at.low)];
    const double v1 = value[static_cast<std::size_t>(at.high)];
    append_distinct(polygon, glm::mix(corner(at.low), corner(at.high), v0 / (v0 - v1)));
    at = segments[next].from == at ? segments[next].to : segments[next].from;
    segments.erase(segments.begin() + static_cast<std::ptrdiff_t>(next));
  }
  if (polygon.size() > 1 && glm::length(polygon.back() - polygon.front()) < 1e-12)
    polygon.pop_back();
  if (polygon.size() < 3)
    return {}; // touches an edge or a corner only
  return polygon;
}

Polygon clip(const Polygon& polygon, const Plane& plane) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double va = signed_value(plane, a);
    const double vb = signed_value(plane, b);
    if (va >= 0)
      append_distinct(result, a);
    if ((va >= 0) != (vb >= 0))
      append_distinct(result, glm::mix(a, b, va / (va - vb)));
  }
  if (result.size() > 1 && glm::length(result.back() - result.front()) < 1e-12)
    result.pop_back();
  if (result.size() < 3)
    return {};
  return result;
}

double area(const Polygon& polygon) {
  glm::dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += glm::cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
  }
  return 0.5 * glm::length(sum);
}

} // namespace slicelens
