#include "render/rays.h"

#include "gl/check.h"
#include "gl/state.h"
#include "gl/timer.h"
#include "render/blending.h"
#include "render/cut_planes.h"
#include "render/occupancy.h"
#include "render/paged_draw.h"
#include "render/ray_frame.h"
#include "render/ray_uniforms.h"
#include "render/several_volumes.h"
#include "render/shaders.h"
#include "render/uniforms.h"
#include "slicing/slice_stack.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

double ray_end_opacity(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  return render.skip == Skip::empty_and_hidden ? std::min(render.early_termination, opaque_enough)
                                               : render.early_termination;
}

/// Whether parts of rays become a picture only when all are there: the largest value of a ray is classified,
/// not that of each part.
bool gathers_parts(const PreparedScene& prepared) {
  return any_paged(prepared) && classifies_last(prepared.scene.render.mode);
}

/// Parts of rays are as long as bricks allow; entries are single samples.
std::vector<SliceNumbers> sample_numbers(const PreparedScene& prepared) {
  const ScreenCover all = cover_of_samples(prepared, {prepared.object_low, prepared.object_high});
  const double first = std::max(std::floor(all.near - 0.5), -1.0 * max_planes);
  const double last = std::min(std::ceil(all.far - 0.5), 1.0 * max_planes);
  std::vector<SliceNumbers> numbers;
  for (auto k = static_cast<std::int64_t>(first); k <= static_cast<std::int64_t>(last); ++k)
    numbers.push_back({k, k});
  return numbers;
}

} // namespace

RayRenderer::RayRenderer(const gl::Functions& gl, const PreparedScene& prepared) : gl_(&gl) {
  check_sample_count(prepared);
  std::vector<std::string> macros = common_macros(prepared);
  if (ray_end_opacity(prepared) < 1)
    macros.emplace_back("EARLY_TERMINATION");
  if (uses_occupancy(prepared))
    macros.emplace_back("OCCUPANCY");
  if (!prepared.scene.planes.empty())
    macros.push_back("CUT_PLANES " + std::to_string(prepared.scene.planes.size()));
  if (any_paged(prepared))
    macros.emplace_back("PARTS");
  const std::vector<EmbeddedFile> generated = generated_files(prepared);
  const auto program_of = [&](const std::string& entry, const std::vector<std::string>& with) {
    std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "picture.vert", {});
    const auto fragment = shader_stage(GL_FRAGMENT_SHADER, entry, with, generated);
    stages.insert(stages.end(), fragment.begin(), fragment.end());
    return gl::make_program(gl, stages);
  };
  program_ = program_of("rays.frag", macros);
  if (gathers_parts(prepared))
    classify_program_ = program_of("classify_maximum.frag", common_macros(prepared));
  no_vertices_ = gl::make_vertex_array(gl);
}

void RayRenderer::draw(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target,
                       const Progress& progress) {
  const gl::Functions& gl = *gl_;
  const gl::StateGuard guard(gl);
  gl::bind_target(gl, target);
  for (const GLenum off : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE, GL_DITHER})
    gl.Disable(off);
  gl.UseProgram(program_.name());
  set_common_uniforms(gl, program_, prepared, scene);
  set_ray_uniforms(gl, program_, prepared);
  set_uniform(gl, program_, "xray_scale", static_cast<float>(prepared.xray_scale));
  set_uniform(gl, program_, "early_termination", static_cast<float>(ray_end_opacity(prepared)));
  set_occupancy(gl, program_, scene.occupancy);
  set_uniform(gl, program_, "world_from_direction", glm::mat3(prepared.box.world_from_texture));
  const std::vector<CutPlane> shown = cut_planes(prepared);
  for (std::size_t i = 0; i < shown.size(); ++i)
    set_plane(gl, program_, "planes[" + std::to_string(i) + "]", shown[i]);
  gl.BindVertexArray(no_vertices_.name());
  if (any_paged(prepared)) {
    draw_parts(prepared, scene, target);
    gl::check_errors(gl, "casting the rays in parts");
    return;
  }
  // One triangle draws the picture. Only where somebody watches it is cut into bands.
  const int band = progress.advance ? std::max(16, target.height / 32) : target.height;
  gl.Enable(GL_SCISSOR_TEST);
  for (int y = 0; y < target.height; y += band) {
    gl.Scissor(0, y, target.width, std::min(band, target.height - y));
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    if (progress.advance) {
      gl::finish(gl);
      report_progress(progress, "draw",
                      static_cast<double>(std::min(y + band, target.height)) / target.height);
    }
  }
  gl::check_errors(gl, "casting the rays");
}

void RayRenderer::draw_parts(const PreparedScene& prepared, const GpuScene& scene, const gl::Target& target) {
  const gl::Functions& gl = *gl_;
  const RenderSettings& render = prepared.scene.render;
  const bool gathers = gathers_parts(prepared);
  if (gathers && (!gathered_ || gathered_->width != target.width || gathered_->height != target.height))
    gathered_ = gl::make_target(gl, target.width, target.height, GL_RGBA32F);
  gl::bind_target(gl, gathered_ ? *gathered_ : target);
  const bool below_all = gathers && prepared.others.empty() && render.mode != Mode::average;
  gl.ClearColor(below_all ? -3.0e38F : 0.0F, 0, 0, 0);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  set_blending(gl, render.mode, Order::front_to_back); // each part lies behind those before it
  const bool effects = has_highlight(prepared.effects) || has_attenuation(prepared.effects);
  const bool picks = gathers && effects; // a maximum brings its own effects along
  const Splitting splitting =
      has_local_modes(prepared.labels) || picks ? Splitting::nowhere : Splitting::everywhere;
  const std::vector<SliceNumbers> numbers = sample_numbers(prepared);
  draw_in_parts(gl, prepared, scene, numbers, target, splitting, "what each ray gathers",
                [&](std::size_t begin, std::size_t end) {
                  set_uniform(gl, program_, "sample_range",
                              glm::vec2(numbers[begin].first, numbers[end - 1].last));
                  gl.DrawArrays(GL_TRIANGLES, 0, 3);
                });
  if (gathers) {
    const glm::dvec2 value_from_unit(render.mode == Mode::minip ? -1 : 1, 0);
    classify_gathered(gl, classify_program_, prepared, scene, *gathered_, value_from_unit, target);
  }
}

} // namespace slicelens
