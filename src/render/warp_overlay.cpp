#include "render/warp_overlay.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace slicelens {

namespace {

/// The twelve edges of a box, in `steps` pieces each, so that maps can bend them; or a cross at a point.
std::vector<Polyline> edges_of(const AxisRanges& ranges, int steps) {
  const glm::dvec3 low = low_of(ranges);
  const glm::dvec3 high = high_of(ranges);
  std::vector<Polyline> edges;
  if (low == high) {
    constexpr double arm = 0.03;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 half(0);
      half[axis] = arm;
      edges.push_back({low - half, low + half});
    }
    return edges;
  }
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) != 0)
        continue;
      const glm::dvec3 a = glm::mix(low, high, glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2 & 1));
      glm::dvec3 b = a;
      b[axis] = high[axis];
      Polyline edge;
      for (int step = 0; step <= steps; ++step)
        edge.push_back(glm::mix(a, b, static_cast<double>(step) / steps));
      edges.push_back(std::move(edge));
    }
  }
  return edges;
}

/// Middle of the focus region on display, box space: the mapping's.
glm::dvec3 focus_center(const PreparedScene& prepared) {
  const std::optional<AxisRanges> focus = focus_region(prepared.scene.warp);
  return box_from_texture(prepared.space, focus ? 0.5 * (low_of(*focus) + high_of(*focus)) : glm::dvec3(0.5));
}

/// Whether the map jumps between two neighbouring points p and q of a line that is du long in the data: they
/// are shown much farther apart than the derivative says at either of them.
bool jumps(const PreparedScene& prepared, const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& du) {
  const double expected = std::max(glm::length(glm::inverse(jacobian(prepared.maps, p)) * du),
                                   glm::length(glm::inverse(jacobian(prepared.maps, q)) * du));
  return glm::length(q - p) > 2 * expected + 1e-9;
}

/// The line of the data from u in equal steps du, where it is shown: as many pieces as jumps and faces make.
void append_carried(const PreparedScene& prepared, glm::dvec3 u, const glm::dvec3& du, int steps,
                    std::vector<Polyline>& lines) {
  Polyline line;
  glm::dvec3 last(0); // shown, box space
  const auto finish = [&] {
    if (line.size() > 1)
      lines.push_back(line);
    line.clear();
  };
  for (int step = 0; step <= steps; ++step, u += du) {
    const glm::dvec3 t = texture_from_box(prepared.space, u);
    if (glm::any(glm::lessThan(t, glm::dvec3(0))) || glm::any(glm::greaterThan(t, glm::dvec3(1)))) {
      finish();
      continue;
    }
    const glm::dvec3 shown = object_from_texture(prepared.maps, u);
    if (!line.empty() && jumps(prepared, last, shown, du))
      finish();
    line.push_back(texture_from_box(prepared.space, shown));
    last = shown;
  }
  finish();
}

} // namespace

std::vector<Polyline> focus_outlines(const PreparedScene& prepared) {
  std::vector<AxisRanges> regions;
  const auto add = [&](const AxisRanges& region) {
    if (std::find(regions.begin(), regions.end(), region) == regions.end())
      regions.push_back(region);
  };
  if (const std::optional<AxisRanges> mapping = focus_region(prepared.scene.warp))
    add(*mapping);
  const FocusEffects& effects = prepared.effects;
  if (has_highlight(effects))
    add(ranges_of(effects.highlight_low, effects.highlight_high));
  if (has_attenuation(effects))
    add(ranges_of(effects.attenuation_low, effects.attenuation_high));
  std::vector<Polyline> lines;
  for (const AxisRanges& region : regions) {
    const std::vector<Polyline> edges = edges_of(region, 1);
    lines.insert(lines.end(), edges.begin(), edges.end());
  }
  return lines;
}

std::vector<Polyline> lens_box_outlines(const PreparedScene& prepared) {
  std::vector<Polyline> lines;
  for (std::size_t i = 0; i < prepared.scene.warp.size(); ++i) {
    const Warp& warp = prepared.scene.warp[i];
    const auto* cutting = std::get_if<VolumeLens>(&warp);
    const auto* connected = std::get_if<ConnectedLens>(&warp);
    if (cutting == nullptr && connected == nullptr)
      continue;
    const LensBox& box = cutting != nullptr ? cutting->box : connected->box;
    const std::vector<WarpMap> later(prepared.maps.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                     prepared.maps.end());
    for (Polyline edge : edges_of(ranges_of(box.center - box.outer, box.center + box.outer), 64)) {
      for (glm::dvec3& t : edge)
        t = texture_from_box(prepared.space, object_from_texture(later, box_from_texture(prepared.space, t)));
      lines.push_back(std::move(edge));
    }
  }
  return lines;
}

std::vector<Polyline> carried_lattice(const PreparedScene& prepared, std::size_t cells) {
  constexpr int steps = 512; // for each edge of the box
  const glm::dvec3 center = texture_from_object(prepared.maps, focus_center(prepared));
  const glm::dvec3& right = prepared.warp_view.right;
  const glm::dvec3& up = prepared.warp_view.up;
  const auto count = static_cast<int>(cells);
  std::vector<Polyline> lines;
  for (int i = -count; i <= count; ++i) {
    const double across = static_cast<double>(i) / count;
    append_carried(prepared, center + across * up - right, right / static_cast<double>(steps), 2 * steps,
                   lines);
    append_carried(prepared, center + across * right - up, up / static_cast<double>(steps), 2 * steps, lines);
  }
  return lines;
}

glm::dvec3 plane_point_at_pixel(const PreparedScene& prepared, double x, double y, const glm::dvec3& point,
                                const glm::dvec3& normal) {
  const Ray world = ray_from_pixel(prepared.view, x, y);
  const glm::dmat4 to_texture = texture_from_world(prepared.box);
  const glm::dvec3 origin =
      box_from_texture(prepared.space, glm::dvec3(to_texture * glm::dvec4(world.origin, 1)));
  const glm::dvec3 direction = box_from_texture(prepared.space, glm::dmat3(to_texture) * world.direction);
  const double s = glm::dot(point - origin, normal) / glm::dot(direction, normal);
  return origin + s * direction;
}

std::vector<double> plane_magnifications(const PreparedScene& prepared) {
  const glm::dvec3 center = focus_center(prepared);
  const WarpView& view = prepared.warp_view;
  std::vector<double> values;
  for (int y = 0; y < prepared.view.height; ++y) {
    for (int x = 0; x < prepared.view.width; ++x) {
      const glm::dvec3 p = plane_point_at_pixel(prepared, x + 0.5, y + 0.5, center, view.forward);
      const glm::dmat3 j = jacobian(prepared.maps, p);
      values.push_back(1 / std::sqrt(glm::length(glm::cross(j * view.right, j * view.up))));
    }
  }
  return values;
}

} // namespace slicelens
