// Pipelines `slices`, `tessellated` and `fragment`: a stack of view-aligned polygons, textured, classified
// and blended (docs/pipeline.md; LaMar §3, Brunet §3). They differ in where a lens is evaluated: nowhere, at
// the corners, at each fragment.
#pragma once

#include "gl/target.h"
#include "render/carried_runs.h"
#include "render/cut_planes.h"
#include "render/gpu_scene.h"
#include "render/hidden_marks.h"
#include "render/stack_geometry.h"
#include "slicing/slice_stack.h"

#include <optional>

namespace slicelens {

/// Programs and buffers of the slice pipeline for one prepared scene.
class SliceRenderer {
public:
  /// Compiles the programs. Throws GraphicsError.
  SliceRenderer(const gl::Functions& gl, const PreparedScene& prepared);

  /// Cuts the stack for the scene's view and hands its polygons to the driver.
  void slice(const PreparedScene& prepared);
  /// Hands over a stack that is cut already: what make_stack_geometry gives for the same scene.
  void set_geometry(const StackGeometry& geometry);

  /// Draws the stack into `target`: associated colour over transparent black. State is restored. Reports the
  /// stage "draw" when `progress` listens, at the price of waiting for the driver a few dozen times.
  void draw(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target,
            const Progress& progress);

  std::size_t slice_count() const { return planes_in_passes_ > 0 ? planes_in_passes_ : index_ends_.size(); }
  std::size_t triangle_count() const { return index_ends_.empty() ? 0 : index_ends_.back() / 3; }
  /// Draw calls of one picture that nobody watches.
  std::size_t draw_call_count() const { return batches_.empty() ? 1 : batches_.size(); }

private:
  /// The triangles of entries [begin, end) of the index buffer.
  void draw_entries(std::size_t begin, std::size_t end) const;
  /// Of the entries [begin, end) of the index buffer: all slices, or the part whose bricks are loaded.
  void draw_stack(const GpuScene& scene, std::size_t begin, std::size_t end, const Progress& progress);
  /// Passes of several slices front to back, with marks between them that hide what lies behind.
  void draw_unhidden(const PreparedScene& prepared, std::size_t begin, std::size_t end,
                     const Progress& progress);
  /// Local modes: slice by slice from the eye, whatever render.order is, then the colours into `target`.
  void draw_runs(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target,
                 const Progress& progress);
  /// Opaque polygons stop what lies behind them by depth. Back to front they are what slices blend over;
  /// front to back they come last, under the slices.
  void draw_planes_first(const PreparedScene& prepared, const GpuScene& scene) const;
  void draw_planes_last(const PreparedScene& prepared, const GpuScene& scene) const;

  const gl::Functions* gl_;
  gl::Program program_;
  gl::Program classify_program_;     ///< MIP only
  std::optional<gl::Target> maxima_; ///< MIP only
  std::optional<CarriedRuns> runs_;  ///< local modes of labels only
  std::optional<HiddenMarks> marks_; ///< render.skip `empty+hidden` only
  gl::VertexArray vertex_array_;
  gl::VertexArray no_vertices_;
  gl::Buffer corners_;
  gl::Buffer indices_;
  std::vector<std::size_t> index_ends_; ///< of each slice, or pass of several, in the index buffer
  std::vector<SliceNumbers> numbers_;   ///< of each
  int tile_edge_ = 0;                   ///< StackGeometry::tile_edge
  std::size_t planes_in_passes_ = 0;    ///< where passes draw several (render/slabs.h)
  std::optional<PlaneRenderer> planes_; ///< where the scene has some
  std::vector<TileBatch> batches_;      ///< where the volume is held in tiles
};

} // namespace slicelens
