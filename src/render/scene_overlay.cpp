#include "render/scene_overlay.h"

#include "image/overlay.h"
#include "render/annotations.h"
#include "render/overlay_parts.h"
#include "render/stack_geometry.h"
#include "render/warp_overlay.h"
#include "slicing/slice_stack.h"
#include "tess/overlay_lines.h"
#include "tess/subdivided_slice.h"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace slicelens {

namespace {

PixelLine in_pixels(const PreparedScene& prepared, const View& view, const Polyline& line) {
  PixelLine result;
  for (const glm::dvec3& point : line)
    result.push_back(pixel_from_world(view, world_from_texture(prepared.box, point)));
  return result;
}

/// The slice through a lens' centre, whether or not the stack has a plane there.
Polygon central_slice(const PreparedScene& prepared, const LensTessellation& lens) {
  const Plane box_plane{lens.map.forward, glm::dot(lens.map.forward, lens.map.center)};
  return cut_unit_cube({box_plane.normal * prepared.space.size, box_plane.offset});
}

/// The displayed volume's slice through the box centre, across the view.
Polygon middle_slice(const PreparedScene& prepared) {
  const glm::dvec3 extent = prepared.object_high - prepared.object_low;
  const glm::dvec3 normal = prepared.warp_view.forward * prepared.space.size;
  Polygon polygon = cut_unit_cube({normal * extent, glm::dot(normal, glm::dvec3(0.5) - prepared.object_low)});
  for (glm::dvec3& corner : polygon)
    corner = prepared.object_low + corner * extent;
  for (const Plane& plane : prepared.object_clip)
    polygon = clip(polygon, plane);
  return polygon;
}

/// The cells of a subdivided slice, on that slice. Their corners are given to each cell, as mesh_edges
/// expects.
std::vector<Polyline> cell_edges(const PreparedScene& prepared, bool diagonals) {
  LensMesh mesh = subdivide_slice(middle_slice(prepared), prepared.maps, prepared.space, prepared.warp_view,
                                  prepared.scene.render.subdivision);
  std::vector<std::uint32_t>& corner = mesh.triangles;
  for (std::size_t i = 0; i + 5 < corner.size(); i += 3) {
    if (corner[i] != corner[i + 3] || corner[i + 2] != corner[i + 4])
      continue;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::uint32_t k : {corner[i], corner[i + 1], corner[i + 2], corner[i + 5]})
      mesh.vertices.push_back(LensVertex(mesh.vertices[k]));
    const std::array<std::uint32_t, 6> own = {0, 1, 2, 0, 2, 3};
    for (std::size_t k = 0; k < 6; ++k)
      corner[i + k] = first + own[k];
    i += 3;
  }
  return mesh_edges(mesh, diagonals);
}

/// A lattice of the data on the plane through the lens' centre, shown where the lens puts it.
std::vector<Polyline> carried_lattice(const PreparedScene& prepared, const LensTessellation& lens,
                                      std::size_t cells) {
  const LamarMap& map = lens.map;
  constexpr int steps = 512;
  const auto count = static_cast<int>(cells);
  std::vector<Polyline> lines;
  for (int i = -count; i <= count; ++i) {
    for (const bool upright : {false, true}) {
      Polyline line;
      for (int step = -steps; step <= steps; ++step) {
        const double along = static_cast<double>(step) / steps;
        const double across = static_cast<double>(i) / count;
        const glm::dvec3 u =
            map.center + (upright ? across : along) * map.right + (upright ? along : across) * map.up;
        const glm::dvec3 shown = texture_from_box(prepared.space, object_from_texture(map, u));
        const glm::dvec3 t = texture_from_box(prepared.space, u);
        const bool inside = glm::all(glm::greaterThanEqual(t, glm::dvec3(0))) &&
                            glm::all(glm::lessThanEqual(t, glm::dvec3(1)));
        if (inside) {
          line.push_back(shown);
        } else if (!line.empty()) {
          lines.push_back(std::move(line));
          line.clear();
        }
      }
      if (line.size() > 1)
        lines.push_back(std::move(line));
    }
  }
  return lines;
}

/// Local magnification of the plane through the lens' centre at a pixel: 1/√(area of the data under an area
/// of the picture).
double magnification_at_pixel(const PreparedScene& prepared, const LensTessellation& lens, double x,
                              double y) {
  const glm::dmat3 j =
      jacobian(lens.map, plane_point_at_pixel(prepared, x, y, lens.map.center, lens.map.forward));
  const glm::dvec3 right = j * lens.map.right;
  const glm::dvec3 up = j * lens.map.up;
  const double data_area = std::abs(glm::dot(glm::cross(right, up), lens.map.forward));
  return 1 / std::sqrt(data_area);
}

std::optional<MagnificationBar> draw_magnification_of(Image& image, const PreparedScene& prepared) {
  if (!(prepared.scene.overlay.magnification > 0) || prepared.maps.empty())
    return std::nullopt;
  if (prepared.lenses.empty())
    return draw_magnification(image, plane_magnifications(prepared), prepared.scene.overlay.magnification);
  std::vector<double> values;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double product = 1;
      for (const LensTessellation& lens : prepared.lenses)
        product *= magnification_at_pixel(prepared, lens, x + 0.5, y + 0.5);
      values.push_back(product);
    }
  }
  return draw_magnification(image, values, prepared.scene.overlay.magnification);
}

/// Green, blue or red as a plane meets no lens, a lens' border in depth, or its zoom region.
glm::vec3 plane_color(const PreparedScene& prepared, const Polygon& slice) {
  glm::vec3 color(0.1F, 0.8F, 0.2F);
  for (const LensTessellation& lens : prepared.lenses) {
    const double z =
        std::abs(glm::dot(box_from_texture(prepared.space, slice[0]) - lens.map.center, lens.map.forward));
    if (z <= lens.map.depth_inner)
      return {1.0F, 0.2F, 0.15F};
    if (z < lens.map.depth_outer)
      color = glm::vec3(0.3F, 0.5F, 1.0F);
  }
  return color;
}

/// The scene's view gone aside about the box centre, far enough away to hold the whole box.
View side_view(const PreparedScene& prepared) {
  View view = prepared.view;
  const glm::dvec3 middle = center(prepared.box);
  const double radius = bounding_radius(prepared.box);
  const glm::dmat3 turn(glm::rotate(
      glm::rotate(glm::dmat4(1), glm::radians(prepared.scene.overlay.stack), view.up), 0.35, -view.right));
  view.right = turn * view.right;
  view.up = turn * view.up;
  view.forward = turn * view.forward;
  view.projection = Projection::orthographic;
  view.half_height = 1.05 * radius;
  view.eye = middle - 2 * radius * view.forward;
  return view;
}

void draw_box(Image& image, const PreparedScene& prepared, const View& view) {
  std::vector<PixelLine> edges;
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      if ((k >> axis & 1) != 0)
        continue;
      const glm::dvec3 a(k & 1, k >> 1 & 1, k >> 2 & 1);
      glm::dvec3 b = a;
      b[axis] = 1;
      edges.push_back(in_pixels(prepared, view, {a, b}));
    }
  }
  draw_lines(image, edges, prepared.scene.overlay.line_width, glm::vec3(0.6F));
}

/// Circles around what the scene's landmarks name: sources in the undeformed data, targets where they are
/// shown (Brunet, Nowak and Gleicher 2006, Figure 1). Targets lie over sources.
void draw_landmarks(Image& image, const PreparedScene& prepared) {
  constexpr int sides = 48;
  const OverlaySettings& overlay = prepared.scene.overlay;
  std::array<std::vector<PixelLine>, 2> circles;
  for (const Warp& warp : prepared.scene.warp) {
    const auto* landmarks = std::get_if<Landmarks>(&warp);
    if (landmarks == nullptr)
      continue;
    for (const LandmarkPair& pair : landmarks_in_box(*landmarks, prepared.space)) {
      for (std::size_t end = 0; end < 2; ++end) {
        const glm::dvec3 world =
            world_from_texture(prepared.box, texture_from_box(prepared.space, pair[end]));
        const glm::dvec2 middle = pixel_from_world(prepared.view, world);
        PixelLine circle;
        for (int i = 0; i <= sides; ++i) {
          const double angle = 2 * std::numbers::pi * i / sides;
          circle.push_back(middle + overlay.landmarks * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        circles[end].push_back(std::move(circle));
      }
    }
  }
  draw_lines(image, circles[0], overlay.line_width, inner_color);
  draw_lines(image, circles[1], overlay.line_width, wireframe_color);
}

} // namespace

void draw_overlays(Image& image, const PreparedScene& prepared) {
  const OverlaySettings& overlay = prepared.scene.overlay;
  const std::optional<MagnificationBar> bar = draw_magnification_of(image, prepared);
  const auto draw = [&](const std::vector<Polyline>& lines, const glm::vec3& color) {
    std::vector<PixelLine> pixels;
    for (const Polyline& line : lines)
      pixels.push_back(in_pixels(prepared, prepared.view, line));
    draw_lines(image, pixels, overlay.line_width, color);
  };
  for (const LensTessellation& lens : prepared.lenses) {
    if (overlay.lattice > 0)
      draw(carried_lattice(prepared, lens, overlay.lattice), lattice_color);
    if (overlay.wireframe != Wireframe::none && !is_subdivided(prepared)) {
      const LensMesh mesh = tessellate_slice(central_slice(prepared, lens), prepared.lenses, prepared.space,
                                             {prepared.data_clip, prepared.object_clip});
      draw(mesh_edges(mesh, overlay.wireframe == Wireframe::triangles), wireframe_color);
    }
    if (overlay.outline) {
      const LensOutline outline = lens_outline(lens, prepared.space, 0);
      draw({outline.outer}, outer_color);
      draw({outline.inner}, inner_color);
    }
  }
  if (overlay.wireframe != Wireframe::none && is_subdivided(prepared))
    draw(cell_edges(prepared, overlay.wireframe == Wireframe::triangles), wireframe_color);
  // Warps without triangles, and the regions of highlight and attenuation.
  if (overlay.lattice > 0 && prepared.lenses.empty() && !prepared.maps.empty())
    draw(carried_lattice(prepared, overlay.lattice), lattice_color);
  if (overlay.outline) {
    draw(lens_box_outlines(prepared), outer_color);
    draw(focus_outlines(prepared), inner_color);
  }
  if (overlay.landmarks > 0)
    draw_landmarks(image, prepared);
  draw_annotations(image, prepared);
  if (bar)
    image = with_magnification_bar(image, *bar);
}

Image draw_stack_from_the_side(const PreparedScene& prepared) {
  Image image = make_image(prepared.view.width, prepared.view.height);
  const glm::dvec4& background = prepared.scene.render.background;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] =
        static_cast<float>(i % 4 == 3 ? background.a : background[static_cast<int>(i % 4)] * background.a);
  const View view = side_view(prepared);
  draw_box(image, prepared, view);
  SliceRequest request;
  request.box = prepared.box;
  request.view = prepared.view;
  request.spacing = prepared.spacing;
  const SliceStack stack = make_slice_stack(request);
  for (const Slice& slice : stack.slices) {
    const Polygon polygon(stack.corners.begin() + slice.first,
                          stack.corners.begin() + slice.first + slice.count);
    const LensMesh mesh = tessellate_slice(polygon, prepared.lenses, prepared.space,
                                           {prepared.data_clip, prepared.object_clip});
    std::vector<PixelLine> lines;
    for (const Polyline& edge : mesh_edges(mesh, prepared.scene.overlay.wireframe == Wireframe::triangles))
      lines.push_back(in_pixels(prepared, view, edge));
    draw_lines(image, lines, prepared.scene.overlay.line_width, plane_color(prepared, polygon));
  }
  return image;
}

} // namespace slicelens
