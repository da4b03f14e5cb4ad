// shaders/lib/opacity.glsl as the GPU evaluates it, against double precision.

#include "bench.h"
#include "gl/check.h"
#include "gl/program.h"
#include "gl/state.h"
#include "gl/target.h"
#include "gl/texture.h"
#include "render/shaders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace slicelens::accuracy {

namespace {

constexpr int kAlphas = 512; // along x
constexpr int kRatios = 64;  // along y

/// Opacities from 1e-7 to 1, half of them spread by decades and half evenly.
std::vector<float> alphas() {
  std::vector<float> list;
  for (int i = 0; i < kAlphas / 2; ++i)
    list.push_back(static_cast<float>(std::pow(10.0, -7 + 7.0 * i / (kAlphas / 2))));
  for (int i = 0; i < kAlphas / 2; ++i)
    list.push_back(static_cast<float>((i + 1.0) / (kAlphas / 2 + 1)));
  return list;
}

/// Ratios from 1/1000 to 16.
std::vector<float> ratios() {
  std::vector<float> list;
  for (int i = 0; i < kRatios; ++i)
    list.push_back(static_cast<float>(std::pow(10.0, -3 + (3 + std::log10(16.0)) * i / (kRatios - 1))));
  return list;
}

const char* const kMain = R"(
uniform sampler2D alphas;
uniform sampler2D ratios;
out vec4 result;
void main() {
  float alpha = texelFetch(alphas, ivec2(int(gl_FragCoord.x), 0), 0).r;
  float ratio = texelFetch(ratios, ivec2(int(gl_FragCoord.y), 0), 0).r;
  result = vec4(corrected_opacity(alpha, ratio), 1.0 - pow(1.0 - alpha, ratio), 0.0, 1.0);
}
)";

/// (corrected_opacity, naive form) for every pair; row 0 is the last ratio.
std::vector<float> on_gpu(const gl::Functions& gl) {
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "picture.vert", {});
  const auto fragment = shader_stage(GL_FRAGMENT_SHADER, "lib/opacity.glsl", {});
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  stages.push_back({GL_FRAGMENT_SHADER, "opacity table", kMain});
  const gl::Program program = gl::make_program(gl, stages);
  const gl::VertexArray array = gl::make_vertex_array(gl);
  const gl::Target target = gl::make_target(gl, kAlphas, kRatios, GL_RGBA32F);
  gl::TextureSpec spec;
  spec.format = GL_R32F;
  spec.filter = GL_NEAREST;
  const std::vector<float> a = alphas();
  const std::vector<float> r = ratios();
  const gl::Texture alpha_texture = gl::make_texture_2d(gl, spec, {kAlphas, 1}, std::as_bytes(std::span(a)));
  const gl::Texture ratio_texture = gl::make_texture_2d(gl, spec, {kRatios, 1}, std::as_bytes(std::span(r)));
  const gl::StateGuard guard(gl);
  gl::bind_target(gl, target);
  gl.Disable(GL_BLEND);
  gl.UseProgram(program.name());
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, alpha_texture.name());
  gl.ActiveTexture(GL_TEXTURE1);
  gl.BindTexture(GL_TEXTURE_2D, ratio_texture.name());
  gl::set_uniform(gl, program, "alphas", 0);
  gl::set_uniform(gl, program, "ratios", 1);
  gl.BindVertexArray(array.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gl::check_errors(gl, "evaluating the opacity correction");
  return gl::read_pixels(gl, target);
}

} // namespace

void opacity_section(const Bench& bench) {
  say("opacity correction on the GPU");
  std::cout
      << "## The opacity correction itself\n\n"
         "`shaders/lib/opacity.glsl` computes α' = 1 − (1 − α)^r as −expm1(r·log1p(−α)). Largest relative "
         "error on this GPU against double precision, beside the usual 1 − pow(1 − α, r), for "
      << kAlphas << " opacities and " << kRatios << " ratios from 1/1000 to 16.\n\n";
  const std::vector<float> a = alphas();
  const std::vector<float> r = ratios();
  const std::vector<float> pixels = on_gpu(bench.context.functions());
  const std::array<double, 7> decades = {1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1.0};
  double worst = 0;
  {
    Table table({"opacity", "largest relative error", "of 1 − pow(1 − α, r)"});
    for (std::size_t d = 0; d + 1 < decades.size(); ++d) {
      double ours = 0;
      double naive = 0;
      for (int y = 0; y < kRatios; ++y) {
        for (int x = 0; x < kAlphas; ++x) {
          const double alpha = static_cast<double>(a[static_cast<std::size_t>(x)]);
          if (alpha < decades[d] * (1 - 1e-6) || alpha >= decades[d + 1])
            continue;
          const double ratio = static_cast<double>(r[static_cast<std::size_t>(y)]);
          const double truth = -std::expm1(ratio * std::log1p(-alpha));
          const auto texel = 4 * static_cast<std::size_t>((kRatios - 1 - y) * kAlphas + x);
          ours = std::max(ours, std::abs(static_cast<double>(pixels[texel]) - truth) / truth);
          naive = std::max(naive, std::abs(static_cast<double>(pixels[texel + 1]) - truth) / truth);
        }
      }
      worst = std::max(worst, ours);
      table.row({scientific(decades[d]) + " to " + scientific(decades[d + 1]), scientific(ours),
                 scientific(naive)});
    }
  }
  bar("largest relative error", scientific(worst), "≤ 1e-5", worst <= 1e-5);
  std::cout << std::endl;
}

} // namespace slicelens::accuracy
