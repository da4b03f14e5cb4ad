#include "tess/shared_corners.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace slicelens {

namespace {

/// In texture units: far above the rounding of cuts by different planes (some 1e-16), far below a pixel.
constexpr double same_place = 1e-10;

bool is_undisturbed(const LensVertex& vertex) {
  return vertex.texture.w == 1 && glm::length(glm::dvec3(vertex.texture) - vertex.position) < same_place;
}

/// Distinct undisturbed corners, in ascending x.
struct Corners {
  std::vector<LensVertex> sorted;

  std::vector<LensVertex>::iterator from(double x) {
    return std::lower_bound(sorted.begin(), sorted.end(), x,
                            [](const LensVertex& v, double value) { return v.position.x < value; });
  }

  /// The corner known for this place; `vertex` itself where there was none.
  LensVertex known(const LensVertex& vertex) {
    for (auto it = from(vertex.position.x - same_place);
         it != sorted.end() && it->position.x <= vertex.position.x + same_place; ++it) {
      if (glm::length(it->position - vertex.position) < same_place)
        return *it;
    }
    sorted.insert(from(vertex.position.x), vertex);
    return vertex;
  }
};

void drop_repeated(LensPolygon& polygon) {
  LensPolygon result;
  for (const LensVertex& vertex : polygon) {
    if (result.empty() || vertex.position != result.back().position)
      result.push_back(vertex);
  }
  while (result.size() > 1 && result.front().position == result.back().position)
    result.pop_back();
  polygon = result.size() < 3 ? LensPolygon{} : std::move(result);
}

/// The known corners strictly inside the edge from a to b, in order.
void append_inside(LensPolygon& result, Corners& corners, const LensVertex& a, const LensVertex& b) {
  const glm::dvec3 edge = b.position - a.position;
  const double length2 = glm::dot(edge, edge);
  std::vector<std::pair<double, LensVertex>> found;
  const double high = std::max(a.position.x, b.position.x) + same_place;
  for (auto it = corners.from(std::min(a.position.x, b.position.x) - same_place);
       it != corners.sorted.end() && it->position.x <= high; ++it) {
    if (it->position == a.position || it->position == b.position)
      continue;
    const glm::dvec3 d = it->position - a.position;
    const double x = glm::dot(d, edge) / length2;
    if (x > 0 && x < 1 && glm::length(d - x * edge) < same_place)
      found.emplace_back(x, *it);
  }
  std::sort(found.begin(), found.end(), [](const auto& p, const auto& q) { return p.first < q.first; });
  for (const auto& [x, vertex] : found)
    result.push_back(vertex);
}

/// The three corners have no area: b lies on the line through a and c.
bool in_line(const LensPolygon& polygon, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const glm::dvec3 e = polygon[b].position - polygon[a].position;
  const glm::dvec3 f = polygon[c].position - polygon[a].position;
  const glm::dvec3 g = polygon[c].position - polygon[b].position;
  const double longest = std::max({glm::length(e), glm::length(f), glm::length(g)});
  return glm::length(glm::cross(e, f)) <= same_place * longest; // height of the triangle
}

/// Cuts off every second corner, round after round, while five or more are left, so that most of the new
/// edges are short. Only of a polygon without corners inside edges: what is left of such a one has none
/// either, and no triangle is flat.
void cut_in_rounds(std::vector<std::array<std::uint32_t, 3>>& triangles, std::vector<std::uint32_t>& left,
                   const LensPolygon& polygon) {
  const std::size_t n = left.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (in_line(polygon, left[i], left[(i + 1) % n], left[(i + 2) % n]))
      return;
  }
  while (left.size() > 4) {
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < left.size(); i += 2) {
      kept.push_back(left[i]);
      if (i + 1 < left.size())
        triangles.push_back({left[i], left[i + 1], left[(i + 2) % left.size()]});
    }
    left = std::move(kept);
  }
}

} // namespace

void share_corners(const std::vector<LensPolygon*>& polygons) {
  Corners corners;
  for (LensPolygon* polygon : polygons) {
    for (LensVertex& vertex : *polygon) {
      if (is_undisturbed(vertex))
        vertex = corners.known(vertex);
    }
    drop_repeated(*polygon);
  }
  for (LensPolygon* polygon : polygons) {
    LensPolygon result;
    for (std::size_t i = 0; i < polygon->size(); ++i) {
      const LensVertex& a = (*polygon)[i];
      const LensVertex& b = (*polygon)[(i + 1) % polygon->size()];
      result.push_back(a);
      if (is_undisturbed(a) && is_undisturbed(b))
        append_inside(result, corners, a, b);
    }
    *polygon = std::move(result);
  }
}

std::vector<std::array<std::uint32_t, 3>> triangulate(const LensPolygon& polygon) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::uint32_t> left(polygon.size());
  std::iota(left.begin(), left.end(), 0u);
  cut_in_rounds(triangles, left, polygon);
  while (left.size() >= 3) {
    const std::size_t n = left.size();
    const auto at = [&](std::size_t i) { return left[i % n]; };
    // A fan from `apex` has no flat triangle when its first and its last are not flat: the polygon is convex.
    std::size_t apex = 0;
    while (apex < n && (in_line(polygon, at(apex), at(apex + 1), at(apex + 2)) ||
                        in_line(polygon, at(apex), at(apex + n - 1), at(apex + n - 2))))
      ++apex;
    if (apex < n) {
      for (std::size_t i = 1; i + 1 < n; ++i)
        triangles.push_back({at(apex), at(apex + i), at(apex + i + 1)});
      return triangles;
    }
    // Every corner has one more on an edge beside it: cut off a corner and try again with the rest.
    std::size_t ear = 0;
    while (ear < n && in_line(polygon, at(ear + n - 1), at(ear), at(ear + 1)))
      ++ear;
    if (ear == n)
      return triangles; // a line
    triangles.push_back({at(ear + n - 1), at(ear), at(ear + 1)});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

} // namespace slicelens
