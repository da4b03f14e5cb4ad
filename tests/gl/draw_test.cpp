// What the renderers need of a driver, each feature against values worked by hand.
#include "catch.h"
#include "gl/texture.h"
#include "gl_fixture.h"
#include "gl_fullscreen.h"

using namespace slicelens;
using gl::Functions;

namespace {

/// Draws the constant colours in turn with the blending set by the caller, and gives pixel (0,0).
std::array<float, 4> blend(const Functions& gl, GLenum format, const std::vector<glm::vec4>& colors) {
  const gl::Target target = gl::make_target(gl, 3, 3, format);
  gl::bind_target(gl, target);
  gl.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  const gl::Program program = fullscreen_program(gl, "uniform vec4 value;\nvoid main() { color = value; }\n");
  gl.UseProgram(program.name());
  gl.Enable(GL_BLEND);
  for (const glm::vec4& color : colors) {
    gl::set_uniform(gl, program, "value", color);
    draw_fullscreen(gl, program);
  }
  const std::vector<float> pixels = gl::read_pixels(gl, target);
  return {pixels[0], pixels[1], pixels[2], pixels[3]};
}

} // namespace

TEST_CASE("a triangle covers exactly the pixels whose centres it holds") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const gl::Target target = gl::make_target(gl, 8, 8, GL_RGBA8);
  gl::bind_target(gl, target);
  gl.ClearColor(0.0f, 0.0f, 0.0f, 0.0f);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  // Corners at pixel positions (0,0), (7.5,0), (0,7.5), y upwards: the centre (x+½, y+½) is inside when
  // x + y + 1 < 7.5, so row y has 7 - y pixels; no centre lies on an edge.
  const std::vector<glm::vec2> corners = {{-1.0f, -1.0f}, {0.875f, -1.0f}, {-1.0f, 0.875f}};
  const gl::VertexArray array = gl::make_vertex_array(gl);
  gl.BindVertexArray(array.name());
  const gl::Buffer buffer = gl::make_buffer(gl, GL_ARRAY_BUFFER, std::as_bytes(std::span(corners)));
  gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
  gl.EnableVertexAttribArray(0);
  const gl::Program program = gl::make_program(
      gl, {{GL_VERTEX_SHADER, "v",
            "#version 330 core\nlayout(location = 0) in vec2 p;\nvoid main() { gl_Position = vec4(p, 0.0, "
            "1.0); }\n"},
           {GL_FRAGMENT_SHADER, "f", "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1.0); }\n"}});
  gl.UseProgram(program.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  const std::vector<float> pixels = gl::read_pixels(gl, target);
  int wrong = 0;
  int covered = 0;
  for (int row = 0; row < 8; ++row) {
    for (int x = 0; x < 8; ++x) {
      const int y = 7 - row; // row 0 is the top
      const float value = pixels[4 * static_cast<std::size_t>(row * 8 + x)];
      covered += value == 1.0f ? 1 : 0;
      wrong += value == (x + y <= 6 ? 1.0f : 0.0f) ? 0 : 1;
    }
  }
  CHECK(covered == 28);
  CHECK(wrong == 0);
}

TEST_CASE("float targets blend with 'over' without clamping") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  // (4, ½) over (2, ¼) over nothing, associated: 4 + ½·2 = 5; ½ + ½·¼ = .625. Exact in half and float.
  for (const GLenum format : {GL_RGBA16F, GL_RGBA32F}) {
    const auto pixel = blend(gl, format, {{2.0f, 0.0f, 0.0f, 0.25f}, {4.0f, -1.0f, 0.0f, 0.5f}});
    CHECK(pixel[0] == 5.0f);
    CHECK(pixel[1] == -1.0f);
    CHECK(pixel[3] == 0.625f);
  }
}

TEST_CASE("float targets blend with 'under'") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  gl.BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
  // (2, ¼) under (4, ½): 4 + ½·2 = 5; the same picture as 'over' in the other order.
  const auto pixel = blend(gl, GL_RGBA32F, {{4.0f, -1.0f, 0.0f, 0.5f}, {2.0f, 0.0f, 0.0f, 0.25f}});
  CHECK(pixel[0] == 5.0f);
  CHECK(pixel[1] == -1.0f);
  CHECK(pixel[3] == 0.625f);
}

TEST_CASE("blending with GL_MAX and GL_MIN keeps the extreme of each channel") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  gl.BlendFunc(GL_ONE, GL_ONE); // ignored by MAX and MIN
  gl.BlendEquation(GL_MAX);
  auto pixel = blend(gl, GL_RGBA32F, {{1.0f, 0.2f, -3.0f, 0.5f}, {0.5f, 7.0f, -2.0f, 0.75f}});
  CHECK(pixel == std::array<float, 4>{1.0f, 7.0f, 0.0f, 0.75f}); // the clear colour 0 is the largest blue
  gl.BlendEquation(GL_MIN);
  pixel = blend(gl, GL_RGBA32F, {{1.0f, 0.2f, -3.0f, 0.5f}, {0.5f, 7.0f, -2.0f, 0.75f}});
  CHECK(pixel == std::array<float, 4>{0.0f, 0.0f, -3.0f, 0.0f});
}

TEST_CASE("float volumes are filtered trilinearly") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  // v(i,j,k) = i + 10j + 100k at the texel centres is linear, so the filter gives back the same formula
  // between them.
  std::vector<float> values;
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i)
        values.push_back(static_cast<float>(i + 10 * j + 100 * k));
  const gl::Texture texture = gl::make_texture_3d(gl, {.format = GL_R32F, .filter = GL_LINEAR}, {2, 2, 2},
                                                  std::as_bytes(std::span(values)));
  const gl::Target target = gl::make_target(gl, 3, 3, GL_RGBA32F);
  gl::bind_target(gl, target);
  const gl::Program program =
      fullscreen_program(gl, "uniform sampler3D volume;\nvoid main() { color = texture(volume, "
                             "vec3((gl_FragCoord.xy - 0.5) * 0.25 + 0.25, 0.375)); }\n");
  gl.BindTexture(GL_TEXTURE_3D, texture.name());
  draw_fullscreen(gl, program);
  const std::vector<float> pixels = gl::read_pixels(gl, target);
  for (int row = 0; row < 3; ++row) {
    for (int x = 0; x < 3; ++x) {
      // Pixel x samples at ¼ + x/4, which is index x/2; depth .375 is index ¼.
      const double expected = x * 0.5 + (2 - row) * 0.5 * 10.0 + 25.0;
      // The weights ½ and ¼ are exact even in 8 bits; the products are exact in float.
      CHECK(static_cast<double>(pixels[4 * static_cast<std::size_t>(row * 3 + x)]) ==
            Approx(expected).epsilon(1e-6));
    }
  }
}

TEST_CASE("a picture is read with its top row first") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const gl::Target target = gl::make_target(gl, 3, 5, GL_RGBA32F);
  gl::bind_target(gl, target);
  draw_fullscreen(gl, fullscreen_program(gl, "void main() { color = vec4(gl_FragCoord.xy, 0.0, 2.5); }\n"));
  gl.PixelStorei(GL_PACK_ALIGNMENT, 8);
  gl.PixelStorei(GL_PACK_SKIP_ROWS, 2);
  const std::vector<float> pixels = gl::read_pixels(gl, target);
  REQUIRE(pixels.size() == 60);
  for (std::size_t row = 0; row < 5; ++row) {
    for (std::size_t x = 0; x < 3; ++x) {
      const float* pixel = &pixels[4 * (row * 3 + x)];
      CHECK(pixel[0] == static_cast<float>(x) + 0.5f);
      CHECK(pixel[1] == 4.5f - static_cast<float>(row));
      CHECK(pixel[3] == 2.5f);
    }
  }
  GLint value = 0;
  gl.GetIntegerv(GL_PACK_SKIP_ROWS, &value);
  CHECK(value == 2);
}
