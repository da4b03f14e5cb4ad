// Classification `pre`: voxels become 8-bit associated colours, which are then interpolated.
#include "catch.h"
#include "render_fixture.h"
#include "volume_fixture.h"

using namespace slicelens;
using Catch::Matchers::Contains;

namespace {

const std::vector<std::string> pipelines = {"slices", "rays", "reference"};

PreparedScene head_scene(const TransferFunction& transfer) {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[64,64,64]},"camera":{"azimuth":33,"elevation":21,"roll":10},
          "render":{"size":[96,96],"classification":"pre","background":[0,0,0,0]}})",
      transfer);
}

/// Bone dense and skin thin; air is transparent.
TransferFunction head_transfer() {
  return {{{-500, 0.4, 0.2, 0.1, 0}, {200, 0.8, 0.6, 0.4, 0.05}, {1200, 1, 1, 0.9, 0.7}}, std::nullopt, ""};
}

/// value · 255 rounded, over 255.
double eight_bits(double value) { return std::round(255 * value) / 255; }

/// A volume of 8×2×8 voxels whose values rise along x, seen from the front as two slices of 64 pixels.
PreparedScene two_slices(const TransferFunction& transfer, const std::string& keys) {
  Volume volume = volume_of(ScalarType::u8, {8, 2, 8}, [](int i, int, int) { return i; });
  return prepare(
      scene_from_json(R"({"camera":{"parallel_scale":4},"render":{"size":[64,64],"background":[0,0,0,0],)" +
                          keys + "}}",
                      "test"),
      std::move(volume), transfer);
}

std::string refusal(const std::string& render, const std::string& rest = "") {
  try {
    scene_from_json(R"({"render":{)" + render + "}" + rest + "}", "test");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST_CASE("a constant box shows the compositing of its 8-bit colour") {
  // Seen from the front a chord of 32 voxels holds n = 32/spacing samples of the texel (C·α', α'), so the
  // opacity is 1 − (1 − α')^n and the colour that share of C·α'/α'. Rounding of α' is part of the method: at
  // spacing ½ the opacity of .11 becomes 14/255 = .0549 for .0566.
  gl::Context context = test_context();
  const glm::dvec4 color(1, 0.5, 0.2, 0.11);
  PreparedScene box = prepare_phantom(
      R"({"volume":{"phantom":"box","size":[32,32,32]},
          "render":{"size":[32,32],"classification":"pre","background":[0,0,0,0]}})",
      constant_transfer(color));
  for (const std::string& pipeline : pipelines) {
    for (const std::string filter : {"nearest", "linear", "linear-exact"}) {
      for (const double spacing : {2.0, 1.0, 0.5}) {
        const Image image = picture(changed(box, {"render.pipeline=" + pipeline, "render.filter=" + filter,
                                                  "render.spacing=" + std::to_string(spacing)}),
                                    context);
        const double corrected = 1 - std::pow(1 - color.a, spacing);
        const double alpha = eight_bits(corrected);
        const double opacity = 1 - std::pow(1 - alpha, 32 / spacing);
        INFO(pipeline << ", " << filter << ", spacing " << spacing);
        // 64 layers blended in float.
        CHECK(channel(image, 16, 16, 3) == Approx(opacity).margin(1e-5));
        for (int c = 0; c < 3; ++c) {
          CHECK(channel(image, 16, 16, c) ==
                Approx(eight_bits(color[c] * corrected) / alpha * opacity).margin(1e-5));
        }
      }
    }
  }
}

TEST_CASE("the line integral of pre-classified opacities") {
  // S = 32·α whatever the spacing: the texel holds α itself, and each sample counts Δ/Δ₀.
  gl::Context context = test_context();
  PreparedScene box = prepare_phantom(
      R"({"volume":{"phantom":"box","size":[32,32,32]},"render":{"size":[32,32],"mode":"xray",
          "xray_scale":0.1,"classification":"pre","background":[0,0,0,0]}})",
      grey(0.11));
  for (const std::string& pipeline : pipelines) {
    for (const std::string spacing : {"2", "1", "0.5"}) {
      INFO(pipeline << " " << spacing);
      const Image image =
          picture(changed(box, {"render.pipeline=" + pipeline, "render.spacing=" + spacing}), context);
      CHECK(channel(image, 16, 16, 0) == Approx(0.1 * 32 * eight_bits(0.11)).margin(1e-5));
    }
  }
}

TEST_CASE("a step is a ramp between two voxels with pre, and stays a step with post") {
  // Voxels 0 to 3 transparent red, 4 to 7 opaque white; their centres are at (i + ½)/8. With pre, opacity and
  // white rise from 0 to 1 between 3.5/8 and 4.5/8, and the red of what is transparent never shows.
  gl::Context context = test_context();
  const TransferFunction step = step_transfer(3.5, {1, 0, 0, 0}, {1, 1, 1, 1});
  for (const std::string& pipeline : pipelines) {
    for (const std::string filter : {"linear", "linear-exact"}) {
      const std::string keys = R"("pipeline":")" + pipeline + R"(","filter":")" + filter + '"';
      const Image pre = picture(two_slices(step, keys + R"(,"classification":"pre")"), context);
      const Image post = picture(two_slices(step, keys), context);
      for (int x = 0; x < 64; ++x) {
        const double along = (x + 0.5) / 64;
        const double ramp = std::clamp(along * 8 - 3.5, 0.0, 1.0);
        const double twice = 1 - (1 - ramp) * (1 - ramp); // two samples, one over the other
        INFO(pipeline << ", " << filter << ", x " << x);
        // The driver's filter weighs an 8-bit texture with 8 bits and may round its result to 8 bits: 1.5/255
        // a sample.
        const double margin = pipeline == "reference" || filter == "linear-exact" ? 1e-5 : 3.0 / 255;
        for (int c = 0; c < 4; ++c)
          CHECK(channel(pre, x, 32, c) == Approx(twice).margin(margin));
        CHECK(channel(post, x, 32, 3) == Approx(along < 0.5 ? 0 : 1).margin(1e-5));
      }
    }
  }
}

TEST_CASE("pre is post where interpolation does not matter") {
  // One colour for every value, exact in 8 bits: .2 = 51/255.
  gl::Context context = test_context();
  const PreparedScene head = head_scene(grey(0.2));
  for (const std::string pipeline : {"slices", "rays"}) {
    INFO(pipeline);
    const PreparedScene pre = changed(head, {"render.pipeline=" + pipeline});
    const Image a = picture(pre, context);
    const Image b = picture(changed(pre, {"render.classification=post"}), context);
    CHECK(max_difference(a, b) <= 1e-5);
  }
  // And at voxel centres, whatever the transfer function: nearest, within the rounding to 8 bits.
  const TransferFunction ramp = {{{0, 1, 0, 0, 0}, {7, 0, 1, 1, 1}}, std::nullopt, ""};
  const Image pre = picture(two_slices(ramp, R"("filter":"nearest","classification":"pre")"), context);
  const Image post = picture(two_slices(ramp, R"("filter":"nearest")"), context);
  CHECK(max_difference(pre, post) <= 1.0 / 255 + 1e-5); // two samples
  CHECK(max_difference(pre, post) > 1e-4);
}

TEST_CASE("every type of voxel is classified the same") {
  gl::Context context = test_context();
  const TransferFunction ramp = {{{-3, 1, 0.2, 0, 0}, {4, 0, 1, 0.5, 0.9}}, std::nullopt, ""};
  std::optional<Image> first;
  for (const ScalarType type :
       {ScalarType::i8, ScalarType::i16, ScalarType::i32, ScalarType::f32, ScalarType::f64}) {
    Volume volume = volume_of(type, {8, 8, 8}, [](int i, int j, int k) { return i - 4 + (j + k) % 2; });
    PreparedScene scene = prepare(
        scene_from_json(R"({"render":{"size":[32,32],"classification":"pre","background":[0,0,0,0]}})", "t"),
        std::move(volume), ramp);
    const Image image = picture(scene, context);
    if (!first)
      first = image;
    INFO(name_of(type));
    CHECK(image.pixels == first->pixels);
  }
  CHECK(channel(*first, 16, 16, 3) > 0.5F);
}

TEST_CASE("voxels that are no numbers count as the smallest") {
  gl::Context context = test_context();
  const auto value = [](int i, int, int) { return i < 4 ? std::nan("") : 1.0 * i; };
  for (const std::string pipeline : {"slices", "reference"}) {
    PreparedScene scene =
        prepare(scene_from_json(
                    R"({"render":{"size":[32,32],"classification":"pre","filter":"nearest","pipeline":")" +
                        pipeline + R"(","background":[0,0,0,0]}})",
                    "t"),
                volume_of(ScalarType::f32, {8, 1, 8}, value), step_transfer(4.5, {0, 0, 1, 1}, {1, 0, 0, 1}));
    const Image image = picture(scene, context);
    INFO(pipeline);
    CHECK(channel(image, 12, 16, 2) == Approx(1)); // voxels 0 to 3 are shown as value 4: blue
    CHECK(channel(image, 20, 16, 0) == Approx(1));
  }
}

TEST_CASE("the GPU is the reference with pre classification") {
  // Bars: 60 dB with float weights and a float target, as for `post`; 45 dB with the driver's filter and 8
  // bits, which round every sample and every blending step.
  gl::Context context = test_context();
  const PreparedScene head = head_scene(head_transfer());
  const std::string planes = R"(clip=[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2]}])";
  const std::string lens =
      R"(warp={"kind":"lamar","zoom":2,"center":[0.5,0.4,0.5],"inner":0.15,"outer":0.25})";
  for (const std::string& extra : {std::string("title=plain"), planes, lens}) {
    const Image truth =
        picture(changed(head, {"render.pipeline=reference", "render.filter=linear-exact", extra}), context);
    const std::string slices = extra == lens ? "fragment" : "slices";
    for (const std::string& pipeline : {slices, std::string("rays")}) {
      const double exact =
          psnr(picture(changed(head, {"render.pipeline=" + pipeline, "render.filter=linear-exact", extra}),
                       context),
               truth);
      const double bits =
          psnr(picture(changed(head, {"render.pipeline=" + pipeline, "render.target=rgba8", extra}), context),
               truth);
      INFO(extra << ", " << pipeline << ": exact " << exact << ", 8 bits " << bits);
      CHECK(exact >= 60);
      CHECK(bits >= 45);
    }
  }
}

TEST_CASE("pre differs from post on the head as theory says") {
  // Steep transfer functions are blurred; where the opacity is linear in the value little changes.
  gl::Context context = test_context();
  const auto difference = [&](const TransferFunction& transfer) {
    const PreparedScene pre = changed(head_scene(transfer), {"render.filter=linear-exact"});
    return psnr(picture(pre, context), picture(changed(pre, {"render.classification=post"}), context));
  };
  const double steep = difference(step_transfer(500, {1, 1, 1, 0}, {1, 1, 1, 1}));
  const double gentle = difference({{{-1000, 1, 1, 1, 0}, {2300, 1, 1, 1, 1}}, std::nullopt, ""});
  INFO("steep " << steep << ", gentle " << gentle);
  CHECK(steep < 30);
  CHECK(gentle > 50);
}

TEST_CASE("what pre classification cannot hold is refused by name") {
  const std::string pre = R"("classification":"pre",)";
  CHECK_THAT(refusal(pre + R"("mode":"mip")"), Contains("classification 'pre'") && Contains("'mip'"));
  CHECK_THAT(refusal(pre + R"("shading":"diffuse")"), Contains("render.shading"));
  CHECK_THAT(refusal(pre + R"("volume_texture":"r16")"), Contains("render.volume_texture"));
  CHECK_THAT(refusal(pre + R"("transfer_texture":"rgba8")"), Contains("render.transfer_texture"));
  CHECK_THAT(refusal(R"("classification":"pree")"), Contains("render.classification") && Contains("pre"));
  const std::string perspective = R"(,"camera":{"projection":"perspective"})";
  CHECK_THAT(refusal(pre + R"("spacing":1)", perspective),
             Contains("render.opacity_correction") && Contains("camera.projection") && Contains("frame"));
  CHECK(refusal(pre + R"("opacity_correction":"frame")", perspective) == "accepted");
  CHECK(refusal(pre + R"("pipeline":"rays")", perspective) == "accepted"); // rays have one distance
  CHECK(refusal(pre + R"("mode":"xray")") == "accepted");
}
