// A prepared scene held by the driver, drawn as often as wanted: each phase by itself, so that it can be
// timed.
#pragma once

#include "gl/context.h"
#include "gl/target.h"
#include "image/image.h"
#include "render/fixed_function.h"
#include "render/gpu_scene.h"
#include "render/rays.h"
#include "render/slices.h"

#include <cstdint>
#include <optional>
#include <variant>

namespace slicelens {

/// Seconds of wall clock of the phases before drawing, each finished before the next starts.
struct SetUpTimes {
  double upload = 0;     ///< volume, transfer function and, after slicing, the corners into buffers
  double compile = 0;    ///< shader programs, as far as the driver compiles before the first draw
  double slice = 0;      ///< planes cut with the volume's box; 0 for rays
  double tessellate = 0; ///< polygons to triangles; 0 for rays
};

/// Seconds of one frame.
struct DrawTime {
  double wall = 0; ///< from an idle driver until it is done
  std::optional<double>
      gpu; ///< the driver's own measure, where it has one (gl/timer.h says when to trust it)
};

/// Pipelines of the GPU only. `prepared` and `context` must outlive it; the context must be current and of
/// the pipeline's profile.
class RenderSession {
public:
  /// Uploads, compiles and slices. Throws UsageError, GraphicsError or LimitError.
  RenderSession(gl::Context& context, const PreparedScene& prepared, const Progress& progress);

  const SetUpTimes& set_up() const { return set_up_; }

  /// Draws `batch` frames in a row, each handed to the driver at once, and waits for the end; the times are
  /// those of one. Reports the stage "draw" when `progress` listens, at the price of waiting for the driver a
  /// few dozen times.
  DrawTime draw(const Progress& progress, std::size_t batch = 1);
  /// What was drawn: associated colour, without background and overlays.
  Image read() const;
  /// Fragments that one frame hands to blending (GL_SAMPLES_PASSED; draws a frame). Rays have one a pixel.
  std::uint64_t count_fragments();

  const GpuScene& textures() const { return textures_; }
  std::size_t slice_count() const;
  std::size_t triangle_count() const;
  std::size_t draw_call_count() const; ///< of the slices; 0 where the pipeline does not count them

private:
  using Renderer = std::variant<SliceRenderer, FixedFunctionRenderer, RayRenderer>;
  Renderer make_renderer();
  void slice();
  void draw_frame(const Progress& progress);

  gl::Context* context_;
  const PreparedScene* prepared_;
  SetUpTimes set_up_;
  GpuScene textures_;
  gl::Target target_;
  std::optional<Renderer> renderer_;
};

} // namespace slicelens
