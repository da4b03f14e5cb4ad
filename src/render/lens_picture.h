// A picture under LaMar's lenses: the 2D lens by every pipeline. The image is the only slice, at t_z = ½, of
// a volume seen face on, so the lens, its tessellation and its shader are those of the volume.
#pragma once

#include "gl/context.h"
#include "image/image.h"
#include "scene/image_scene.h"
#include "tess/lens_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// A 2D scene with its image, and what all pipelines need.
struct PreparedPicture {
  ImageScene scene;
  Image source;
  BoxSpace space; ///< x to the right, y down, unit: the image's longer edge
  WarpView view;  ///< face on: right = +x, up = −y, forward = +z
  std::vector<LensTessellation> lenses;
  int width = 0; ///< of the picture, pixels
  int height = 0;
  glm::dvec2 scale{1};  ///< pixels per unit of the image's texture coordinates
  glm::dvec2 offset{0}; ///< pixel of the image's top left corner
};

/// Reads the file, or makes the pattern. Throws FileError, LimitError.
Image load_image(const ImageSettings& settings, const std::vector<std::filesystem::path>& folders);

/// Fits the image into the picture (its aspect kept, centred) and prepares the lenses. Throws UsageError for
/// lenses that are none, touch nothing or overlap, and for a picture of more than max_image_pixels.
PreparedPicture prepare_picture(ImageScene scene, Image source);

/// Pixel (0,0 at the top left corner) from texture coordinates of the picture, and back.
glm::dvec2 pixel_from_picture(const PreparedPicture& prepared, const glm::dvec2& t);
glm::dvec2 picture_from_pixel(const PreparedPicture& prepared, const glm::dvec2& pixel);

/// Where the image is looked at by the point `t` of the picture: the exact inverse map, in double.
glm::dvec2 image_from_picture(const PreparedPicture& prepared, const glm::dvec2& t);

/// Local magnification at `t`: the square root of the shown area per area of the image, 1/√|det J|; infinite
/// where the map's derivative is singular.
double magnification_at(const PreparedPicture& prepared, const glm::dvec2& t);

/// The triangles that the scene's pipeline draws: the tessellated lens, or covers with the undisturbed pieces
/// first.
LensMesh picture_mesh(const PreparedPicture& prepared);

/// The displacement u − t, texture coordinates, on a grid of size[0]×size[1] texels that spans [low, high] of
/// the picture's texture coordinates, texel centres at (i+½)/N: pipeline `lookup`.
struct WarpTable {
  std::array<int, 2> size{0, 0};
  glm::dvec2 low{0};
  glm::dvec2 high{1};
  std::vector<glm::vec2> texels; ///< row by row, from the top
};

/// The table over all lenses' squares; lookup_size texels along the longer edge. Empty without lenses.
WarpTable warp_table(const PreparedPicture& prepared);

/// The picture by pipeline `reference`: at each pixel centre the exact map and filter in double precision.
Image draw_reference_picture(const PreparedPicture& prepared);

/// Draws what `overlay` asks for into `image`; a magnification grows it by a colour bar at the bottom.
void draw_overlays(Image& image, const PreparedPicture& prepared);

/// What was drawn by what.
struct PictureResult {
  Image image; ///< over the scene's background, with overlays; metadata is empty
  std::string renderer;
  std::string version; ///< empty for the reference
  std::string context; ///< likewise
  std::size_t triangles = 0;
  double draw_seconds = 0;
};

/// Draws by the scene's pipeline. `context` may be null for the reference. Throws GraphicsError, LimitError.
PictureResult render_picture(const PreparedPicture& prepared, gl::Context* context);

} // namespace slicelens
