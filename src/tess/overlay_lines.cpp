#include "tess/overlay_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace slicelens {

namespace {

constexpr double pi = 3.14159265358979323846;

Polyline ring_line(const LensTessellation& lens, const BoxSpace& space, const LensPlane& plane,
                   double radius) {
  std::vector<glm::dvec2> directions = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  if (!lens.map.square) {
    constexpr int steps = 256; // 8e-5 of the radius from round
    directions.clear();
    for (int i = 0; i < steps; ++i)
      directions.emplace_back(std::cos(2 * pi * i / steps), std::sin(2 * pi * i / steps));
  }
  Polyline line;
  for (const glm::dvec2& d : directions) {
    const glm::dvec3 across = d.x * lens.map.right + d.y * lens.map.up;
    line.push_back(texture_from_box(space, plane.axis_point + radius * plane.scale * across));
  }
  line.push_back(line.front());
  return line;
}

using Place = std::array<double, 3>;

Place place_of(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

} // namespace

LensOutline lens_outline(const LensTessellation& lens, const BoxSpace& space, double z) {
  const LensPlane plane = lens_plane(lens.map, z);
  return {ring_line(lens, space, plane, lens.map.inner), ring_line(lens, space, plane, lens.map.outer)};
}

std::vector<Polyline> mesh_edges(const LensMesh& mesh, bool diagonals) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[i + k];
      const std::uint32_t b = mesh.triangles[i + (k + 1) % 3];
      ++uses[{std::min(a, b), std::max(a, b)}];
    }
  }
  std::set<std::pair<Place, Place>> edges; // neighbours have corners of the same place
  for (const auto& [edge, count] : uses) {
    if (count > 1 && !diagonals)
      continue;
    const Place a = place_of(mesh.vertices[edge.first].position);
    const Place b = place_of(mesh.vertices[edge.second].position);
    edges.insert({std::min(a, b), std::max(a, b)});
  }
  std::vector<Polyline> lines;
  for (const auto& [a, b] : edges)
    lines.push_back({{a[0], a[1], a[2]}, {b[0], b[1], b[2]}});
  return lines;
}

std::vector<Polyline> lattice_lines(const std::vector<LensTessellation>& lenses, const BoxSpace& space,
                                    double plane, std::size_t cells, std::size_t steps) {
  const auto shown = [&](const glm::dvec3& t) {
    glm::dvec3 b = box_from_texture(space, t);
    for (const LensTessellation& lens : lenses)
      b = object_from_texture(lens.map, b);
    return texture_from_box(space, b);
  };
  const double longer = std::max(space.size.x, space.size.y);
  std::vector<Polyline> lines;
  for (int axis = 0; axis < 2; ++axis) {
    // In texture coordinates of this axis a cell is longer/cells box units.
    const double cell = longer / (static_cast<double>(cells) * space.size[axis]);
    for (std::size_t i = 0; static_cast<double>(i) * cell <= 1 + 1e-9; ++i) {
      Polyline line;
      for (std::size_t k = 0; k <= steps; ++k) {
        glm::dvec3 t(0, 0, plane);
        t[axis] = std::min(1.0, static_cast<double>(i) * cell);
        t[1 - axis] = static_cast<double>(k) / static_cast<double>(steps);
        line.push_back(shown(t));
      }
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

} // namespace slicelens
