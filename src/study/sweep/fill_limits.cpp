#include "study/sweep/fill_limits.h"

#include "gl/state.h"
#include "gl/timer.h"
#include "render/shaders.h"

#include <cstdint>
#include <span>

namespace slicelens {

namespace {

constexpr int edge = 512;
constexpr int layers = 64;
constexpr int voxels = 64;
constexpr int texels = 256;

gl::Program fill_program(const gl::Functions& gl, int fill) {
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "fill.vert", {});
  const auto fragment = shader_stage(GL_FRAGMENT_SHADER, "fill.frag", {"FILL " + std::to_string(fill)});
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  return gl::make_program(gl, stages);
}

/// Values that differ from voxel to voxel, so that no driver finds the volume uniform.
std::vector<std::uint16_t> volume_texels() {
  std::vector<std::uint16_t> data(std::size_t{voxels} * voxels * voxels);
  std::uint32_t state = 1;
  for (std::uint16_t& value : data) {
    state = state * 1664525U + 1013904223U;
    value = static_cast<std::uint16_t>(state >> 16);
  }
  return data;
}

/// Opacities of a hundredth: no layer hides the ones behind it.
std::vector<float> table_texels() {
  std::vector<float> data;
  for (int i = 0; i < texels; ++i) {
    const float grey = static_cast<float>(i) / (texels - 1);
    data.insert(data.end(), {grey, grey, 1 - grey, 0.01F});
  }
  return data;
}

} // namespace

FillLimits::FillLimits(const gl::Functions& gl)
    : gl_(&gl), programs_{fill_program(gl, 0), fill_program(gl, 1), fill_program(gl, 2)},
      target_(gl::make_target(gl, edge, edge, GL_RGBA32F)), no_vertices_(gl::make_vertex_array(gl)) {
  const std::vector<std::uint16_t> volume = volume_texels();
  volume_ = gl::make_texture_3d(gl, {GL_R16}, {voxels, voxels, voxels}, std::as_bytes(std::span(volume)));
  const std::vector<float> table = table_texels();
  table_ = gl::make_texture_1d(gl, {GL_RGBA32F}, texels, std::as_bytes(std::span(table)));
}

FillRates FillLimits::measure() const {
  const gl::Functions& gl = *gl_;
  const gl::StateGuard guard(gl);
  gl::bind_target(gl, target_);
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  gl.Enable(GL_BLEND);
  gl.BlendEquation(GL_FUNC_ADD);
  gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_3D, volume_.name());
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_1D, table_.name());
  gl.BindVertexArray(no_vertices_.name());
  std::array<double, 3> rates{};
  for (std::size_t i = 0; i < rates.size(); ++i) {
    gl.UseProgram(programs_[i].name());
    gl::set_uniform(gl, programs_[i], "layers", layers);
    gl::set_uniform(gl, programs_[i], "volume", 0);
    gl::set_uniform(gl, programs_[i], "table", 1);
    const auto draw = [&] {
      gl.ClearColor(0, 0, 0, 0);
      gl.Clear(GL_COLOR_BUFFER_BIT);
      gl.DrawArrays(GL_TRIANGLES, 0, 3 * layers);
    };
    draw(); // drivers compile a shader at its first draw
    rates[i] = static_cast<double>(edge) * edge * layers / gl::elapsed_seconds(gl, draw);
  }
  return {rates[0], rates[1], rates[2]};
}

} // namespace slicelens
