#include "render/rays.h"

#include "gl/check.h"
#include "gl/state.h"
#include "gl/timer.h"
#include "render/cut_planes.h"
#include "render/occupancy.h"
#include "render/ray_frame.h"
#include "render/ray_uniforms.h"
#include "render/several_volumes.h"
#include "render/shaders.h"
#include "render/uniforms.h"

#include <algorithm>

namespace slicelens {

namespace {

/// Texture unit of the occupied cells: behind those of labels, of a pyramid's levels, beside which render.skip
/// is refused.
constexpr GLenum occupancy_unit = 6;

double ray_end_opacity(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  return render.skip == Skip::empty_and_hidden ? std::min(render.early_termination, opaque_enough)
                                               : render.early_termination;
}

} // namespace

RayRenderer::RayRenderer(const gl::Functions& gl, const PreparedScene& prepared) : gl_(&gl) {
  check_sample_count(prepared);
  std::vector<std::string> macros = common_macros(prepared);
  if (ray_end_opacity(prepared) < 1)
    macros.emplace_back("EARLY_TERMINATION");
  if (prepared.skipping.empty)
    macros.emplace_back("OCCUPANCY");
  if (!prepared.scene.planes.empty())
    macros.push_back("CUT_PLANES " + std::to_string(prepared.scene.planes.size()));
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "picture.vert", {});
  const auto fragment = shader_stage(GL_FRAGMENT_SHADER, "rays.frag", macros, generated_files(prepared));
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  program_ = gl::make_program(gl, stages);
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
  if (scene.occupancy) {
    gl.ActiveTexture(GL_TEXTURE0 + occupancy_unit);
    gl.BindTexture(GL_TEXTURE_3D, scene.occupancy.name());
    set_uniform(gl, program_, "occupancy", static_cast<int>(occupancy_unit));
    const auto& dims = prepared.volume.dims;
    set_uniform(gl, program_, "cells_from_texture",
                glm::vec3(dims[0], dims[1], dims[2]) / static_cast<float>(cell_edge));
  }
  set_uniform(gl, program_, "world_from_direction", glm::mat3(prepared.box.world_from_texture));
  const std::vector<CutPlane> shown = cut_planes(prepared);
  for (std::size_t i = 0; i < shown.size(); ++i)
    set_plane(gl, program_, "planes[" + std::to_string(i) + "]", shown[i]);
  gl.BindVertexArray(no_vertices_.name());
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

} // namespace slicelens
