// LaMar's lens in pictures: the same lens by every pipeline (issue: a difference between them is a finding).
#include "catch.h"
#include "core/errors.h"
#include "render_fixture.h"
#include "scene/load.h"

using namespace slicelens;

namespace {

const std::string lens =
    R"({"kind":"lamar","shape":"circle","border":"cubic","zoom":2.5,"center":[0.45,0.35,0.55],"inner":0.12,"outer":0.24})";

PreparedScene head_under(const std::string& warp, const std::string& render,
                         const std::string& camera = R"("azimuth":30,"elevation":15)",
                         const std::string& clip = "[]") {
  return prepare_phantom(R"({"volume":{"phantom":"head","size":[64,64,64]},"camera":{)" + camera +
                             R"(},"render":{"size":[64,64],"target":"rgba32f",
      "filter":"linear-exact","background":[0,0,0,0],)" +
                             render + R"(},"clip":)" + clip + R"(,"warp":)" + warp + "}",
                         rising(-200, 1500, 0.6));
}

double psnr_between(const PreparedScene& scene, const std::string& a, const std::string& b,
                    gl::Context& context) {
  return psnr(picture(changed(scene, {"render.pipeline=" + a}), context),
              picture(changed(scene, {"render.pipeline=" + b}), context));
}

} // namespace

TEST_CASE("a lens evaluated at each fragment, along rays and by the reference gives one picture") {
  gl::Context context = test_context();
  // 60 dB: single precision of positions and weights, some 1e-6 each, summed over a hundred samples.
  for (const std::string shape : {"circle", "square"}) {
    for (const std::string border : {"simple", "linear", "cubic"}) {
      const PreparedScene scene = changed(head_under(lens, R"("pipeline":"fragment")"),
                                          {"warp.shape=" + shape, "warp.border=" + border});
      INFO(shape << " " << border);
      CHECK(psnr_between(scene, "fragment", "reference", context) >= 60);
      CHECK(psnr_between(scene, "fragment", "rays", context) >= 60);
    }
  }
}

TEST_CASE("the lens agrees between pipelines shaded, in perspective, cut and in every mode") {
  gl::Context context = test_context();
  const std::string fragment = R"("pipeline":"fragment")";
  const std::string cut =
      R"([{"point":[0.5,0.5,0.5],"normal":[1,0.3,0]},{"point":[0.5,0.5,0.6],"normal":[0,0,-1],"space":"object"}])";
  const std::vector<PreparedScene> scenes = {
      head_under(lens, fragment + R"(,"shading":"diffuse")"),
      head_under(lens, fragment, R"("azimuth":30,"elevation":15)", cut),
      head_under(lens, fragment + R"(,"mode":"mip")"),
      head_under(lens, fragment + R"(,"mode":"xray")"),
      head_under("[" + lens +
                     R"(,{"kind":"lamar","zoom":2,"center":[0.5,0.5,0.1],"inner":0.05,"outer":0.1}])",
                 fragment),
  };
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    INFO("scene " << i);
    CHECK(psnr_between(scenes[i], "fragment", "reference", context) >= 60);
    CHECK(psnr_between(scenes[i], "rays", "reference", context) >= 60);
  }
  // Under perspective slices sample on planes and rays on spheres; at a quarter of a voxel both are near the
  // limit.
  const PreparedScene perspective = head_under(lens, fragment + R"(,"spacing":0.25)",
                                               R"("azimuth":30,"projection":"perspective","view_angle":40)");
  CHECK(psnr_between(perspective, "rays", "reference", context) >= 60);
  CHECK(psnr_between(perspective, "fragment", "reference", context) >= 45);
}

TEST_CASE("many segments come as near to the exact lens as the bar asks") {
  gl::Context context = test_context();
  const std::vector<std::string> fine = {"warp.radial_segments=64", "warp.angular_segments=128"};
  for (const std::string& render : {std::string(R"("pipeline":"tessellated")"),
                                    std::string(R"("pipeline":"tessellated","shading":"diffuse")")}) {
    const PreparedScene scene = changed(head_under(lens, render), fine);
    CHECK(psnr_between(scene, "tessellated", "fragment", context) >= 45);
  }
  const PreparedScene perspective = changed(
      head_under(lens, R"("pipeline":"tessellated")", R"("projection":"perspective","view_angle":50)"), fine);
  CHECK(psnr_between(perspective, "tessellated", "fragment", context) >= 45);
}

TEST_CASE("tessellation converges to the exact lens at second order in the radial segments", "[one-driver]") {
  gl::Context context = test_context();
  // A square has no angular error. A smooth volume, so that picture errors follow the texture radius' error.
  const std::string scene_text =
      R"({"volume":{"phantom":"blob","size":[64,64,64]},"camera":{"azimuth":20},"render":{"pipeline":"tessellated","mode":"xray",
      "xray_scale":0.02,"size":[96,96],"filter":"linear-exact","background":[0,0,0,0]},
      "warp":{"kind":"lamar","shape":"square","border":"linear","zoom":3,"center":[0.5,0.5,0.5],"inner":0.2,"outer":0.4,"depth_inner":0.8,"depth_outer":0.9}})";
  const PreparedScene scene =
      prepare_phantom(scene_text, {{{0, 0, 0, 0, 0}, {1, 1, 1, 1, 1}}, std::nullopt, ""});
  const Image exact = picture(changed(scene, {"render.pipeline=fragment"}), context);
  std::vector<double> errors;
  for (const int n : {8, 16, 32}) {
    const Image image = picture(changed(scene, {"warp.radial_segments=" + std::to_string(n)}), context);
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      const double d = static_cast<double>(image.pixels[i]) - static_cast<double>(exact.pixels[i]);
      sum += d * d;
    }
    errors.push_back(std::sqrt(sum));
  }
  const double order = std::log2(errors[0] / errors[2]) / 2;
  INFO(errors[0] << " " << errors[1] << " " << errors[2] << ": order " << order);
  CHECK(order > 1.6); // asymptotically 2: docs/papers/lamar.md gives 1.85 for the linear border at n = 32
  CHECK(order < 2.3);
}

TEST_CASE("a lens of zoom 1 changes nothing, without a special case") {
  gl::Context context = test_context();
  for (const std::string pipeline : {"tessellated", "fragment", "rays", "reference"}) {
    for (const std::string border : {"simple", "linear", "cubic"}) {
      const PreparedScene scene =
          changed(head_under(lens, R"("pipeline":"tessellated")"),
                  {"warp.zoom=1", "warp.border=" + border, "render.pipeline=" + pipeline});
      const std::string plain = pipeline == "rays" || pipeline == "reference" ? pipeline : "slices";
      const Image without = picture(changed(scene, {"warp=[]", "render.pipeline=" + plain}), context);
      INFO(pipeline << " " << border);
      CHECK(share_over(picture(scene, context), without, 1e-3) <= 1e-3);
    }
  }
}

TEST_CASE("the zoom region shows the data Q times as large") {
  gl::Context context = test_context();
  // Seen along y, the disc of radius r_i about the centre shows what a camera of Q times the zoom shows
  // there, when the whole depth is in the zoom region.
  const PreparedScene lensed = prepare_phantom(
      R"({"volume":{"phantom":"marschner-lobb","size":[48,48,48]},"render":{"pipeline":"fragment","mode":"xray","xray_scale":0.05,"size":[97,97],
         "filter":"linear-exact","background":[0,0,0,0]},"warp":{"kind":"lamar","zoom":2,"inner":0.2,"outer":0.4,"depth_inner":5,"depth_outer":6}})",
      {{{0, 0, 0, 0, 0}, {1, 1, 1, 1, 1}}, std::nullopt, ""});
  const PreparedScene closer = changed(lensed, {"warp=[]", "render.pipeline=slices", "camera.zoom=2"});
  const Image a = picture(lensed, context);
  const Image b = picture(closer, context);
  const double radius =
      0.19 * lensed.space.longest * 97 / (2 * lensed.view.half_height); // pixels, a little inside
  double largest = 0;
  int count = 0;
  for (int y = 0; y < 97; ++y) {
    for (int x = 0; x < 97; ++x) {
      if (std::hypot(x - 48, y - 48) > radius)
        continue;
      largest = std::max(largest, std::abs(static_cast<double>(channel(a, x, y, 0)) -
                                           static_cast<double>(channel(b, x, y, 0))));
      ++count;
    }
  }
  CHECK(count > 100);
  CHECK(largest < 1e-4); // float positions
}

TEST_CASE("lenses that cannot be drawn are refused by name") {
  const auto refusal = [](const std::string& text) {
    try {
      prepare_phantom(text, grey(0.1));
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const std::string volume = R"({"volume":{"phantom":"box","size":[8,8,8]},)";
  CHECK(contains(refusal(volume + R"("render":{"pipeline":"slices"},"warp":)" + lens + "}"), "slices"));
  CHECK(contains(refusal(volume + R"("warp":[)" + lens + "," + lens + "]}"), "overlap"));
  CHECK(contains(refusal(volume + R"("warp":{"kind":"lamar","center":[9,9,9]}})"), "center"));
  CHECK(contains(refusal(volume + R"("warp":{"kind":"lamar","inner":0.3,"outer":0.2}})"), "inner"));
  CHECK(
      contains(refusal(volume + R"("warp":{"kind":"lamar","radial_segments":1000000}})"), "radial_segments"));
  CHECK(contains(refusal(volume + R"("warp":{"kind":"lamar","angular_segments":0}})"), "angular_segments"));
  CHECK(contains(refusal(volume + R"("warp":{"kind":"lens"}})"), "lamar"));
  CHECK(contains(refusal(volume + R"("warp":{"kind":"lamar","zoomm":2}})"), "zoom"));
}

TEST_CASE("on a real CT many segments meet the bar and fragments meet the reference", "[one-driver]") {
  const auto folder = real_volumes();
  if (folder.empty())
    SLICELENS_SKIP("no real volumes beside the checkout");
  gl::Context context = test_context();
  Scene scene = scene_from_json(
      R"({"render":{"size":[128,128],"target":"rgba32f","filter":"linear-exact","background":[0,0,0,0]},
      "camera":{"azimuth":30},"warp":{"kind":"lamar","zoom":3,"center":[0.5,0.3,0.5],"inner":0.1,"outer":0.2,"radial_segments":64,"angular_segments":128}})",
      "test", {{"volume.file", (folder / "ct_chest_large" / "series").string()}});
  Volume volume = load_volume(scene.volume, {"."}, {});
  const PreparedScene prepared = prepare(scene, std::move(volume), rising(-200, 800, 0.6));
  CHECK(psnr_between(prepared, "tessellated", "fragment", context) >= 45);
  CHECK(psnr_between(prepared, "fragment", "reference", context) >= 60);
}
