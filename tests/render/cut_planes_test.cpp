#include "catch.h"
#include "render/cut_planes.h"
#include "render_fixture.h"

using namespace slicelens;

namespace {

const std::string plane_and_clip =
    R"("planes":[{"point":[0.5,0.4,0.5],"normal":[0.2,-1,0.5],"range":[-200,1500]}],
       "clip":[{"point":[0.5,0.4,0.5],"normal":[-0.2,1,-0.5],"space":"object"}],)";

PreparedScene head(const std::string& keys, const std::string& render) {
  return prepare_phantom(R"({"volume":{"phantom":"head","size":[48,48,48]},)" + keys +
                             R"("camera":{"azimuth":20,"elevation":10},"render":{"size":[64,64],
                             "filter":"linear-exact")" +
                             render + "}}",
                         rising(-200, 1500, 0.4));
}

} // namespace

TEST_CASE("a cutting plane is the same by slices of both orders, rays and reference") {
  gl::Context context = test_context();
  for (const std::string projection : {"orthographic", "perspective"}) {
    for (const std::string warp : {"", R"("warp":{"kind":"fisheye","distortion":2},)"}) {
      const std::string slicing = warp.empty() ? "slices" : "fragment";
      const PreparedScene scene = changed(head(plane_and_clip + warp, R"(,"pipeline":")" + slicing + "\""),
                                          {"camera.projection=" + projection, "render.spacing=0.25"});
      const Image truth = picture(changed(scene, {"render.pipeline=reference"}), context);
      const Image slices = picture(scene, context);
      INFO(projection << " " << slicing);
      // Slices end at the plane to within one spacing, which is a quarter of a voxel; 45 dB is far below what
      // a plane in the wrong place or order leaves (20 dB).
      CHECK(psnr(slices, truth) > 45);
      CHECK(psnr(picture(changed(scene, {"render.order=front-to-back"}), context), slices) > 70);
      CHECK(psnr(picture(changed(scene, {"render.pipeline=rays"}), context), truth) > 60);
      if (!warp.empty())
        CHECK(psnr(picture(changed(scene, {"render.pipeline=axis", "render.axis_texels=4096"}), context),
                   truth) > 45);
    }
  }
}

TEST_CASE("what a plane shows: grey of the range, or the transfer function's colour, opaque") {
  gl::Context context = test_context();
  // The ramp's value is t_x. Seen from the front (along y), x grows to the right; the plane faces the viewer.
  const std::string keys =
      R"({"volume":{"phantom":"ramp","size":[64,64,64]},"planes":[{"range":[0.25,0.75],"style":"STYLE"}],
          "render":{"size":[32,32],"pipeline":"PIPE","filter":"linear-exact","background":[0,0,0,0]},"camera":{"zoom":1.7320508}})";
  for (const std::string pipeline : {"slices", "rays", "reference"}) {
    for (const std::string style : {"values", "transfer"}) {
      std::string text = keys;
      text.replace(text.find("STYLE"), 5, style);
      text.replace(text.find("PIPE"), 4, pipeline);
      // Nothing of the volume itself is visible.
      const PreparedScene scene =
          prepare_phantom(text, {{{0, 1, 0, 0, 0}, {1, 0, 0.5, 1, 0}}, std::nullopt, "t"});
      const Image image = picture(scene, context);
      INFO(pipeline << " " << style);
      for (const int x : {4, 12, 20, 28}) {
        const double t = (x + 0.5) / 32; // parallel scale √3/2·edge / √3: the face fills the picture
        const double grey = std::min((t - 0.25) / 0.5, 1.0);
        const bool below_black = style == "values" && grey < 0; // nothing there
        const glm::dvec3 expected =
            style == "values" ? glm::dvec3(std::max(grey, 0.0)) : glm::dvec3(1 - t, 0.5 * t, t);
        for (int c = 0; c < 3; ++c) // 1e-3: rounding of the zoom, and the transfer function's table
          CHECK(static_cast<double>(channel(image, x, 16, c)) == Approx(expected[c]).margin(2e-3));
        CHECK(channel(image, x, 16, 3) == Approx(below_black ? 0 : 1).margin(1e-6));
      }
    }
  }
}

TEST_CASE("the camera of a plane faces it and shows just its polygon") {
  const PreparedScene scene = prepare_phantom(R"({"volume":{"phantom":"box","size":[16,16,16]}})", grey(0.5));
  PlaneSettings plane;
  plane.normal = glm::dvec3(0, -2, 0);
  const CameraSettings camera = camera_of_plane(scene, plane, 1);
  // By hand: the face of the unit box across y is as high as the box.
  CHECK(*camera.parallel_scale == Approx(0.5 * extent(scene.box).z));
  CHECK(glm::length(*camera.focal_point - center(scene.box)) < 1e-9);
  CHECK(glm::length(glm::normalize(*camera.position - *camera.focal_point) - glm::dvec3(0, -1, 0)) < 1e-12);
  CHECK(*camera_of_plane(scene, plane, 0.5).parallel_scale == Approx(extent(scene.box).z));
  plane.point = glm::dvec3(0.5, 3, 0.5);
  CHECK_THROWS_WITH(camera_of_plane(scene, plane, 1),
                    Catch::Matchers::Contains("misses the displayed volume"));
}

TEST_CASE("planes that cannot be are refused by name") {
  const auto refused = [](const std::string& keys) {
    try {
      (void)scene_from_json(keys, "test");
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refused(R"({"planes":[{"normal":[0,0,0]}]})"),
             Catch::Matchers::Contains("normal is the zero vector"));
  CHECK_THAT(refused(R"({"planes":[{"range":[2,1]}]})"), Catch::Matchers::Contains("black below white"));
  CHECK_THAT(refused(R"({"planes":[{}],"render":{"mode":"mip"}})"), Catch::Matchers::Contains("render.mode"));
  CHECK_THAT(refused(R"({"planes":[{}],"render":{"tiles":[2,1,1]}})"),
             Catch::Matchers::Contains("render.tiles"));
  CHECK_THAT(refused(R"({"planes":[{}],"render":{"pipeline":"fixed-function"}})"),
             Catch::Matchers::Contains("post"));
}
