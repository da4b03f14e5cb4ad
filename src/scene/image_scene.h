// The scene of a 2D lens: a picture under LaMar's borders, as plain values (LaMar 2001 §3, Figures 1 to 4 and
// 8). The picture is a volume of one slice seen face on: the lens, its keys and its tessellation are those of
// the volume.
#pragma once

#include "scene/names.h"
#include "scene/scene_json.h"

namespace slicelens {

/// Squares of black and white, `squares` along the longer edge; the top left one is white.
struct CheckerboardSettings {
  std::array<std::size_t, 2> size{512, 512}; ///< pixels
  std::size_t squares = 16;
};

/// The embedded colour test picture: image/patterns.h.
struct TestCardSettings {
  std::array<std::size_t, 2> size{512, 512}; ///< pixels
};

/// Section `image`. Exactly one is set.
struct ImageSettings {
  std::optional<std::string> file = std::nullopt; ///< relative paths are relative to the scene file
  std::optional<CheckerboardSettings> checkerboard = std::nullopt;
  std::optional<TestCardSettings> testcard = std::nullopt;
};

/// Where the lens is evaluated: at the corners of triangles (the paper), at each fragment, in a table of
/// RG32F texels (the paper's future work), or on the CPU in double precision; `fixed_function` draws the
/// triangles without shaders, from and into 8 bits, as the paper's hardware did.
enum class LensPipeline { tessellated, fixed_function, fragment, lookup, reference };

/// Section `render`.
struct ImageRenderSettings {
  LensPipeline pipeline = LensPipeline::tessellated;
  std::optional<std::array<std::size_t, 2>> size = std::nullopt; ///< none: the image's own
  Filter filter = Filter::linear;
  Target target = Target::rgba32f;
  TransferTexture image_texture = TransferTexture::rgba32f;
  std::size_t lookup_size = 256; ///< texels along the longer edge of the table
  glm::dvec4 background{0};      ///< not associated; shows where there is no image
  ContextName context = ContextName::automatic;
};

/// Positions are texture coordinates of the image: [0,1]², origin at the top left corner, y downwards, as
/// pictures store their rows. A lens' center is (x, y, 0.5). Lengths are fractions of the image's longer
/// edge.
struct ImageScene {
  std::string title;
  ImageSettings image;
  ImageRenderSettings render;
  OverlaySettings overlay;
  std::vector<Warp> warp; ///< lenses that do not overlap
};

const std::vector<EnumName<LensPipeline>>& names_of(LensPipeline);

/// Whether a pipeline draws the triangles of a tessellation.
bool draws_triangles(LensPipeline pipeline);

/// The most pixels of a picture: 1 GiB of RGBA floats.
inline constexpr std::size_t max_image_pixels = std::size_t{1} << 26;

/// Throws UsageError naming the keys: none or several images, sizes that are 0 or too large, lenses that are
/// none, affine coordinates without the pipeline that has them.
void validate(const ImageScene& scene);

/// Reads a 2D scene as scene_from_json reads a 3D one, after applying `changes`. A scene without `warp` has
/// one lens with its defaults, one without `image` shows the test card; `warp.kind` may be left out; `center`
/// is [x, y] or [x, y, 0.5]. Throws UsageError, also for keys that mean nothing in a picture (depth_inner,
/// depth_outer).
ImageScene image_scene_from_json(const std::string& text, const std::string& source,
                                 const std::vector<KeyValue>& changes = {});

/// The scene with every key, `center` as [x, y]. `indent` < 0: one line.
std::string image_scene_to_json(const ImageScene& scene, int indent = 2);

/// Whether the text is a 2D scene: an object with `image` and without `volume`.
bool is_image_scene(const std::string& text);

/// Every key with its help text.
std::vector<std::pair<std::string, std::string>> list_image_scene_keys();

} // namespace slicelens
