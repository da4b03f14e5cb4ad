// Overlays of 2D lenses.

#include "image/overlay.h"
#include "render/lens_picture.h"
#include "render/overlay_parts.h"
#include "tess/overlay_lines.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace slicelens {

namespace {

PixelLine in_pixels(const PreparedPicture& prepared, const Polyline& line) {
  PixelLine result;
  for (const glm::dvec3& point : line)
    result.push_back(pixel_from_picture(prepared, glm::dvec2(point)));
  return result;
}

std::vector<PixelLine> in_pixels(const PreparedPicture& prepared, const std::vector<Polyline>& lines) {
  std::vector<PixelLine> result;
  for (const Polyline& line : lines)
    result.push_back(in_pixels(prepared, line));
  return result;
}

MagnificationBar draw_magnification_of(Image& image, const PreparedPicture& prepared) {
  std::vector<double> values;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      values.push_back(magnification_at(prepared, picture_from_pixel(prepared, {x + 0.5, y + 0.5})));
  }
  return draw_magnification(image, values, prepared.scene.overlay.magnification);
}

} // namespace

void draw_overlays(Image& image, const PreparedPicture& prepared) {
  const OverlaySettings& overlay = prepared.scene.overlay;
  std::optional<MagnificationBar> bar;
  if (overlay.magnification > 0)
    bar = draw_magnification_of(image, prepared);
  if (overlay.lattice > 0) {
    draw_lines(image,
               in_pixels(prepared, lattice_lines(prepared.lenses, prepared.space, 0.5, overlay.lattice, 512)),
               overlay.line_width, lattice_color);
  }
  if (overlay.wireframe != Wireframe::none) {
    draw_lines(
        image,
        in_pixels(prepared, mesh_edges(picture_mesh(prepared), overlay.wireframe == Wireframe::triangles)),
        overlay.line_width, wireframe_color);
  }
  for (const LensTessellation& lens : prepared.lenses) {
    if (!overlay.outline)
      break;
    const LensOutline outline = lens_outline(lens, prepared.space, 0);
    draw_lines(image, {in_pixels(prepared, outline.outer)}, overlay.line_width, outer_color);
    draw_lines(image, {in_pixels(prepared, outline.inner)}, overlay.line_width, inner_color);
  }
  if (bar)
    image = with_magnification_bar(image, *bar);
}

} // namespace slicelens
