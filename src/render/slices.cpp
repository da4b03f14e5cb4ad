#include "render/slices.h"

#include "core/errors.h"
#include "gl/check.h"
#include "gl/state.h"
#include "gl/timer.h"
#include "render/blending.h"
#include "render/paged_draw.h"
#include "render/pass_tiles.h"
#include "render/ray_uniforms.h"
#include "render/several_volumes.h"
#include "render/shaders.h"
#include "render/slabs.h"
#include "render/stack_geometry.h"
#include "render/tiled_draw.h"
#include "render/uniforms.h"

#include <algorithm>
#include <cstddef>

namespace slicelens {

namespace {

/// Maps of the value to [0,1] and back, for targets that hold no more. The smallest value is the largest
/// unit where the mode looks for it.
glm::dvec2 unit_from_value(const PreparedScene& prepared) {
  const Volume& volume = prepared.volume;
  const double range = volume.max > volume.min ? volume.max - volume.min : 1;
  if (prepared.scene.render.mode == Mode::minip)
    return {-1 / range, (volume.min + range) / range};
  return {1 / range, -volume.min / range};
}
glm::dvec2 value_from_unit(const PreparedScene& prepared) {
  const glm::dvec2 forward = unit_from_value(prepared);
  return {1 / forward.x, -forward.y / forward.x};
}

/// Texture unit of what is gathered, read between passes: behind those of labels, of a pyramid's levels,
/// beside which render.skip is refused.
constexpr GLenum marks_unit = 6;

/// Under MIP the winning sample keeps its own highlight and attenuation, which the largest of each channel
/// would mix up: a depth test picks the sample instead.
bool picks_winner(const PreparedScene& prepared) {
  return classifies_last(prepared.scene.render.mode) &&
         (has_highlight(prepared.effects) || has_attenuation(prepared.effects));
}

/// The largest value wins; of equal ones the nearest, as along a ray.
void set_depth_test(const gl::Functions& gl, const RenderSettings& render) {
  gl.Disable(GL_BLEND);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(render.order == Order::back_to_front ? GL_GEQUAL : GL_GREATER);
  gl.ClearDepth(0);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
}

/// Tiles are drawn as points: squares that lie on the pixels exactly and, unlike pairs of triangles, have no
/// diagonal along which drivers shade twice. The viewport is one of whole tiles, as a point whose middle is
/// outside is not drawn.
void begin_tiles(const gl::Functions& gl, const gl::Target& target, int edge) {
  GLfloat sizes[2] = {1, 1};
  gl.GetFloatv(GL_POINT_SIZE_RANGE, sizes);
  if (sizes[1] < static_cast<GLfloat>(edge))
    throw GraphicsError("render.skip draws points of " + std::to_string(edge) +
                        " pixels, and this driver's are at most " +
                        std::to_string(static_cast<int>(sizes[1])) + "; set render.skip to none");
  gl.PointSize(static_cast<float>(edge));
  gl.Viewport(0, 0, whole_tiles(target.width, edge), whole_tiles(target.height, edge));
}

} // namespace

SliceRenderer::SliceRenderer(const gl::Functions& gl, const PreparedScene& prepared) : gl_(&gl) {
  const std::vector<EmbeddedFile> generated = generated_files(prepared);
  const std::string name = draws_slabs(prepared) ? "slabs" : "slices";
  std::vector<std::string> macros = common_macros(prepared);
  if (marks_hidden(prepared))
    macros.emplace_back("HIDDEN");
  if (uses_occupancy(prepared))
    macros.emplace_back("OCCUPANCY");
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, name + ".vert", macros);
  const auto fragment = shader_stage(GL_FRAGMENT_SHADER, name + ".frag", macros, generated);
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  program_ = gl::make_program(gl, stages);
  if (!prepared.scene.planes.empty())
    planes_.emplace(gl, prepared);
  vertex_array_ = gl::make_vertex_array(gl);
  no_vertices_ = gl::make_vertex_array(gl);
  if (classifies_last(prepared.scene.render.mode)) {
    std::vector<gl::ShaderSource> second = shader_stage(GL_VERTEX_SHADER, "picture.vert", {});
    const auto classify =
        shader_stage(GL_FRAGMENT_SHADER, "classify_maximum.frag", common_macros(prepared), generated);
    second.insert(second.end(), classify.begin(), classify.end());
    classify_program_ = gl::make_program(gl, second);
  }
}

void SliceRenderer::slice(const PreparedScene& prepared) {
  set_geometry(draws_slabs(prepared) ? make_slab_geometry(prepared) : make_stack_geometry(prepared));
}

void SliceRenderer::set_geometry(const StackGeometry& geometry) {
  index_ends_ = geometry.index_ends;
  numbers_ = geometry.numbers;
  batches_ = geometry.batches;
  planes_in_passes_ = geometry.planes;
  tile_edge_ = geometry.tile_edge;

  const gl::StateGuard guard(*gl_);
  gl_->BindVertexArray(vertex_array_.name());
  corners_ = gl::make_buffer(*gl_, GL_ARRAY_BUFFER, std::as_bytes(std::span(geometry.vertices)));
  const auto attribute = [&](const char* name, GLint size, std::size_t offset) {
    const GLint location = gl_->GetAttribLocation(program_.name(), name);
    if (location < 0)
      return; // not every program reads all of a corner
    gl_->EnableVertexAttribArray(static_cast<GLuint>(location));
    gl_->VertexAttribPointer(static_cast<GLuint>(location), size, GL_FLOAT, GL_FALSE, sizeof(StackVertex),
                             reinterpret_cast<const void*>(offset));
  };
  attribute("corner", 3, offsetof(StackVertex, position));
  attribute("look", 4, offsetof(StackVertex, texture));
  indices_ = gl::make_buffer(*gl_, GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(geometry.indices)));
}

void SliceRenderer::draw_entries(std::size_t begin, std::size_t end) const {
  if (begin >= end)
    return;
  const std::size_t first = begin == 0 ? 0 : index_ends_[begin - 1];
  gl_->DrawElements(tile_edge_ > 0 ? GL_POINTS : GL_TRIANGLES,
                    static_cast<GLsizei>(index_ends_[end - 1] - first), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(first * sizeof(std::uint32_t)));
}

void SliceRenderer::draw_stack(const GpuScene& scene, std::size_t begin, std::size_t end,
                               const Progress& progress) {
  if (!batches_.empty()) {
    draw_batches(*gl_, program_, scene, batches_, progress);
    return;
  }
  // One call draws the whole stack in order. Only where somebody watches it is cut into steps.
  const std::size_t count = index_ends_.size();
  const std::size_t step =
      progress.advance ? std::max<std::size_t>(1, count / 50) : std::max<std::size_t>(1, count);
  for (std::size_t i = begin; i < end; i += step) {
    draw_entries(i, std::min(end, i + step));
    if (progress.advance) {
      gl::finish(*gl_);
      report_progress(progress, "draw",
                      static_cast<double>(std::min(end, i + step)) / static_cast<double>(count));
    }
  }
}

void SliceRenderer::draw_unhidden(const PreparedScene& prepared, std::size_t first, std::size_t last,
                                  const Progress& progress) {
  const gl::Functions& gl = *gl_;
  const std::size_t every = std::max<std::size_t>(1, slices_per_mark / prepared.scene.render.planes_per_pass);
  const std::size_t count = index_ends_.size();
  // Nothing is opaque before so many slices.
  const double safe =
      prepared.skipping.opaque_after / static_cast<double>(prepared.scene.render.planes_per_pass);
  for (std::size_t i = first; i < last; i += every) {
    gl.UseProgram(program_.name());
    gl.BindVertexArray(vertex_array_.name());
    draw_entries(i, std::min(last, i + every));
    if (i + every < count && static_cast<double>(i + every) >= safe)
      marks_->mark(marks_unit);
    if (progress.advance) {
      gl::finish(gl);
      report_progress(progress, "draw",
                      static_cast<double>(std::min(last, i + every)) / static_cast<double>(count));
    }
  }
}

void SliceRenderer::draw_runs(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target,
                              const Progress& progress) {
  const gl::Functions& gl = *gl_;
  if (!runs_ || runs_->width() != target.width || runs_->height() != target.height)
    runs_.emplace(gl, target.width, target.height);
  set_uniform(gl, program_, "xray_scale", static_cast<float>(prepared.xray_scale));
  runs_->begin(program_);
  const std::size_t count = index_ends_.size();
  const std::size_t step = std::max<std::size_t>(1, count / 50);
  const bool reversed = prepared.scene.render.order == Order::back_to_front;
  std::vector<SliceNumbers> numbers = numbers_;
  if (reversed)
    std::reverse(numbers.begin(), numbers.end());
  draw_in_parts(gl, prepared, scene, numbers, target, Splitting::along_view, "mode 'two-level' with runs",
                [&](std::size_t begin, std::size_t end) {
                  for (std::size_t n = begin; n < end; ++n) {
                    const std::size_t i = reversed ? count - 1 - n : n;
                    runs_->before_slice(program_, n);
                    draw_entries(i, i + 1);
                    if (progress.advance && (n + 1) % step == 0) {
                      gl::finish(gl);
                      report_progress(progress, "draw",
                                      static_cast<double>(n + 1) / static_cast<double>(count));
                    }
                  }
                });
  gl::bind_target(gl, target);
  gl.BindVertexArray(no_vertices_.name());
  runs_->end(prepared.xray_scale);
}

void SliceRenderer::draw(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target,
                         const Progress& progress) {
  const gl::Functions& gl = *gl_;
  const gl::StateGuard guard(gl);
  const RenderSettings& render = prepared.scene.render;
  const View& view = prepared.view;
  if (classifies_last(render.mode) &&
      (!maxima_ || maxima_->width != target.width || maxima_->height != target.height ||
       maxima_->format != target.format)) {
    maxima_ = gl::make_target(gl, target.width, target.height, target.format);
    if (picks_winner(prepared))
      gl::attach_depth(gl, *maxima_);
  }
  gl::bind_target(gl, maxima_ ? *maxima_ : target);
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  gl.Disable(GL_DITHER);
  const bool below_all =
      maxima_ && target.format != GL_RGBA8 && prepared.others.empty() && render.mode != Mode::average;
  gl.ClearColor(below_all ? -1.0F : 0.0F, 0, 0, 0);
  gl.Clear(GL_COLOR_BUFFER_BIT);

  if (planes_)
    draw_planes_first(prepared, scene);
  gl.UseProgram(program_.name());
  set_common_uniforms(gl, program_, prepared, scene);
  set_uniform(gl, program_, "clip_from_texture", glm::mat4(clip_from_texture(prepared)));
  set_uniform(gl, program_, "unit_from_value", glm::vec2(unit_from_value(prepared)));
  set_uniform(gl, program_, "eye", glm::vec3(view.eye));
  set_uniform(gl, program_, "world_from_texture", glm::mat4(prepared.box.world_from_texture));
  set_uniform(gl, program_, "slope_from_pixel",
              glm::vec4(2 * half_width(view) / view.width, 2 * view.half_height / view.height,
                        -half_width(view), -view.half_height));
  if (draws_slabs(prepared)) {
    set_slab_uniforms(gl, program_, prepared);
    set_occupancy(gl, program_, scene.occupancy);
  } else if (render.proxy == Proxy::shells || render.classification == Classification::preintegrated) {
    set_ray_uniforms(gl, program_, prepared);
    set_uniform(gl, program_, "place_from_pixel", 2.0F / glm::vec2(view.width, view.height));
  }
  gl.BindVertexArray(vertex_array_.name());
  if (has_local_modes(prepared.labels)) {
    draw_runs(prepared, scene, target, progress);
    gl::check_errors(gl, "drawing the runs of labels");
    return;
  }
  if (picks_winner(prepared))
    set_depth_test(gl, render);
  else
    set_blending(gl, render.mode, render.order);
  const bool marked = marks_hidden(prepared);
  if (marked) {
    if (!marks_ || !marks_->fits(target))
      marks_.emplace(gl, target);
    marks_->begin();
  }
  if (tile_edge_ > 0)
    begin_tiles(gl, target, tile_edge_);
  draw_in_parts(gl, prepared, scene, numbers_, target, Splitting::everywhere, "the stack",
                [&](std::size_t begin, std::size_t end) {
                  if (marked)
                    draw_unhidden(prepared, begin, end, progress);
                  else
                    draw_stack(scene, begin, end, progress);
                });
  gl.PointSize(1);
  gl.Viewport(0, 0, target.width, target.height);
  if (planes_)
    draw_planes_last(prepared, scene);
  if (maxima_) {
    gl.BindVertexArray(no_vertices_.name());
    classify_gathered(gl, classify_program_, prepared, scene, *maxima_, value_from_unit(prepared), target);
  }
  gl::check_errors(gl, "drawing the slices");
}

void SliceRenderer::draw_planes_first(const PreparedScene& prepared, const GpuScene& scene) const {
  const gl::Functions& gl = *gl_;
  const bool color = prepared.scene.render.order == Order::back_to_front;
  gl.Disable(GL_BLEND);
  gl.Enable(GL_DEPTH_TEST);
  gl.DepthMask(GL_TRUE);
  gl.DepthFunc(GL_LESS);
  gl.ClearDepth(1);
  gl.Clear(GL_DEPTH_BUFFER_BIT);
  const GLboolean write = color ? GL_TRUE : GL_FALSE;
  gl.ColorMask(write, write, write, write);
  planes_->draw(prepared, scene);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.DepthMask(GL_FALSE);
}

void SliceRenderer::draw_planes_last(const PreparedScene& prepared, const GpuScene& scene) const {
  if (prepared.scene.render.order == Order::back_to_front)
    return;
  gl_->DepthFunc(GL_EQUAL);
  planes_->draw(prepared, scene);
}

} // namespace slicelens
