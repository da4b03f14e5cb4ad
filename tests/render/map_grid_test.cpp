// Pipeline `grid`: pictures by a 3D texture of displacements against the exact map (Brunet, Nowak and
// Gleicher 2006 §4).
#include "catch.h"
#include "render_fixture.h"

using namespace slicelens;

namespace {

PreparedScene head_under(const std::string& warp, const std::string& render_keys = "") {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[48,48,48]},"camera":{"azimuth":33,"elevation":21},
      "render":{"pipeline":"fragment","size":[64,64],"target":"rgba32f","filter":"linear-exact")" +
          render_keys + R"(},"warp":)" + warp + "}",
      rising(-200, 1500, 0.5));
}

const std::string fisheye = R"({"kind":"fisheye","center":[0.5,0.4375,0.5],"distortion":2})";
const std::string connected =
    R"({"kind":"connected-lens","center":[0.5,0.4375,0.5],"inner":0.15,"outer":0.3125,"magnification":2})";

} // namespace

TEST_CASE("pipeline grid converges to fragment as its nodes grow") {
  gl::Context context = test_context();
  for (const std::string& warp : {fisheye, connected}) {
    const PreparedScene scene = head_under(warp);
    const Image exact = picture(scene, context);
    double before = 0;
    double voxels_before = 0;
    for (const char* n : {"16", "32", "64"}) {
      const PreparedScene by_grid =
          changed(scene, {"render.pipeline=grid", std::string("render.grid_size=") + n});
      const double db = psnr(picture(by_grid, context), exact);
      const double voxels = map_grid_error(by_grid).rms;
      INFO(warp << " " << n << ": " << db << " dB, rms " << voxels << " voxels");
      // Half the cells: a quarter of the error is 12 dB; creases of the maps cost some of it.
      CHECK(db > before + (before > 0 ? 6 : 25));
      if (voxels_before > 0)
        CHECK(voxels_before / voxels > 2.5);
      before = db;
      voxels_before = voxels;
    }
    CHECK(before > 45);
  }
}

TEST_CASE("pipeline grid: the driver's filter and the shader's weights draw the same") {
  gl::Context context = test_context();
  const PreparedScene scene = head_under(fisheye);
  const Image by_driver = picture(changed(scene, {"render.pipeline=grid", "render.filter=linear"}), context);
  const Image in_shader = picture(changed(scene, {"render.pipeline=grid"}), context);
  // llvmpipe comes to more than 70 dB. softpipe to 46, though its grids are the CPU's as well
  // (warp_gpu_test.cpp).
  CHECK(psnr(by_driver, in_shader) > 40);
}

TEST_CASE("pipeline grid draws a chain of warps, shades it, and clips it") {
  gl::Context context = test_context();
  for (const std::string keys :
       {R"(,"shading":"diffuse")", R"(,"mode":"mip")", R"(,"mode":"xray","xray_scale":0.1)"}) {
    const PreparedScene scene = head_under("[" + fisheye + "," + connected + "]", keys);
    const Image exact = picture(scene, context);
    const PreparedScene by_grid = changed(scene, {"render.pipeline=grid", "render.grid_size=128"});
    const double db = psnr(picture(by_grid, context), exact);
    INFO(keys << ": " << db << " dB");
    CHECK(db > 40);
  }
  const PreparedScene cut = head_under(
      connected, R"(},"clip":[{"point":[0.5,0.45,0.5],"normal":[0.3,1,0]}],"light":{"ambient":0.3)");
  const Image exact = picture(cut, context);
  CHECK(psnr(picture(changed(cut, {"render.pipeline=grid", "render.grid_size=128"}), context), exact) > 40);
}

TEST_CASE("pipeline grid without a warp is slices; its key is refused beyond its range") {
  gl::Context context = test_context();
  const PreparedScene plain = prepare_phantom(
      R"({"volume":{"phantom":"blob","size":[16,16,16]},"render":{"pipeline":"grid","size":[32,32]}})",
      grey(0.1));
  CHECK(picture(plain, context).pixels ==
        picture(changed(plain, {"render.pipeline=slices"}), context).pixels);
  CHECK_THROWS_WITH(scene_from_json(R"({"render":{"grid_size":7}})", "test"), Catch::Contains("8 to 128"));
  CHECK_THROWS_WITH(scene_from_json(R"({"render":{"grid_size":[8,8,129]}})", "test"), Catch::Contains("129"));
  CHECK(scene_from_json(R"({"render":{"grid_size":[8,16,128]}})", "test").render.grid_size ==
        std::array<std::size_t, 3>{8, 16, 128});
}
