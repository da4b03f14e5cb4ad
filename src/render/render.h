// One call from a prepared scene to a picture, by whichever pipeline the scene names.
#pragma once

#include "core/progress.h"
#include "gl/context.h"
#include "image/image.h"
#include "render/brick_pool.h"
#include "render/prepare.h"

#include <optional>
#include <vector>

namespace slicelens {

/// Seconds of wall clock, each phase finished before the next starts.
struct RenderTimes {
  double context = 0;             ///< opening it
  double upload = 0;              ///< volume and transfer function into textures, corners into buffers
  double compile = 0;             ///< shader programs
  double slice = 0;               ///< cutting planes with the volume's box
  double tessellate = 0;          ///< polygons to triangles
  double draw = 0;                ///< until the driver is done
  double read = 0;                ///< back to an Image
  std::optional<double> gpu_draw; ///< the driver's own measure of draw, where it has one
};

struct RenderResult {
  Image image; ///< on the scene's background; metadata is empty
  RenderTimes times;
  std::string renderer;          ///< GL_RENDERER, or "CPU, double precision" for the reference
  std::string version;           ///< GL_VERSION, empty for the reference
  std::string limits;            ///< what the driver allows, one line; empty for the reference
  std::string context;           ///< kind of context
  std::string texture;           ///< what holds the volume: "r16", "rgba8, classified"; empty: reference
  std::size_t texture_bytes = 0; ///< of all textures, the transfer function's included
  std::size_t whole_texture_bytes =
      0;                           ///< what they would be with the volume in one texture at full resolution
  std::size_t volume_textures = 0; ///< that hold the volume: 1 without render.tiles, levels, footprint
  std::vector<PoolCounts> pools;   ///< of the volumes that are drawn through one
  std::size_t draw_calls = 0;      ///< of the slices
  std::size_t slices = 0;          ///< drawn, 0 for rays and reference
  std::size_t triangles = 0;       ///< of all slices
};

/// The internal format that `render.target` names.
GLenum texture_format(Target target);

/// `compatibility` for pipeline `fixed-function`, which cannot be drawn in a core context.
gl::Profile profile_of(Pipeline pipeline);

/// The context that a scene asks for, of the profile that its pipeline needs. Throws GraphicsError.
gl::Context open_context_for(const Scene& scene);

/// Renders. `context` may be null for the reference, and must be current and of the pipeline's profile
/// otherwise. Throws UsageError, GraphicsError or LimitError.
RenderResult render(const PreparedScene& prepared, gl::Context* context, const Progress& progress);

/// Puts associated `image` over a straight background colour, in place.
void put_over_background(Image& image, const glm::dvec4& background);

/// Turns an X-ray's line integrals, equal in all four channels, into associated grey: `scale`·S with coverage
/// min(1, scale·S).
void show_line_integrals(Image& image, double scale);

} // namespace slicelens
