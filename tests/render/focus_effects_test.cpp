// Highlight and attenuation in scenes: where the gaze comes from, and pictures worked by hand.
#include "catch.h"
#include "render_fixture.h"
#include "volume_fixture.h"

using namespace slicelens;

namespace {

const std::vector<std::string> pipelines = {"axis", "fragment", "tessellated", "rays", "reference"};

/// 16³ voxels of size 1 about the origin: f(j) on slab j along y.
PreparedScene slabs_scene(const std::function<double(int)>& f, TransferFunction transfer,
                          const std::string& keys) {
  return prepare(
      scene_from_json(
          R"({"camera":{"parallel_scale":8},"render":{"pipeline":"axis","size":[16,16],"filter":"linear-exact",
          "background":[0,0,0,0]},)" +
              keys + "}",
          "test"),
      volume_of(ScalarType::f32, {16, 16, 16}, [&](int, int j, int) { return f(j); }), std::move(transfer));
}

PreparedScene viewpoint_scene() {
  return slabs_scene([](int j) { return j; }, grey(0.5),
                     R"("attenuation":{"function":"viewpoint","focus":[[0.2,0.6],[0.2,0.6],[0.2,0.6]]})");
}

void check_gaze(const PreparedScene& scene, const glm::dvec3& expected) {
  const glm::dvec3 gaze = scene.effects.gaze;
  INFO(gaze.x << " " << gaze.y << " " << gaze.z);
  CHECK(glm::length(gaze - expected) < 1e-12);
}

} // namespace

TEST_CASE("gaze: the six axis views and an oblique one, orthographic") {
  const PreparedScene scene = viewpoint_scene();
  check_gaze(scene, {0, -1, 0}); // the camera looks along +y
  check_gaze(changed(scene, {"camera.azimuth=90"}), {1, 0, 0});
  check_gaze(changed(scene, {"camera.azimuth=-90"}), {-1, 0, 0});
  check_gaze(changed(scene, {"camera.azimuth=180"}), {0, 1, 0});
  check_gaze(changed(scene, {"camera.elevation=90"}), {0, 0, 1});
  check_gaze(changed(scene, {"camera.elevation=-90"}), {0, 0, -1});
  // Turned by 60° about z, then raised by 30°.
  check_gaze(changed(scene, {"camera.azimuth=60", "camera.elevation=30"}), {0.75, -std::sqrt(3.0) / 4, 0.5});
}

TEST_CASE("gaze: under perspective from the middle of the region to the eye, not along the axis of view") {
  // The region's middle is t = .4, 1.6 from the origin on every axis.
  const std::string camera = R"(,"camera":{"projection":"perspective","position":[28.4,-41.6,-1.6]})";
  PreparedScene scene = prepare(
      scene_from_json(R"({"attenuation":{"function":"viewpoint","focus":[[0.2,0.6],[0.2,0.6],[0.2,0.6]]})" +
                          camera + "}",
                      "test"),
      volume_of(ScalarType::u8, {16, 16, 16}, [](int, int, int) { return 1; }), grey(0.5));
  check_gaze(scene, {0.6, -0.8, 0}); // (30, −40, 0)/50
}

TEST_CASE("gaze: along the axes of a volume that is turned in the world") {
  Volume volume = volume_of(ScalarType::u8, {16, 16, 16}, [](int, int, int) { return 1; });
  // x of the volume is y of the world, y is −x.
  volume.direction = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
  PreparedScene scene = prepare(
      scene_from_json(
          R"({"render":{"pipeline":"axis"},"attenuation":{"function":"viewpoint","focus":[[0.2,0.6],[0.2,0.6],[0.2,0.6]]}})",
          "test"),
      std::move(volume), grey(0.5));
  check_gaze(scene, {-1, 0, 0});                                 // the viewer is at −y of the world
  check_gaze(changed(scene, {"camera.azimuth=90"}), {0, -1, 0}); // at +x of the world: −y of the volume
  // Attenuated are the texels that look at the viewer: t_x < .2 (x = 1/32: 5/32 of the whole), nothing on y.
  CHECK(scene.tables.texels[0][0].b == Approx(5.0 / 32));
  CHECK(scene.tables.texels[0][15].b == 1);
  CHECK(scene.tables.texels[1][0].b == 1);
}

TEST_CASE("a turned camera is a new table") {
  PreparedScene scene = viewpoint_scene();
  const auto b = [&](std::size_t axis, std::size_t texel) { return scene.tables.texels[axis][texel].b; };
  CHECK(b(1, 0) == Approx(5.0 / 32)); // x/.2 at 1/32
  CHECK(b(1, 15) == 1);
  CHECK(b(0, 15) == 1);
  scene.scene.camera.azimuth = 90;
  prepare_again(scene);
  CHECK(b(1, 0) == Approx(1));
  CHECK(b(1, 15) == Approx(1));
  CHECK(b(0, 0) == 1);
  CHECK(b(0, 15) == Approx(5.0 / 64)); // (1 − x)/.4 at 31/32
  scene.scene.camera.azimuth = 180;
  prepare_again(scene);
  CHECK(b(1, 15) == Approx(5.0 / 64));
}

TEST_CASE("under MIP the winning sample keeps its own highlight and attenuation") {
  gl::Context context = test_context();
  // The maximum is on slab 10, t_y = 21/32; nearer slabs are highlighted and attenuated less. Samples and
  // pixels sit on voxel centres; pixel (8, 8) has t_x = 17/32, t_z = 15/32.
  const TransferFunction transfer = {{{1, 0.2, 0.2, 0.2, 1}, {2, 1, 0.5, 0.25, 0.8}}, std::nullopt, ""};
  const PreparedScene scene = slabs_scene(
      [](int j) { return j == 10 ? 2.0 : 1.0; }, transfer,
      R"("highlight":{"function":"distance","color":[0,1,0],"focus":[[0.25,0.75],[0.25,0.5],[0.25,0.75]]},
      "attenuation":{"function":"distance","focus":[[0.25,0.75],[0.25,0.5],[0.25,0.75]]})");
  const double h =
      (1 - 2.0 * 9 / 32) * (15.0 / 16) * (15.0 / 16); // |3/8 − 21/32| = 9/32; |1/2 − 17/32| = 1/32
  const double alpha = 0.8 * (11.0 / 32) / 0.5;       // (1 − 21/32)/(1 − 1/2); in the region on x and z
  const glm::dvec3 color = glm::dvec3(1, 0.5, 0.25) * (1 - h) + glm::dvec3(0, 1, 0) * h;
  for (const std::string& pipeline : pipelines) {
    for (const std::string order : {"back-to-front", "front-to-back"}) {
      if (order == "front-to-back" && (pipeline == "rays" || pipeline == "reference"))
        continue; // rays know one order
      const Image image =
          picture(changed(scene, {"render.mode=mip", "render.pipeline=" + pipeline, "render.order=" + order}),
                  context);
      INFO(pipeline << " " << order);
      // Floats of numbers below 1.
      for (int c = 0; c < 3; ++c)
        CHECK(static_cast<double>(channel(image, 8, 8, c)) == Approx(color[c] * alpha).margin(1e-5));
      CHECK(static_cast<double>(channel(image, 8, 8, 3)) == Approx(alpha).margin(1e-5));
    }
  }
}

TEST_CASE("DVR and X-ray of one opaque slab: colour by equation 2, opacity times attenuation") {
  gl::Context context = test_context();
  // Opacity 0 but on slab 2, t_y = 5/32: a = 5/32 / (1/4) = 5/8; h_y = 1 − 2(3/8 − 5/32) = 9/16, others
  // 15/16.
  const TransferFunction transfer = {{{1, 1, 0.5, 0.25, 0}, {2, 1, 0.5, 0.25, 0.8}}, std::nullopt, ""};
  const PreparedScene scene = slabs_scene(
      [](int j) { return j == 2 ? 2.0 : 1.0; }, transfer,
      R"("highlight":{"function":"distance","color":[0,1,0],"focus":[[0.25,0.75],[0.25,0.5],[0.25,0.75]]},
      "attenuation":{"function":"distance","power":2,"focus":[[0.25,0.75],[0.25,0.5],[0.25,0.75]]})");
  const double h = 9.0 / 16 * 15 / 16 * 15 / 16;
  const double alpha = 0.8 * 25 / 64;
  const glm::dvec3 color = glm::dvec3(1, 0.5, 0.25) * (1 - h) + glm::dvec3(0, 1, 0) * h;
  for (const std::string& pipeline : pipelines) {
    INFO(pipeline);
    const Image dvr = picture(changed(scene, {"render.pipeline=" + pipeline}), context);
    const Image xray = picture(
        changed(scene, {"render.pipeline=" + pipeline, "render.mode=xray", "render.xray_scale=1"}), context);
    for (int c = 0; c < 3; ++c) {
      CHECK(static_cast<double>(channel(dvr, 8, 8, c)) == Approx(color[c] * alpha).margin(1e-5));
      // White, tinted towards the highlight's colour.
      const double white = 1 - h + (c == 1 ? h : 0);
      CHECK(static_cast<double>(channel(xray, 8, 8, c)) == Approx(white * alpha).margin(1e-5));
    }
    CHECK(static_cast<double>(channel(dvr, 8, 8, 3)) == Approx(alpha).margin(1e-5));
  }
}

TEST_CASE("opacity is attenuated before it is corrected for the spacing: pictures do not depend on it") {
  gl::Context context = test_context();
  const PreparedScene scene =
      slabs_scene([](int) { return 1; }, grey(0.05),
                  R"("attenuation":{"function":"distance","focus":[[0.25,0.75],[0.25,0.75],[0.25,0.75]]})");
  // Optical depth of a ray through (x, z) in the region: −ln(1 − .05a) over y; a = y/4 up to 4, 1 up to 12,
  // back to 0.
  const double e = 0.05;
  // ∫₀¹ −ln(1 − e·s) ds = 1 + (1 − e)·ln(1 − e)/e, over 4 voxels at either end.
  const double depth = 8 * (1 + (1 - e) * std::log(1 - e) / e) - 8 * std::log(1 - e);
  for (const std::string& pipeline : pipelines) {
    for (const std::string spacing : {"1", "0.25"}) {
      INFO(pipeline << " " << spacing);
      const Image image =
          picture(changed(scene, {"render.pipeline=" + pipeline, "render.spacing=" + spacing}), context);
      // The midpoint rule misses the kinks' curvature only; tables clamp within half a texel of the faces.
      CHECK(static_cast<double>(channel(image, 8, 8, 3)) ==
            Approx(-std::expm1(-depth)).margin(pipeline == "axis" ? 3e-3 : 1e-4));
    }
  }
}
