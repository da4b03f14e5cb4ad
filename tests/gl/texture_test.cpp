#include "catch.h"
#include "gl/state.h"
#include "gl/texture.h"
#include "gl_fixture.h"
#include "gl_fullscreen.h"

#include <cstring>
#include <random>

using namespace slicelens;
using gl::Functions;

namespace {

constexpr const char* fetch_body =
    "uniform sampler3D volume;\n"
    "uniform ivec3 size;\n"
    "void main() {\n"
    "  ivec2 p = ivec2(gl_FragCoord.xy);\n"
    "  color = texelFetch(volume, ivec3(p.x, p.y % size.y, p.y / size.y), 0);\n"
    "}\n";

/// All texels of a 3D texture as the shader sees them, RGBA, x fastest, then y, then z.
std::vector<float> fetch_all(const Functions& gl, const gl::Texture& texture, std::array<int, 3> size) {
  const gl::Target target = gl::make_target(gl, size[0], size[1] * size[2], GL_RGBA32F);
  const gl::Program program = fullscreen_program(gl, fetch_body);
  gl::bind_target(gl, target);
  gl.UseProgram(program.name());
  gl.BindTexture(GL_TEXTURE_3D, texture.name());
  gl::set_uniform(gl, program, "volume", 0);
  gl::set_uniform(gl, program, "size", glm::ivec3(size[0], size[1], size[2]));
  draw_fullscreen(gl, program);
  const std::vector<float> rows = gl::read_pixels(gl, target);
  // read_pixels starts at the top, the texels at the bottom.
  const std::size_t row = 4 * static_cast<std::size_t>(size[0]);
  const std::size_t count = static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]);
  std::vector<float> texels;
  for (std::size_t y = count; y-- > 0;)
    texels.insert(texels.end(), rows.begin() + static_cast<std::ptrdiff_t>(y * row),
                  rows.begin() + static_cast<std::ptrdiff_t>((y + 1) * row));
  return texels;
}

/// Uploads `values` (as many as the format's channels times 5·3·4 texels) and compares what comes back with
/// value / `scale`, within `margin`.
template <class Value>
void check_round_trip(GLenum format, std::size_t channels, const std::vector<Value>& values, double scale,
                      double margin) {
  const std::array<int, 3> size = {5, 3, 4}; // odd rows: a row alignment of 4 or 8 would shear them
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  REQUIRE(values.size() == 60 * channels);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 8);
  gl.PixelStorei(GL_UNPACK_ROW_LENGTH, 100);
  gl.PixelStorei(GL_UNPACK_SKIP_PIXELS, 3);
  const gl::Texture texture = gl::make_texture_3d(gl, {.format = format, .filter = GL_NEAREST}, size,
                                                  std::as_bytes(std::span(values)));
  GLint alignment = 0;
  GLint row_length = 0;
  gl.GetIntegerv(GL_UNPACK_ALIGNMENT, &alignment);
  gl.GetIntegerv(GL_UNPACK_ROW_LENGTH, &row_length);
  CHECK(alignment == 8);
  CHECK(row_length == 100);
  const std::vector<float> texels = fetch_all(gl, texture, size);
  for (std::size_t i = 0; i < 60; ++i) {
    for (std::size_t c = 0; c < channels; ++c) {
      const double expected = static_cast<double>(values[i * channels + c]) / scale;
      CHECK(std::abs(static_cast<double>(texels[4 * i + c]) - expected) <= margin);
    }
  }
}

template <class Value>
std::vector<Value> random_values(std::size_t count, double low, double high) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> distribution(low, high);
  std::vector<Value> values(count);
  for (Value& value : values)
    value = static_cast<Value>(distribution(random));
  values.front() = static_cast<Value>(low);
  values.back() = static_cast<Value>(high);
  return values;
}

std::string limit_message(const std::function<void()>& work) {
  try {
    work();
  } catch (const LimitError& error) {
    return error.what();
  }
  return "";
}

} // namespace

// A normalised value is one float division or multiplication away from the integer: two roundings of 6e-8.
TEST_CASE("an R8 volume reads back as value / 255") {
  check_round_trip(GL_R8, 1, random_values<unsigned char>(60, 0, 255), 255.0, 1.2e-7);
}

TEST_CASE("an R16 volume reads back as value / 65535") {
  check_round_trip(GL_R16, 1, random_values<unsigned short>(60, 0, 65535), 65535.0, 1.2e-7);
}

TEST_CASE("an R16_SNORM volume reads back as value / 32767") {
  check_round_trip(GL_R16_SNORM, 1, random_values<short>(60, -32767, 32767), 32767.0, 1.2e-7);
}

TEST_CASE("an R32F volume reads back bit for bit") {
  check_round_trip(GL_R32F, 1, random_values<float>(60, -3e3, 1e7), 1.0, 0.0);
}

TEST_CASE("an RGBA32F volume reads back bit for bit") {
  check_round_trip(GL_RGBA32F, 4, random_values<float>(240, -1.0, 70000.0), 1.0, 0.0);
}

TEST_CASE("a volume is uploaded slab by slab, in order, every plane once") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const std::array<int, 3> size = {1024, 1024, 18}; // 1 MiB a plane: slabs of 16 and 2 planes
  const auto value = [](int x, int y, int z) {
    return static_cast<unsigned char>((x * 7 + y * 13 + z * 31) % 256);
  };
  std::vector<std::array<int, 2>> slabs;
  std::vector<double> progress;
  const gl::Texture texture =
      gl::make_texture_3d(gl, {.format = GL_R8, .filter = GL_NEAREST}, size,
                          [&](int z0, int z1, std::span<std::byte> slab) {
                            slabs.push_back({z0, z1});
                            CHECK(slab.size() == static_cast<std::size_t>(z1 - z0) << 20);
                            std::size_t i = 0;
                            for (int z = z0; z < z1; ++z)
                              for (int y = 0; y < 1024; ++y)
                                for (int x = 0; x < 1024; ++x)
                                  slab[i++] = std::byte{value(x, y, z)};
                          },
                          {.advance =
                               [&](const std::string& stage, double done) {
                                 CHECK(stage == "upload");
                                 progress.push_back(done);
                               },
                           .warn = {}});
  REQUIRE(slabs.size() == 2);
  CHECK(slabs[0] == std::array<int, 2>{0, 16});
  CHECK(slabs[1] == std::array<int, 2>{16, 18});
  CHECK(progress == std::vector<double>{16.0 / 18.0, 1.0});

  const gl::Target target = gl::make_target(gl, 64, 18, GL_RGBA32F);
  gl::bind_target(gl, target);
  const gl::Program program = fullscreen_program(
      gl, "uniform sampler3D volume;\nvoid main() {\n  ivec2 p = ivec2(gl_FragCoord.xy);\n"
          "  color = texelFetch(volume, ivec3((p.x * 37) % 1024, (p.x * 91) % 1024, p.y), 0);\n}\n");
  gl.BindTexture(GL_TEXTURE_3D, texture.name());
  draw_fullscreen(gl, program);
  const std::vector<float> pixels = gl::read_pixels(gl, target);
  int wrong = 0;
  for (int z = 0; z < 18; ++z)
    for (int x = 0; x < 64; ++x) {
      const float fetched = pixels[4 * static_cast<std::size_t>((17 - z) * 64 + x)] * 255.0f;
      wrong += std::lround(fetched) == value((x * 37) % 1024, (x * 91) % 1024, z) ? 0 : 1;
    }
  CHECK(wrong == 0);
}

TEST_CASE("an exception while filling leaves bindings and pixel store as they were") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const gl::Texture bound = gl::make_texture_3d(gl, {}, {2, 2, 2}, std::span<const std::byte>());
  gl.BindTexture(GL_TEXTURE_3D, bound.name());
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 2);
  CHECK_THROWS_AS(
      gl::make_texture_3d(gl, {}, {2, 2, 2},
                          [](int, int, std::span<std::byte>) { throw FileError("a.raw", "cut off"); }),
      FileError);
  GLint value = 0;
  gl.GetIntegerv(GL_TEXTURE_BINDING_3D, &value);
  CHECK(value == static_cast<GLint>(bound.name()));
  gl.GetIntegerv(GL_UNPACK_ALIGNMENT, &value);
  CHECK(value == 2);
}

TEST_CASE("a texture above the driver's limit is refused with both numbers") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const int limit_3d = context.info().limits.texture_size_3d;
  const int limit = context.info().limits.texture_size;
  const std::string volume = limit_message([&] {
    (void)gl::make_texture_3d(gl, {}, {4, 4, limit_3d + 1}, std::span<const std::byte>());
  });
  CHECK_THAT(volume, Catch::Matchers::Contains(std::to_string(limit_3d)) &&
                         Catch::Matchers::Contains("4 x 4 x " + std::to_string(limit_3d + 1)));
  const std::string table = limit_message([&] { (void)gl::make_texture_1d(gl, {}, limit + 1, {}); });
  CHECK_THAT(table, Catch::Matchers::Contains(std::to_string(limit)) &&
                        Catch::Matchers::Contains(std::to_string(limit + 1) + " texels"));
  const std::string picture = limit_message([&] { (void)gl::make_target(gl, 16, 1 << 30, GL_RGBA8); });
  CHECK_THAT(picture, Catch::Matchers::Contains("16 x 1073741824 pixels"));
  gl::check_errors(gl, "oversize");
}

TEST_CASE("a texture that fits the limits but no memory is refused before anything is allocated") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  if (context.info().limits.texture_size_3d > 2048)
    SLICELENS_SKIP("this driver may have room for 128 GiB");
  // 2048³ texels of 16 bytes are 128 GiB.
  bool filled = false;
  const std::string message = limit_message([&] {
    (void)gl::make_texture_3d(gl, {.format = GL_RGBA32F}, {2048, 2048, 2048},
                              [&](int, int, std::span<std::byte>) { filled = true; });
  });
  CHECK_THAT(message, Catch::Matchers::Contains("131072 MiB"));
  CHECK_FALSE(filled);
  gl::check_errors(gl, "no memory");
}

TEST_CASE("data of the wrong size and sizes below 1 are refused") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const std::vector<std::byte> seven(7);
  CHECK_THROWS_WITH(gl::make_texture_3d(gl, {}, {2, 2, 2}, seven),
                    Catch::Matchers::Contains("8 bytes; 7 were given"));
  CHECK_THROWS_AS(gl::make_texture_2d(gl, {}, {0, 2}, {}), GraphicsError);
  CHECK_THROWS_AS(gl::make_texture_1d(gl, {}, -1, {}), GraphicsError);
  CHECK_THROWS_AS(gl::texel_layout(GL_RGB5_A1), GraphicsError);
}

TEST_CASE("texel layouts have the sizes of their names") {
  CHECK(gl::texel_layout(GL_R8).bytes == 1);
  CHECK(gl::texel_layout(GL_RG16).bytes == 4);
  CHECK(gl::texel_layout(GL_RGB8).bytes == 3);
  CHECK(gl::texel_layout(GL_RGBA16F).bytes == 8);
  CHECK(gl::texel_layout(GL_RGBA32F).bytes == 16);
  CHECK(gl::texel_layout(GL_RGBA8, GL_FLOAT).bytes == 16);
  CHECK(gl::texel_layout(GL_R16UI).format == GL_RED_INTEGER);
}

TEST_CASE("filter, wrap and border are those asked for") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const std::vector<float> values = {1.0f, 3.0f};
  const gl::Texture texture = gl::make_texture_1d(gl,
                                                  {.format = GL_R32F,
                                                   .filter = GL_LINEAR,
                                                   .wrap = GL_CLAMP_TO_BORDER,
                                                   .border = {8.0f, 0.0f, 0.0f, 0.0f}},
                                                  2, std::as_bytes(std::span(values)));
  const gl::Target target = gl::make_target(gl, 4, 1, GL_RGBA32F);
  gl::bind_target(gl, target);
  const gl::Program program =
      fullscreen_program(gl, "uniform sampler1D table;\nvoid main() { color = texture(table, (gl_FragCoord.x "
                             "- 0.5) * 0.5 - 0.25); }\n");
  gl.BindTexture(GL_TEXTURE_1D, texture.name());
  draw_fullscreen(gl, program);
  const std::vector<float> pixels = gl::read_pixels(gl, target);
  // Coordinates -1/4, 1/4, 3/4, 5/4 with texel centres at 1/4 and 3/4: border, first, second, border.
  CHECK(pixels[0] == 8.0f);
  CHECK(pixels[4] == 1.0f);
  CHECK(pixels[8] == 3.0f);
  CHECK(pixels[12] == 8.0f);
}

TEST_CASE("floats become halves on upload when the source type says so") {
  const gl::Context context = test_context();
  const Functions& gl = context.functions();
  const std::vector<float> values = {0.5f, 1.0f + 1.0f / 1024.0f, 2049.0f, -4.0f}; // 2049 is no half: 2048
  const gl::Texture texture =
      gl::make_texture_3d(gl, {.format = GL_R16F, .filter = GL_NEAREST, .source_type = GL_FLOAT}, {4, 1, 1},
                          std::as_bytes(std::span(values)));
  const std::vector<float> texels = fetch_all(gl, texture, {4, 1, 1});
  CHECK(texels[0] == 0.5f);
  CHECK(texels[4] == 1.0f + 1.0f / 1024.0f);
  CHECK(std::abs(texels[8] - 2049.0f) == 1.0f); // both neighbours are equally near
  CHECK(texels[12] == -4.0f);
}
