// Overlays of 2D lenses.

#include "image/overlay.h"
#include "render/lens_picture.h"
#include "tess/overlay_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace slicelens {

namespace {

// They stand out on black, on white and on one another.
const glm::vec3 wireframe_color(0.15F, 0.4F, 1.0F);
const glm::vec3 lattice_color(1.0F, 0.65F, 0.0F);
const glm::vec3 inner_color(1.0F, 0.1F, 0.1F);
const glm::vec3 outer_color(0.0F, 0.75F, 0.2F);

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

/// "0.42X": two digits are enough to read a bar.
std::string times_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2gX", value);
  return text;
}

/// The lettering of a colour bar, and where on it 1 lies.
struct Bar {
  std::string low;
  std::string high;
  double one = 0;
};

Bar draw_magnification(Image& image, const PreparedPicture& prepared) {
  std::vector<double> values;
  double low = 1;
  double high = 1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double m = magnification_at(prepared, picture_from_pixel(prepared, {x + 0.5, y + 0.5}));
      values.push_back(std::log2(m));
      low = std::min(low, m);
      if (std::isfinite(m))
        high = std::max(high, m);
    }
  }
  if (high / low < 1.01) { // no lens to speak of: 1 in the middle of an octave
    low /= std::sqrt(2.0);
    high *= std::sqrt(2.0);
  }
  const double octaves = std::log2(high / low);
  for (double& value : values)
    value = (value - std::log2(low)) / octaves;
  draw_false_color(image, values, prepared.scene.overlay.magnification);
  return {times_text(low), times_text(high), std::log2(1 / low) / octaves};
}

} // namespace

void draw_overlays(Image& image, const PreparedPicture& prepared) {
  const OverlaySettings& overlay = prepared.scene.overlay;
  std::optional<Bar> bar;
  if (overlay.magnification > 0)
    bar = draw_magnification(image, prepared);
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
    image = with_color_bar(image, bar->low, bar->high, times_text(1), bar->one);
}

} // namespace slicelens
