// Classification `preintegrated` (Engel, Kraus and Ertl 2001): segments instead of points.
//
// Bars. Orthographic slices, shells and rays read the same segments: 60 dB leaves room for a segment at a
// face of the box that one of them draws and the other does not. The reference integrates the transfer
// function itself; the table's texels are 1/511 of the data's range apart, and 55 dB is what that leaves
// under functions that are not thinner.
#include "catch.h"
#include "render/segment_integral.h"
#include "render_fixture.h"
#include "volume/segment_table.h"

#include <random>

using namespace slicelens;
using Catch::Matchers::Contains;

namespace {

namespace in_double {
using namespace glm;
using real = double;
#include "lib/opacity.glsl"
#include "lib/segment.glsl"
} // namespace in_double

const std::string highlighted =
    R"(highlight={"function":"focus","color":[0,0,1],"focus":[[0.2,0.8],[0.2,0.8],[0.2,0.6]]})";
const std::string attenuated =
    R"(attenuation={"function":"distance","focus":[[0.4,0.6],[0.4,0.6],[0.4,0.6]]})";

PreparedScene head_scene() {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[48,48,48]},"camera":{"azimuth":33,"elevation":21,"roll":10},
          "render":{"size":[64,64],"filter":"linear-exact","background":[0,0,0,0],"spacing":1.5,
                    "classification":"preintegrated"}})",
      {{{-500, 0.4, 0.2, 0.1, 0}, {200, 0.8, 0.6, 0.4, 0.05}, {1200, 1, 1, 0.9, 0.7}}, std::nullopt, ""});
}

/// rays against the reference, and `pipeline` against rays.
void check_pipelines(const PreparedScene& scene, const std::string& pipeline, std::vector<std::string> keys) {
  gl::Context context = test_context();
  const std::string proxy = scene.view.projection == Projection::perspective ? "shells" : "planes";
  const auto drawn = [&](const std::string& by, const std::string& as) {
    std::vector<std::string> all = keys;
    all.insert(all.end(), {"render.pipeline=" + by, "render.proxy=" + as});
    return picture(changed(scene, all), context);
  };
  const Image slices = drawn(pipeline, proxy);
  std::erase(keys, "render.order=front-to-back"); // of slices only
  const Image truth = drawn("reference", "planes");
  const Image rays = drawn("rays", "planes");
  INFO(pipeline << ": rays against the reference " << psnr(rays, truth) << " dB, slices against rays "
                << psnr(slices, rays));
  CHECK(psnr(rays, truth) >= 55);
  CHECK(psnr(slices, rays) >= 60);
  CHECK(share_over(rays, make_image(rays.width, rays.height), 0.05) > 0.05);
}

PreparedScene perspective(const PreparedScene& scene) {
  return changed(scene, {"camera.projection=perspective", "camera.view_angle=50"});
}

std::string refusal(const std::string& render, const std::string& rest = "") {
  try {
    scene_from_json(R"({"render":{"classification":"preintegrated",)" + render + "}" + rest + "}", "test");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST_CASE("the table of segments is the integral at its texels") {
  // Two independent integrations: closed form and runs of cells, against midpoints in many steps.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 20; ++round) {
    TransferFunction transfer;
    double value = 0.1 * unit(random);
    for (int i = 0; i < 5; ++i) {
      transfer.points.push_back({value, unit(random), unit(random), unit(random), 0.98 * unit(random)});
      value += unit(random) < 0.2 ? 0 : 0.25 * unit(random);
      if (i > 0 && transfer.points[transfer.points.size() - 2].value == value)
        value += 0.01; // at most two equal knots
    }
    const double ratio = 0.1 + 4 * unit(random);
    const SegmentTable table = make_segment_table(transfer, 0, 1, ratio, 65);
    for (int i = 0; i < 20; ++i) {
      const double front = std::floor(65 * unit(random)) / 64;
      const double back = std::floor(65 * unit(random)) / 64;
      const glm::dvec4 exact = segment_integral(transfer, front, back, ratio, 200);
      const glm::dvec4 found = evaluate(table, front, back);
      INFO(front << " " << back << " ratio " << ratio);
      CHECK(found.a == Approx(exact.a).margin(2e-5)); // midpoints
      for (int c = 0; c < 3; ++c)
        CHECK(found[c] == Approx(exact[c]).margin(2e-3)); // colours mix within an eighth of 1/64
    }
  }
}

TEST_CASE("a segment's opacity after attenuation") {
  for (const double ratio : {0.05, 0.5, 1.0, 3.0}) {
    for (const double alpha : {0.0, 1e-4, 0.3, 0.9, 0.999}) {
      for (const double attenuation : {0.0, 0.2, 0.9, 1.0}) {
        const double reference = 1 - std::pow(1 - alpha, 1 / ratio);
        // Unattenuated, 1 − α₀ must not be lost beside 1.
        const double expected = attenuation == 1 ? 1 - std::pow(1 - alpha, 1.3)
                                                 : 1 - std::pow(1 - attenuation * reference, 1.3 * ratio);
        CHECK(in_double::segment_opacity(alpha, attenuation, ratio, 1.3) == Approx(expected).margin(1e-9));
      }
    }
  }
}

TEST_CASE("segments of one value are samples: post and preintegrated are one picture") {
  // A constant box: every segment is a sample's corrected opacity, through highlight, attenuation, and the
  // longer segments of perspective planes. At the faces both take the same samples.
  gl::Context context = test_context();
  const PreparedScene box = prepare_phantom(
      R"({"volume":{"phantom":"box","size":[24,24,24]},"camera":{"azimuth":20,"elevation":15,"view_angle":70},
          "render":{"size":[48,48],"background":[0,0,0,0],"spacing":0.7,"pipeline":"fragment"}})",
      constant_transfer({1, 0.5, 0.2, 0.1}));
  for (const std::string projection : {"orthographic", "perspective"}) {
    for (const std::string pipeline : {"fragment", "rays", "reference", "axis"}) {
      for (const std::string correction : {"fragment", "frame", "none"}) {
        std::vector<std::string> keys = {"camera.projection=" + projection, "render.pipeline=" + pipeline,
                                         "render.opacity_correction=" + correction, highlighted, attenuated};
        const Image post = picture(changed(box, keys), context);
        keys.emplace_back("render.classification=preintegrated");
        const Image segments = picture(changed(box, keys), context);
        INFO(projection << " " << pipeline << " " << correction);
        CHECK(max_difference(post, segments) < 2e-5);
        CHECK(share_over(post, make_image(48, 48), 0.05) > 0.05);
      }
    }
  }
}

TEST_CASE("a thin peak on a ramp is seen at any spacing") {
  // Along a ray the ramp rises linearly, so the opacity of the peak has a closed form: 1 − exp(−∫τ
  // dv/(dv/ds)).
  gl::Context context = test_context();
  constexpr double half = 0.006; // of the range; a voxel is 1/48
  constexpr double top = 0.9;
  const TransferFunction peak{
      {{0.5 - half, 1, 1, 1, 0}, {0.5, 1, 1, 1, top}, {0.5 + half, 1, 1, 1, 0}}, std::nullopt, ""};
  const PreparedScene ramp = prepare_phantom(
      R"({"volume":{"phantom":"ramp","size":[48,48,48]},"camera":{"azimuth":70,"elevation":15,"zoom":4},
          "render":{"size":[32,32],"filter":"linear-exact","background":[0,0,0,0]}})",
      peak);
  const double depth = 2 * half * (top + (1 - top) * std::log(1 - top)) / top; // ∫τ dv
  const auto error = [&](const PreparedScene& scene) {
    const Image image = picture(scene, context);
    return mean_error(image, 3, [&](int x, int y) {
      const glm::dvec3 direction =
          glm::dmat3(texture_from_world(scene.box)) * pixel_ray(scene, x, y).direction;
      return 1 - std::exp(-depth / std::abs(direction.x));
    });
  };
  for (const std::string projection : {"orthographic", "perspective"}) {
    for (const std::string pipeline : {"slices", "rays"}) {
      for (const std::string spacing : {"2", "1", "0.5", "0.25"}) {
        const PreparedScene scene =
            changed(ramp, {"camera.projection=" + projection, "render.pipeline=" + pipeline,
                           "render.spacing=" + spacing});
        const double post = error(scene);
        const double segments = error(changed(scene, {"render.classification=preintegrated"}));
        INFO(projection << " " << pipeline << " " << spacing << ": post " << post << ", segments "
                        << segments);
        CHECK(segments < 0.004);
        CHECK(segments < post / 5);
      }
    }
  }
}

TEST_CASE("segments by slices, rays and the reference: plain and lit") {
  check_pipelines(head_scene(), "slices", {});
  check_pipelines(perspective(head_scene()), "slices", {});
  check_pipelines(head_scene(), "slices", {"render.shading=diffuse"});
  check_pipelines(perspective(head_scene()), "slices", {"render.shading=phong"});
  check_pipelines(head_scene(), "slices", {"render.order=front-to-back", "render.opacity_correction=none"});
}

TEST_CASE("segments by slices, rays and the reference: warps and effects") {
  const std::string twist = R"(warp={"kind":"twist","angle":60})";
  const std::string clip = R"(clip=[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2]}])";
  check_pipelines(head_scene(), "fragment", {twist});
  check_pipelines(perspective(head_scene()), "fragment", {twist, clip, "render.shading=diffuse"});
  check_pipelines(head_scene(), "fragment", {highlighted, attenuated});
  check_pipelines(perspective(head_scene()), "fragment", {highlighted, attenuated});
}

TEST_CASE("segments by Cohen's tables and by the grid are those of the exact map") {
  gl::Context context = test_context();
  const PreparedScene fisheye =
      changed(head_scene(), {R"(warp={"kind":"fisheye","center":[0.4,0.5,0.5],"distortion":2})",
                             "render.pipeline=fragment"});
  const Image exact = picture(changed(fisheye, {"render.pipeline=fragment"}), context);
  for (const std::string pipeline : {"axis", "grid"}) {
    const Image drawn = picture(changed(fisheye, {"render.pipeline=" + pipeline}), context);
    INFO(pipeline << " " << psnr(drawn, exact));
    CHECK(psnr(drawn, exact) >= 45); // tables; the same maps by post are as far apart
  }
}

TEST_CASE("segments of perspective planes approach those of rays") {
  gl::Context context = test_context();
  const PreparedScene head = perspective(head_scene());
  double last = 0;
  for (const std::string spacing : {"1", "0.25"}) {
    const std::string key = "render.spacing=" + spacing;
    const double found = psnr(picture(changed(head, {key, "render.pipeline=slices"}), context),
                              picture(changed(head, {key, "render.pipeline=rays"}), context));
    INFO(spacing << " " << found);
    CHECK(found > last + 10);
    last = found;
  }
  CHECK(last >= 60);
}

TEST_CASE("what pre-integration cannot do is refused by name") {
  CHECK(refusal(R"("pipeline":"rays")") == "accepted");
  CHECK_THAT(refusal(R"("mode":"mip")"), Contains("mode 'mip'"));
  CHECK_THAT(refusal(R"("mode":"xray")"), Contains("mode 'xray'"));
  CHECK_THAT(refusal(R"("pipeline":"tessellated")"), Contains("pipeline 'tessellated'"));
  CHECK_THAT(refusal(R"("pipeline":"fixed-function")"), Contains("render.classification"));
  CHECK_THAT(refusal(R"("tiles":[2,1,1])"), Contains("render.tiles"));
  CHECK_THAT(refusal(R"("footprint":"mip")"), Contains("render.footprint"));
  CHECK_THAT(refusal(R"("jitter":0.5)"), Contains("render.jitter"));
  CHECK_THAT(refusal(R"("modulate_by_gradient":2)"), Contains("render.modulate_by_gradient"));
  CHECK_THAT(refusal(R"("levels":2)"), Contains("render.levels"));
  CHECK_THAT(refusal(R"("transfer_texture":"rgba8")"), Contains("render.transfer_texture"));
  CHECK_THAT(refusal(R"("size":[8,8])", R"(,"volumes":[{"phantom":"head"},{"phantom":"head"}])"),
             Contains("several volumes"));
}
