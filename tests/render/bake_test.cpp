// The deformed volume written out, against the picture deformed on the fly; landmarks and fields by every
// pipeline.
#include "catch.h"
#include "core/errors.h"
#include "render/bake.h"
#include "render_fixture.h"

using namespace slicelens;

namespace {

const std::string held_corners = "[[0,0,0],[0,0,0]],[[1,0,0],[1,0,0]],[[0,1,0],[0,1,0]],[[1,1,0],[1,1,0]],"
                                 "[[0,0,1],[0,0,1]],[[1,0,1],[1,0,1]],[[0,1,1],[0,1,1]],[[1,1,1],[1,1,1]]";

PreparedScene head_under(const std::string& warp, const std::string& voxels = "64") {
  return prepare_phantom(R"({"volume":{"phantom":"head","size":[)" + voxels + "," + voxels + "," + voxels +
                             R"(]},"camera":{"azimuth":33,"elevation":21},
      "render":{"pipeline":"fragment","size":[64,64],"target":"rgba32f","filter":"linear-exact"},"warp":)" +
                             warp + "}",
                         rising(-200, 1500, 0.5));
}

std::string landmarks(const std::string& more, const std::string& method = "tps") {
  return R"({"kind":"landmarks","space":"texture","method":")" + method + R"(","pairs":[)" + held_corners +
         "," + more + "]}";
}

const std::string moved = "[[0.5,0.2,0.5],[0.5,0.12,0.58]],[[0.3,0.5,0.5],[0.22,0.5,0.5]]";

} // namespace

TEST_CASE("landmarks by fragments, rays and the reference are one picture, and grid comes near") {
  gl::Context context = test_context();
  for (const std::string method : {"tps", "bspline"}) {
    const PreparedScene scene = head_under(landmarks(moved, method));
    const Image reference = picture(changed(scene, {"render.pipeline=reference"}), context);
    CHECK(psnr(picture(scene, context), reference) > 55);
    CHECK(psnr(picture(changed(scene, {"render.pipeline=rays"}), context), reference) > 55);
    CHECK(psnr(picture(changed(scene, {"render.pipeline=grid", "render.grid_size=128"}), context),
               reference) > 45);
    const Image plain = picture(changed(scene, {"warp=[]"}), context);
    CHECK(psnr(plain, reference) < 35); // and something moved
  }
}

TEST_CASE("a baked volume drawn plainly is the picture deformed on the fly") {
  gl::Context context = test_context();
  // A resampling: the finer the voxels, the nearer.
  double before = 0;
  for (const char* voxels : {"32", "64", "128"}) {
    const PreparedScene scene = head_under(landmarks(moved), voxels);
    const Image deformed = picture(changed(scene, {"render.spacing=0.5"}), context);
    const PreparedScene plain = changed(scene, {"warp=[]", "render.pipeline=slices", "render.spacing=0.5"});
    const Volume baked = bake(scene, {std::nullopt, true, std::nullopt}, {});
    // The default camera would look at the middle of a box that has grown.
    Scene same_view = plain.scene;
    same_view.camera = {};
    same_view.camera.position = scene.view.eye;
    same_view.camera.focal_point = center(scene.box);
    same_view.camera.view_up = scene.view.up;
    same_view.camera.parallel_scale = scene.view.half_height;
    CHECK(baked.type == ScalarType::f32);
    const double db = psnr(picture(prepare(same_view, baked, plain.transfer), context), deformed);
    INFO(voxels << ": " << db << " dB");
    CHECK(db > std::max(24.0, before + 1));
    before = db;
  }
}

TEST_CASE("a baked volume without a warp is the volume, in its type and place") {
  const PreparedScene scene = head_under("[]", "16");
  PreparedScene by_slices = changed(scene, {"render.pipeline=slices"});
  const Volume baked = bake(by_slices, {}, {});
  CHECK(baked.dims == scene.volume.dims);
  CHECK(baked.type == scene.volume.type);
  CHECK(baked.voxels == scene.volume.voxels);
  CHECK(glm::length(baked.origin - scene.volume.origin) < 1e-9);
  CHECK(glm::length(baked.spacing - scene.volume.spacing) < 1e-9);
}

TEST_CASE("a volume that is shown beside its box is baked where it is shown") {
  // All corners three tenths of the volume along x.
  std::string pairs = held_corners;
  for (std::size_t at = pairs.find("],["); at != std::string::npos; at = pairs.find("],[", at + 1)) {
    if (pairs[at + 3] == '[')
      continue; // between pairs
    pairs.replace(at + 3, 1, pairs[at + 3] == '1' ? "1.5" : "0.5");
  }
  const PreparedScene scene =
      head_under(R"({"kind":"landmarks","space":"texture","pairs":[)" + pairs + "]}", "16");
  const Volume baked = bake(scene, {}, {});
  CHECK(baked.dims[0] >= 24);
  CHECK(baked.dims[1] >= 16);
  CHECK(baked.spacing == scene.volume.spacing);
  // Voxel i of the volume is shown 8 voxels farther.
  const glm::dvec3 at =
      scene.volume.origin + scene.volume.direction * (scene.volume.spacing * glm::dvec3(13, 7, 9));
  const glm::dvec3 index = glm::transpose(baked.direction) * (at - baked.origin) / baked.spacing;
  const glm::ivec3 i(glm::round(index));
  CHECK(glm::length(index - glm::dvec3(i)) < 1e-6);
  const double expected = value_at(scene.volume, 5, 7, 9);
  CHECK(std::abs(value_at(baked, static_cast<std::size_t>(i.x), static_cast<std::size_t>(i.y),
                          static_cast<std::size_t>(i.z)) -
                 expected) <= 1);
  // Left of it nothing is shown.
  CHECK(value_at(baked, static_cast<std::size_t>(i.x) - 10, static_cast<std::size_t>(i.y),
                 static_cast<std::size_t>(i.z)) == scene.volume.min);
  const Volume small = bake(scene, {std::array<std::size_t, 3>{10, 11, 12}, true, 7.5}, {});
  CHECK(small.dims == std::array<std::size_t, 3>{10, 11, 12});
  CHECK(glm::length(glm::dvec3(10, 11, 12) * small.spacing -
                    glm::dvec3(baked.dims[0], baked.dims[1], baked.dims[2]) * baked.spacing) < 1e-9);
  CHECK(value_at(small, 0, 5, 5) == 7.5);
  CHECK_THROWS_WITH(bake(scene, {std::nullopt, false, 1e9}, {}), Catch::Contains("int16"));
}

TEST_CASE("landmarks keep their grid while only the view changes") {
  const PreparedScene scene = head_under(landmarks(moved), "16");
  REQUIRE(scene.held.size() == 1);
  CHECK(changed(scene, {"camera.azimuth=50"}).held[0].map.grid == scene.held[0].map.grid);
  CHECK(changed(scene, {"warp.resolution=32"}).held[0].map.grid != scene.held[0].map.grid);
  CHECK(changed(scene, {"warp=[]"}).held.empty());
}
