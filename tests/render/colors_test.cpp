// Volumes of colours: RGB with the opacity of their luminance, RGBA with their own.
#include "catch.h"
#include "core/errors.h"
#include "render/bake.h"
#include "render/probe.h"
#include "render_fixture.h"
#include "volume/volume.h"

#include <array>
#include <cstring>

using namespace slicelens;
using Catch::Matchers::Contains;

namespace {

using Colors = std::vector<double>;

/// A volume of 8×4×8 voxels of colours f(i, j, k), spacing 1.
template <class T, class Function>
Volume color_volume(int components, const Function& f) {
  Volume volume;
  volume.dims = {8, 4, 8};
  volume.type = sizeof(T) == 1 ? ScalarType::u8 : ScalarType::u16;
  volume.components = components;
  std::vector<T> values;
  for (int k = 0; k < 8; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 8; ++i) {
        const Colors color = f(i, j, k);
        for (int c = 0; c < components; ++c)
          values.push_back(static_cast<T>(color[static_cast<std::size_t>(c)]));
      }
    }
  }
  volume.voxels.resize(values.size() * sizeof(T));
  std::memcpy(volume.voxels.data(), values.data(), volume.voxels.size());
  update_statistics(volume);
  return volume;
}

/// Seen from the front as four slices of 8 × 8 units on 64 × 64 pixels.
PreparedScene four_slices(const Volume& colors, const std::string& render, TransferFunction transfer,
                          const std::string& rest = "") {
  return prepare(
      scene_from_json(R"({"camera":{"parallel_scale":4},"render":{"size":[64,64],"background":[0,0,0,0])" +
                          render + "}" + rest + "}",
                      "test"),
      with_luminance(colors), std::move(transfer));
}

double eight_bits(double value) { return std::round(255 * value) / 255; }

/// What four slices of one associated colour of 8 bits show.
glm::dvec4 composited(const glm::dvec3& color, double alpha) {
  const double a = eight_bits(alpha);
  const double through = 1 - std::pow(1 - a, 4);
  glm::dvec4 result(0, 0, 0, through);
  for (int c = 0; c < 3; ++c)
    result[c] = eight_bits(color[c] * alpha) / a * through;
  return result;
}

void check_pixel(const Image& image, int x, int y, const glm::dvec4& expected, double tolerance) {
  for (int c = 0; c < 4; ++c)
    CHECK(std::abs(channel(image, x, y, c) - expected[c]) <= tolerance);
}

const std::vector<std::string> pipelines = {"slices", "tessellated", "fragment", "rays", "reference"};

} // namespace

TEST_CASE("RGBA voxels are shown in their own colours and opacities, whatever the transfer function") {
  // Left of the middle orange at .2, right of it blue at .6: (50, 153)/255 a voxel.
  const Volume colors = color_volume<std::uint8_t>(4, [](int i, int, int) {
    return i < 4 ? Colors{255, 153, 51, 51} : Colors{0, 51, 255, 153};
  });
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    const std::string warp = pipeline == "tessellated" ? R"(,"warp":{"kind":"shift","offset":[0,0,0]})" : "";
    const PreparedScene scene = four_slices(colors, R"(,"pipeline":")" + pipeline + "\"", grey(1), warp);
    const Image image = picture(scene, context);
    INFO(pipeline);
    // A driver's own filter of 8-bit textures may give 8 bits; four slices of it.
    const double tolerance = pipeline == "reference" ? 1e-6 : 4 * 0.5 / 255;
    check_pixel(image, 12, 30, composited({1, 0.6, 0.2}, 0.2), tolerance);
    check_pixel(image, 52, 30, composited({0, 0.2, 1}, 0.6), tolerance);
  }
}

TEST_CASE("RGB voxels take their opacity from their luminance by the transfer function") {
  // Luminances .2126·255 = 54, .7152·255 = 182 and .0722·255 = 18: a step at 100 shows green only, a ramp
  // from 0 to 255 each by its share.
  const Volume colors = color_volume<std::uint8_t>(3, [](int i, int, int) {
    return i < 3 ? Colors{255, 0, 0} : i < 6 ? Colors{0, 255, 0} : Colors{0, 0, 255};
  });
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    const std::string warp = pipeline == "tessellated" ? R"(,"warp":{"kind":"shift","offset":[0,0,0]})" : "";
    const std::string keys = R"(,"pipeline":")" + pipeline + "\"";
    INFO(pipeline);
    const double tolerance = pipeline == "reference" ? 1e-6 : 4 * 0.5 / 255;
    const Image step =
        picture(four_slices(colors, keys, step_transfer(100, {1, 1, 1, 0}, {1, 1, 1, 0.5}), warp), context);
    check_pixel(step, 10, 30, glm::dvec4(0), tolerance);
    check_pixel(step, 36, 30, composited({0, 1, 0}, 0.5), tolerance);
    check_pixel(step, 60, 30, glm::dvec4(0), tolerance);
    const Image ramp = picture(four_slices(colors, keys, rising(0, 255, 1), warp), context);
    check_pixel(ramp, 10, 30, composited({1, 0, 0}, 54 / 255.0), tolerance);
    check_pixel(ramp, 36, 30, composited({0, 1, 0}, 182 / 255.0), tolerance);
    check_pixel(ramp, 60, 30, composited({0, 0, 1}, 18 / 255.0), tolerance);
  }
}

TEST_CASE("opacities of colours are corrected for the distance of slices") {
  const Volume colors = color_volume<std::uint8_t>(4, [](int, int, int) {
    return Colors{255, 255, 255, 102};
  });
  const PreparedScene scene = four_slices(colors, R"(,"pipeline":"reference","spacing":0.5)", grey(1));
  gl::Context context = test_context();
  // Eight slices, 1 − (1 − .4)^½ = .2254 each in 8 bits (57/255).
  const double a = eight_bits(1 - std::sqrt(0.6));
  CHECK(channel(picture(scene, context), 32, 32, 3) == Approx(1 - std::pow(1 - a, 8)).margin(1e-6));
}

TEST_CASE("16-bit colours are scaled to 8, and their luminance stays in the data's units") {
  const Volume colors = color_volume<std::uint16_t>(4, [](int, int, int) {
    return Colors{65535, 32896, 257, 13107};
  });
  const Volume shown = with_luminance(colors);
  CHECK(shown.components == 1);
  CHECK(shown.type == ScalarType::u16);
  CHECK(shown.colors.has_opacity);
  const std::vector<std::uint8_t> first(shown.colors.rgba.begin(), shown.colors.rgba.begin() + 4);
  CHECK(first == std::vector<std::uint8_t>{255, 128, 1, 51});
  CHECK(shown.min == std::round(0.2126 * 65535 + 0.7152 * 32896 + 0.0722 * 257));
}

TEST_CASE("what a volume of colours cannot be is refused by name") {
  const Volume colors = color_volume<std::uint8_t>(3, [](int, int, int) { return Colors{9, 9, 9}; });
  const auto refusal = [&](const std::string& render, const std::string& rest = "") -> std::string {
    try {
      (void)four_slices(colors, render, grey(1), rest);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(refusal(R"(,"mode":"mip")"), Contains("volume of colours") && Contains("'mip'"));
  CHECK_THAT(refusal(R"(,"shading":"diffuse")"),
             Contains("render.shading 'diffuse' needs a gradient") && Contains("volume.component"));
  CHECK_THAT(refusal(R"(,"footprint":"mip")"), Contains("volume of colours") && Contains("render.footprint"));
  CHECK_THAT(refusal("", R"(,"overlay":{"legend":true})"), Contains("overlay.legend"));
  CHECK_THAT(refusal("", R"(,"planes":[{"normal":[0,1,0]}])"), Contains("planes"));
  CHECK(refusal("").empty());
  gl::Context context = test_context();
  CHECK_THROWS_AS(sample_line(four_slices(colors, "", grey(1)), context, {}, 64), UsageError);
  CHECK_THROWS_AS(bake(four_slices(colors, "", grey(1)), {}, {}), UsageError);
  std::vector<LoadedVolume> others(1);
  others[0].volume = with_luminance(colors);
  others[0].transfer = grey(1);
  CHECK_THROWS_WITH(prepare(scene_from_json(R"({"volumes":[{"phantom":"ball"},{"phantom":"ball"}]})", "s"),
                            make_phantom("ball", {8, 8, 8}), grey(1), std::move(others)),
                    Contains("several volumes") && Contains("volume.component"));
}

TEST_CASE("vectors that are no colours are refused") {
  Volume vectors = color_volume<std::uint8_t>(3, [](int, int, int) { return Colors{9, 9, 9}; });
  CHECK(holds_colors(vectors));
  vectors.type = ScalarType::i8;
  CHECK_FALSE(holds_colors(vectors));
  CHECK_THROWS_AS(with_luminance(vectors), UsageError);
  vectors.type = ScalarType::u8;
  vectors.components = 2;
  CHECK_FALSE(holds_colors(vectors));
}
