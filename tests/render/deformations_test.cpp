// Brunet's deformations and the volume widgets in pictures: by fragments, along rays, by the reference, per
// vertex.
#include "catch.h"
#include "render_fixture.h"

using namespace slicelens;

namespace {

const std::vector<std::string>& warps() {
  static const std::vector<std::string> list = {
      R"({"kind":"shift","offset":[0.2,-0.6,0.1]})",
      R"({"kind":"sine","axis":"x","along":"z","amplitude":0.1,"wavelength":0.5})",
      R"({"kind":"twist","axis":"z","angle":120})",
      R"({"kind":"bend","axis":"z","toward":"-x","angle":80})",
      R"({"kind":"pulse","center":[0.5,0.3,0.5],"radius":0.35,"magnification":2.5})",
      R"({"kind":"spreader","axis":"x","toward":"-y","angle":50,"gap":0.05})",
      R"({"kind":"leafer","axis":"-y","toward":"x","leaves":4,"angle":70})",
      R"({"kind":"peeler","axis":"z","toward":"-y","center":[0.5,0.35,0.5],"radius":0.4,"angle":110})",
      R"({"kind":"expander","center":[0.5,0.3,0.5],"opening":0.12,"radius":0.3})",
  };
  return list;
}

PreparedScene head_under(const std::string& warp, int voxels = 32, int pixels = 32,
                         const std::string& more = "") {
  const std::string n = std::to_string(voxels);
  const std::string size = std::to_string(pixels);
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[)" + n + "," + n + "," + n +
          R"(]},"camera":{"azimuth":33,"elevation":21,"roll":10},)" + more +
          R"("render":{"pipeline":"fragment","size":[)" + size + "," + size +
          R"(],"target":"rgba32f","filter":"linear-exact","xray_scale":0.1,"background":[0,0,0,0]},"warp":)" +
          warp + "}",
      rising(-200, 1500, 0.5));
}

const std::string planes =
    R"(clip=[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2]},{"point":[0.5,0.5,0.6],"normal":[0.2,0.1,-1],"space":"object"}])";
const std::vector<std::string> perspective = {"camera.projection=perspective", "camera.view_angle=40",
                                              "render.spacing=0.5"};

/// Orthographic slices take the samples of rays; in perspective they take others: the distance of two
/// midpoint rules at half a voxel, for MIP of two maxima. `exact`: of equal samples, where floats and doubles
/// may fall on two sides of a cut.
void check_pictures(const PreparedScene& scene, double exact, gl::Context& context) {
  const auto by = [&](const std::string& pipeline) {
    return picture(changed(scene, {"render.pipeline=" + pipeline}), context);
  };
  const Image truth = by("reference");
  const double fragment = psnr(by("fragment"), truth);
  const double rays = psnr(by("rays"), truth);
  INFO("fragment " << fragment << ", rays " << rays);
  const bool orthographic = scene.view.projection == Projection::orthographic;
  const Mode mode = scene.scene.render.mode;
  CHECK(rays >= exact);
  CHECK(fragment >= (orthographic ? exact : mode == Mode::mip ? 32 : mode == Mode::xray ? 45 : 40));
  CHECK(share_over(truth, make_image(truth.width, truth.height), 0.02) > 0.02); // there is a picture
}

void check_matrix(std::size_t first, std::size_t last) {
  gl::Context context = test_context();
  for (std::size_t i = first; i <= last; ++i) {
    const PreparedScene head = head_under(warps()[i]);
    int combination = 0;
    for (const std::string mode :
         {"render.mode=dvr", "render.shading=diffuse", "render.mode=mip", "render.mode=xray"}) {
      for (const bool in_perspective : {false, true}) {
        std::vector<std::string> keys = {mode};
        if (in_perspective)
          keys.insert(keys.end(), perspective.begin(), perspective.end());
        const bool clipped = combination++ % 4 == 0 || combination % 4 == 0;
        if (clipped)
          keys.push_back(planes);
        INFO(warps()[i] << ", " << mode << (clipped ? ", clipped" : "")
                        << (in_perspective ? ", perspective" : ""));
        check_pictures(changed(head, keys), 55, context);
      }
    }
  }
}

} // namespace

TEST_CASE("deformations in every mode and projection by fragments, rays and the reference", "[one-driver]") {
  check_matrix(0, 4);
}

TEST_CASE("widgets in every mode and projection by fragments, rays and the reference", "[one-driver]") {
  check_matrix(5, 8);
}

TEST_CASE("deformations and widgets are one picture by fragments, rays and the reference") {
  gl::Context context = test_context();
  for (const std::string& warp : warps()) {
    INFO(warp);
    check_pictures(head_under(warp, 24, 24), 55, context); // every driver
  }
}

TEST_CASE("deformations chain with lenses, with Cohen's mappings and effects, and with each other") {
  gl::Context context = test_context();
  const std::string lamar =
      R"({"kind":"lamar","zoom":2.5,"center":[0.3,0.3,0.75],"inner":0.15,"outer":0.25})";
  const std::string bifocal =
      R"({"kind":"bifocal","focus":[[0.4,0.6],[0.35,0.5],[0.4,0.6]],"shown":[[0.25,0.75],[0.2,0.7],[0.25,0.75]]})";
  const std::string highlight = R"("highlight":{"function":"distance","power":2},)";
  std::vector<Image> by_order;
  const auto check = [&](const std::string& list, const std::string& effects) {
    INFO(list);
    const PreparedScene scene = head_under(list, 32, 32, effects);
    check_pictures(scene, 55, context);
    check_pictures(changed(scene, {"render.shading=diffuse"}), 55, context);
    by_order.push_back(picture(scene, context));
  };
  check("[" + warps()[2] + "," + lamar + "]", "");
  check("[" + lamar + "," + warps()[2] + "]", "");
  check("[" + bifocal + "," + warps()[3] + "]", highlight);
  check("[" + warps()[3] + "," + bifocal + "]", highlight);
  check("[" + warps()[4] + "," + warps()[6] + "," + warps()[1] + "]", "");
  CHECK(psnr(by_order[0], by_order[1]) < 40); // the order counts
  CHECK(psnr(by_order[2], by_order[3]) < 40);
}

TEST_CASE("the bounds of a deformed volume cut nothing off") {
  gl::Context context = test_context();
  for (const std::string& warp : warps()) {
    for (const bool in_perspective : {false, true}) {
      INFO(warp << (in_perspective ? ", perspective" : ""));
      PreparedScene scene =
          changed(head_under(warp), {"camera.zoom=0.6", "render.pipeline=rays", "render.mode=xray"});
      if (in_perspective)
        scene = changed(scene, perspective);
      const Image tight = picture(scene, context);
      const PreparedScene slices = changed(scene, {"render.pipeline=fragment"});
      const Image tight_slices = picture(slices, context);
      const auto widened = [](PreparedScene prepared) {
        prepared.object_low -= 0.4;
        prepared.object_high += 0.4;
        return prepared;
      };
      // Samples lie where they lie, whatever is around them; a float at a bound may take one more of opacity
      // 0 at a face.
      CHECK(max_difference(tight, picture(widened(scene), context)) <= 1e-3);
      CHECK(max_difference(tight_slices, picture(widened(slices), context)) <= 1e-3);
    }
  }
}

TEST_CASE("deformations without strength leave the picture of plain slicing") {
  gl::Context context = test_context();
  const std::vector<std::string> still = {
      R"({"kind":"shift","offset":[0,0,0]})", R"({"kind":"sine","amplitude":0})",
      R"({"kind":"twist","angle":0})",        R"({"kind":"bend","angle":0})",
      R"({"kind":"pulse","phase":0})",        R"({"kind":"spreader","angle":0})",
      R"({"kind":"leafer","angle":0})",       R"({"kind":"peeler","angle":0})",
      R"({"kind":"expander","opening":0})",
  };
  const PreparedScene plain = changed(head_under("[]"), {"render.shading=diffuse", "render.pipeline=slices"});
  const Image without = picture(plain, context);
  for (const std::string& warp : still) {
    for (const std::string pipeline : {"fragment", "tessellated"}) {
      INFO(pipeline << " " << warp);
      CHECK(max_difference(picture(changed(plain, {"warp=" + warp, "render.pipeline=" + pipeline}), context),
                           without) <= 1e-3);
    }
  }
}

TEST_CASE("per vertex deformations come to those per fragment by the square of the subdivision",
          "[one-driver]") {
  gl::Context context = test_context();
  const std::string fisheye = R"({"kind":"fisheye","distortion":2})";
  for (const std::string& warp :
       {warps()[1], warps()[2], warps()[4], fisheye, "[" + warps()[2] + R"(,{"kind":"lamar","zoom":2}])"}) {
    const PreparedScene scene = head_under(warp, 32, 48);
    const Image exact = picture(changed(scene, {"render.pipeline=fragment"}), context);
    double before = 0;
    for (const std::string cells : {"8", "32", "128"}) {
      const double now = psnr(
          picture(changed(scene, {"render.pipeline=tessellated", "render.subdivision=" + cells}), context),
          exact);
      INFO(warp << ", " << cells << " cells: " << now << " dB after " << before);
      // Four times the cells are a sixteenth of the error, 24 dB; less where there are creases.
      CHECK(now >= before + 16);
      before = now;
    }
    CHECK(before >= 60);
  }
}

TEST_CASE("per vertex planes clip, light falls, effects tint and tiles hold the volume as per fragment") {
  gl::Context context = test_context();
  const PreparedScene scene = head_under(
      warps()[2], 32, 48, R"("highlight":{"function":"focus","focus":[[0.2,0.5],[0.2,0.8],[0.3,0.7]]},)");
  for (const std::vector<std::string>& keys :
       std::vector<std::vector<std::string>>{{"render.shading=diffuse"},
                                             {planes},
                                             {"render.mode=mip"},
                                             perspective,
                                             {"render.tiles=[2,1,3]"}}) {
    std::vector<std::string> fragment = keys;
    std::vector<std::string> vertex = keys;
    if (keys[0] == "render.tiles=[2,1,3]")
      fragment.clear();
    fragment.emplace_back("render.pipeline=fragment");
    vertex.insert(vertex.end(), {"render.pipeline=tessellated", "render.subdivision=128"});
    INFO(keys[0]);
    CHECK(psnr(picture(changed(scene, vertex), context), picture(changed(scene, fragment), context)) >= 50);
  }
}

TEST_CASE("a mesh of too many cells is refused, and so are subdivisions beyond the limits") {
  gl::Context context = test_context();
  const PreparedScene scene =
      changed(head_under(warps()[2]),
              {"render.pipeline=tessellated", "render.subdivision=512", "render.spacing=0.2"});
  CHECK_THROWS_WITH(picture(scene, context),
                    Catch::Matchers::Contains("render.subdivision") && Catch::Matchers::Contains("spacing"));
  for (const std::string cells : {"0", "513"})
    CHECK_THROWS_WITH(changed(scene, {"render.subdivision=" + cells}),
                      Catch::Matchers::Contains("render.subdivision"));
}
