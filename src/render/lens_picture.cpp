#include "render/lens_picture.h"

#include "core/errors.h"
#include "image/image_io.h"
#include "image/patterns.h"
#include "scene/load.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

/// The only slice, in texture coordinates.
const Polygon& image_polygon() {
  static const Polygon polygon = {{0, 0, 0.5}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0.5}};
  return polygon;
}

glm::dvec3 box_point(const PreparedPicture& prepared, const glm::dvec2& t) {
  return box_from_texture(prepared.space, glm::dvec3(t, 0.5));
}

/// The image at t by the scene's filter, in double: texel centres at (i+½)/N, clamped to the edge.
glm::dvec4 sampled(const PreparedPicture& prepared, const glm::dvec2& t) {
  const Image& image = prepared.source;
  const glm::ivec2 last(image.width - 1, image.height - 1);
  const auto texel = [&](glm::ivec2 i) {
    i = glm::clamp(i, glm::ivec2(0), last);
    return glm::dvec4(channel(image, i.x, i.y, 0), channel(image, i.x, i.y, 1), channel(image, i.x, i.y, 2),
                      channel(image, i.x, i.y, 3));
  };
  const glm::dvec2 position = t * glm::dvec2(image.width, image.height);
  if (prepared.scene.render.filter == Filter::nearest)
    return texel(glm::ivec2(glm::floor(position)));
  const glm::dvec2 lower = glm::floor(position - 0.5);
  const glm::dvec2 f = position - 0.5 - lower;
  const glm::ivec2 i(lower);
  return glm::mix(glm::mix(texel(i), texel(i + glm::ivec2(1, 0)), f.x),
                  glm::mix(texel(i + glm::ivec2(0, 1)), texel(i + glm::ivec2(1, 1)), f.x), f.y);
}

} // namespace

Image load_image(const ImageSettings& settings, const std::vector<std::filesystem::path>& folders) {
  if (settings.checkerboard) {
    const CheckerboardSettings& board = *settings.checkerboard;
    return checkerboard(static_cast<int>(board.size[0]), static_cast<int>(board.size[1]),
                        static_cast<int>(board.squares));
  }
  if (settings.testcard) {
    return test_card(static_cast<int>(settings.testcard->size[0]),
                     static_cast<int>(settings.testcard->size[1]));
  }
  return read_image(resolve_file(*settings.file, folders, "image.file"));
}

PreparedPicture prepare_picture(ImageScene scene, Image source) {
  PreparedPicture prepared;
  const auto size = scene.render.size.value_or(std::array<std::size_t, 2>{
      static_cast<std::size_t>(source.width), static_cast<std::size_t>(source.height)});
  if (size[0] * size[1] > max_image_pixels) {
    throw UsageError("the image has " + std::to_string(size[0]) + "×" + std::to_string(size[1]) +
                     " pixels; choose a smaller picture with render.size");
  }
  prepared.width = static_cast<int>(size[0]);
  prepared.height = static_cast<int>(size[1]);
  const glm::dvec2 extent(source.width, source.height);
  const double fit = std::min(prepared.width / extent.x, prepared.height / extent.y);
  prepared.scale = fit * extent;
  prepared.offset = 0.5 * (glm::dvec2(prepared.width, prepared.height) - prepared.scale);
  const double longer = std::max(extent.x, extent.y);
  prepared.space.size = glm::dvec3(extent / longer, 1 / longer);
  prepared.space.longest = longer;
  prepared.view.forward = {0, 0, 1};
  prepared.view.right = {1, 0, 0};
  prepared.view.up = {0, -1, 0};
  for (const Warp& warp : scene.warp) {
    prepared.lenses.push_back(
        prepare_lens(std::get<LamarLens>(warp), prepared.space, prepared.view, fit * longer));
  }
  refuse_overlap(prepared.lenses);
  prepared.scene = std::move(scene);
  prepared.source = std::move(source);
  return prepared;
}

glm::dvec2 pixel_from_picture(const PreparedPicture& prepared, const glm::dvec2& t) {
  return prepared.offset + t * prepared.scale;
}

glm::dvec2 picture_from_pixel(const PreparedPicture& prepared, const glm::dvec2& pixel) {
  return (pixel - prepared.offset) / prepared.scale;
}

glm::dvec2 image_from_picture(const PreparedPicture& prepared, const glm::dvec2& t) {
  glm::dvec3 b = box_point(prepared, t);
  bool moved = false;
  for (const LensTessellation& lens : prepared.lenses) { // they do not overlap: at most one moves it
    const glm::dvec3 u = texture_from_object(lens.map, b);
    moved = moved || u != b;
    b = u;
  }
  return moved ? glm::dvec2(texture_from_box(prepared.space, b)) : t;
}

double magnification_at(const PreparedPicture& prepared, const glm::dvec2& t) {
  const glm::dvec3 b = box_point(prepared, t);
  double area = 1;
  for (const LensTessellation& lens : prepared.lenses) {
    const glm::dmat3 j = jacobian(lens.map, b);
    area *= std::abs(j[0][0] * j[1][1] - j[0][1] * j[1][0]);
  }
  return 1 / std::sqrt(area);
}

LensMesh picture_mesh(const PreparedPicture& prepared) {
  if (draws_triangles(prepared.scene.render.pipeline) || prepared.lenses.empty())
    return tessellate_slice(image_polygon(), prepared.lenses, prepared.space, {});
  return cover_slice(image_polygon(), prepared.lenses, prepared.space, {});
}

WarpTable warp_table(const PreparedPicture& prepared) {
  WarpTable table;
  if (prepared.lenses.empty())
    return table;
  table.low = glm::dvec2(1e9);
  table.high = glm::dvec2(-1e9);
  for (const LensTessellation& lens : prepared.lenses) {
    const glm::dvec2 reach = lens.map.outer / glm::dvec2(prepared.space.size);
    const glm::dvec2 center(texture_from_box(prepared.space, lens.map.center));
    table.low = glm::min(table.low, center - reach);
    table.high = glm::max(table.high, center + reach);
  }
  const glm::dvec2 extent = (table.high - table.low) * glm::dvec2(prepared.space.size);
  const auto texels = static_cast<double>(prepared.scene.render.lookup_size);
  for (int axis = 0; axis < 2; ++axis) {
    table.size[static_cast<std::size_t>(axis)] =
        std::max(2, static_cast<int>(std::lround(texels * extent[axis] / std::max(extent.x, extent.y))));
  }
  table.texels.reserve(static_cast<std::size_t>(table.size[0]) * static_cast<std::size_t>(table.size[1]));
  for (int y = 0; y < table.size[1]; ++y) {
    for (int x = 0; x < table.size[0]; ++x) {
      const glm::dvec2 at((x + 0.5) / table.size[0], (y + 0.5) / table.size[1]);
      const glm::dvec2 t = glm::mix(table.low, table.high, at);
      table.texels.emplace_back(image_from_picture(prepared, t) - t);
    }
  }
  return table;
}

Image draw_reference_picture(const PreparedPicture& prepared) {
  Image image = make_image(prepared.width, prepared.height);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const glm::dvec2 u = image_from_picture(prepared, picture_from_pixel(prepared, {x + 0.5, y + 0.5}));
      const bool inside = u.x >= 0 && u.y >= 0 && u.x <= 1 && u.y <= 1;
      const glm::dvec4 color = inside ? sampled(prepared, u) : glm::dvec4(0);
      for (int c = 0; c < 4; ++c)
        channel(image, x, y, c) = static_cast<float>(color[c]);
    }
  });
  return image;
}

} // namespace slicelens
