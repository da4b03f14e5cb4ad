// render.proxy "shells": slices whose fragments take the very samples of perspective rays.
//
// Bar: at most 0.1 % of all values may differ by more than 1e-3 from `rays`. Both evaluate the same functions
// in float at the same points; where they round apart, a sample at a face of the box or a clipping plane
// comes or goes, and the largest value of MIP may be another.
#include "catch.h"
#include "render_fixture.h"

using namespace slicelens;
using Catch::Matchers::Contains;

namespace {

const std::string two_planes =
    R"(clip=[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2]},{"point":[0.4,0.3,0.6],"normal":[0.2,1,0.1]}])";
const std::string object_plane =
    R"(clip=[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2],"space":"object"},{"point":[0.4,0.3,0.6],"normal":[0.2,1,0.1]}])";
const std::string swirl = R"(warp={"kind":"twist","angle":60})";
const std::string lens = R"(warp={"kind":"lamar","center":[0.5,0.4,0.5],"zoom":2,"inner":0.15,"outer":0.25})";

PreparedScene head_scene() {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[48,48,48]},
          "camera":{"azimuth":33,"elevation":21,"roll":10,"projection":"perspective","view_angle":60},
          "render":{"size":[80,64],"filter":"linear-exact","background":[0,0,0,0],"proxy":"shells"}})",
      {{{-500, 0.4, 0.2, 0.1, 0}, {200, 0.8, 0.6, 0.4, 0.05}, {1200, 1, 1, 0.9, 0.7}}, std::nullopt, ""});
}

/// Both orders.
void check_shells_are_rays(const PreparedScene& scene, const std::string& pipeline,
                           std::vector<std::string> keys) {
  gl::Context context = test_context();
  keys.insert(keys.end(), {"render.pipeline=rays", "render.proxy=planes"});
  const Image rays = picture(changed(scene, keys), context);
  keys.back() = "render.proxy=shells";
  keys[keys.size() - 2] = "render.pipeline=" + pipeline;
  for (const std::string order : {"back-to-front", "front-to-back"}) {
    keys.push_back("render.order=" + order);
    const Image shells = picture(changed(scene, keys), context);
    INFO(order << ": " << share_over(shells, rays, 1e-3) << ", largest " << max_difference(shells, rays));
    CHECK(share_over(shells, rays, 1e-3) <= 1e-3);
    keys.pop_back();
  }
  CHECK(share_over(rays, make_image(rays.width, rays.height), 0.05) > 0.01); // there is a picture
  keys.back() = "render.proxy=planes";
  const Image planes = picture(changed(scene, keys), context);
  INFO("planes: largest " << max_difference(planes, rays));
  CHECK(share_over(planes, rays, 1e-3) > 1e-3); // the test can fail
}

std::string refusal(const std::string& render, const std::string& rest = "") {
  try {
    scene_from_json(R"({"camera":{"projection":"perspective"},"render":{"proxy":"shells",)" + render + "}" +
                        rest + "}",
                    "test");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST_CASE("shells are rays: every mode, plain and clipped") {
  for (const std::string mode : {"dvr", "mip", "xray"}) {
    for (const bool clipped : {false, true}) {
      std::vector<std::string> keys = {"render.mode=" + mode, "render.xray_scale=0.1"};
      if (clipped)
        keys.push_back(two_planes);
      INFO(mode << (clipped ? ", clipped" : ""));
      check_shells_are_rays(head_scene(), "slices", keys);
    }
  }
}

TEST_CASE("shells are rays: shaded, from near, from afar, finely and without correction") {
  check_shells_are_rays(head_scene(), "slices", {"render.shading=phong"});
  check_shells_are_rays(head_scene(), "slices", {"render.spacing=0.4", "camera.zoom=0.8"});
  check_shells_are_rays(head_scene(), "slices", {"camera.view_angle=10", "render.opacity_correction=frame"});
  check_shells_are_rays(head_scene(), "slices", {"camera.view_angle=120"});
  check_shells_are_rays(head_scene(), "slices", {"render.opacity_correction=none"});
}

TEST_CASE("shells are rays with the eye in the volume") {
  const PreparedScene head = head_scene();
  // A quarter of the way from the middle to a face, looking through the rest.
  const glm::dvec3 eye = world_from_texture(head.box, {0.5, 0.3, 0.6});
  const glm::dvec3 at = world_from_texture(head.box, {0.5, 0.9, 0.4});
  const auto text = [](const glm::dvec3& v) {
    return "[" + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z) + "]";
  };
  PreparedScene inside = head;
  inside.scene.camera.azimuth = inside.scene.camera.elevation = inside.scene.camera.roll = 0;
  check_shells_are_rays(inside, "slices", {"camera.position=" + text(eye), "camera.focal_point=" + text(at)});
}

TEST_CASE("shells are rays under warps, by fragment") {
  check_shells_are_rays(head_scene(), "fragment", {swirl});
  check_shells_are_rays(head_scene(), "fragment", {swirl, object_plane, "render.shading=diffuse"});
  check_shells_are_rays(head_scene(), "fragment", {lens});
  check_shells_are_rays(head_scene(), "fragment", {lens, "render.footprint=mip", "render.size=[24,24]"});
}

TEST_CASE("shells are rays of several volumes") {
  Scene scene = scene_from_json(
      R"({"volumes":[{"phantom":"head","size":[32,32,32]},
                     {"phantom":"head-mr","size":[28,32,30],"warp":{"kind":"twist","angle":40},
                      "placement":{"translate":[10,0,0],"rotate":[0,0,10]}}],
          "camera":{"azimuth":30,"elevation":20,"projection":"perspective","view_angle":50},
          "render":{"size":[48,48],"background":[0,0,0,0]}})",
      "test");
  LoadedVolume first = load_volume_of(scene, 0, {}, {});
  std::vector<LoadedVolume> others = load_others(scene, {}, {});
  const PreparedScene heads =
      prepare(std::move(scene), std::move(first.volume), std::move(first.transfer), std::move(others));
  for (const std::string mode : {"dvr", "mip"}) {
    INFO(mode);
    check_shells_are_rays(heads, "fragment", {"render.mode=" + mode});
  }
}

TEST_CASE("shells of grid and axis show what their planes approach") {
  // Their maps are tables, so rays cannot be their measure to 1e-3; the exact map's rays are to 40 dB.
  gl::Context context = test_context();
  const std::string fisheye = R"(warp={"kind":"fisheye","center":[0.4,0.5,0.5],"distortion":2})";
  const Image rays =
      picture(changed(head_scene(), {fisheye, "render.pipeline=rays", "render.proxy=planes"}), context);
  for (const std::string pipeline : {"grid", "axis"}) {
    const Image shells = picture(changed(head_scene(), {fisheye, "render.pipeline=" + pipeline}), context);
    INFO(pipeline << " " << psnr(shells, rays));
    CHECK(psnr(shells, rays) >= 40);
  }
}

TEST_CASE("what shells cannot do is refused by name") {
  CHECK(refusal(R"("pipeline":"slices")") == "accepted");
  CHECK_THAT(refusal(R"("pipeline":"tessellated")"), Contains("pipeline 'tessellated'"));
  CHECK_THAT(refusal(R"("pipeline":"fixed-function","opacity_correction":"frame")"),
             Contains("pipeline 'fixed-function'"));
  CHECK_THAT(refusal(R"("pipeline":"rays")"), Contains("pipeline 'rays'"));
  CHECK_THAT(refusal(R"("classification":"pre","opacity_correction":"frame")"),
             Contains("render.classification"));
  CHECK_THAT(refusal(R"("jitter":0.5)"), Contains("render.jitter"));
  CHECK_THAT(refusal(R"("mode":"iso")"), Contains("mode 'iso'"));
  CHECK_THAT(refusal(R"("tiles":[2,1,1])"), Contains("render.tiles"));
  CHECK_THAT(refusal(R"("size":[8,8])", R"(,"planes":[{}])"), Contains("planes"));
  CHECK_THAT(refusal(R"("size":[8,8])", R"(,"overlay":{"stack":60})"), Contains("overlay.stack"));
  try {
    scene_from_json(R"({"render":{"proxy":"shells"}})", "test");
    FAIL("accepted");
  } catch (const UsageError& error) {
    CHECK_THAT(error.what(), Contains("camera.projection"));
  }
}
