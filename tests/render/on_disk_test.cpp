// Pictures of volumes whose voxels stay on disk, against pictures of the same in one texture.
#include "catch.h"
#include "core/errors.h"
#include "render_fixture.h"
#include "scene/load.h"
#include "study/metrics.h"
#include "temporary_folder.h"
#include "volume/write.h"

#include <filesystem>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

/// A head of 72 x 64 x 80 voxels in a file. What is kept of it goes where ctest sets XDG_CACHE_HOME.
struct HeadFile {
  TemporaryFolder folder;
  HeadFile() { write_volume(make_phantom("head", {72, 64, 80}), folder / "head.nrrd"); }

  PreparedScene load(const std::string& access, const std::string& render,
                     const std::string& more = "") const {
    Scene scene =
        scene_from_json(R"({"volume":{"file":"head.nrrd","access":")" + access +
                            R"("},"transfer":{"preset":"CT-Bone"},"camera":{"azimuth":20,"elevation":10},
                                      "render":{"size":[96,96],"filter":"linear-exact","target":"rgba32f",)" +
                            render + "}" + more + "}",
                        "test");
    LoadedVolume loaded = load_volume_of(scene, 0, {folder.path()}, {});
    return prepare(std::move(scene), std::move(loaded.volume), std::move(loaded.transfer));
  }
};

} // namespace

TEST_CASE("volumes on disk give the picture of the volume in memory") {
  const HeadFile head;
  gl::Context context = test_context();
  const std::string lens =
      R"(,"warp":{"kind":"lamar","zoom":3,"center":[0.5,0.4,0.6],"inner":0.12,"outer":0.25})";
  const std::vector<std::array<std::string, 2>> scenes = {{R"("mode":"dvr")", ""},
                                                          {R"("mode":"mip")", ""},
                                                          {R"("pipeline":"rays","shading":"phong")", ""},
                                                          {R"("pipeline":"fragment")", lens},
                                                          {R"("mode":"iso","pipeline":"rays")", ""}};
  for (const auto& [render, more] : scenes) {
    CAPTURE(render);
    const Image expected = picture(head.load("memory", render, more), context);
    for (const char* access : {"stream", "cache"}) {
      CAPTURE(access);
      const PreparedScene prepared = head.load(access, render, more);
      REQUIRE(prepared.volume.voxels.empty());
      // The bar for bricks against one texture.
      CHECK(compare_images(picture(prepared, context), expected).psnr.value_or(200) >= 60);
    }
  }
}

TEST_CASE("coarser levels on disk give the picture of those in memory") {
  const HeadFile head;
  gl::Context context = test_context();
  const std::string lens =
      R"(,"warp":{"kind":"lamar","zoom":4,"center":[0.5,0.4,0.6],"inner":0.12,"outer":0.25})";
  const std::string render = R"("levels":3,"pipeline":"tessellated")";
  const Image expected = picture(head.load("memory", render, lens), context);
  CHECK(compare_images(picture(head.load("cache", render, lens), context), expected).psnr.value_or(200) >=
        60);
}

TEST_CASE("a file that shrinks between two pictures is one line, and no picture") {
  const HeadFile head;
  gl::Context context = test_context();
  const PreparedScene prepared = head.load("stream", R"("mode":"dvr")");
  CHECK(picture(prepared, context).width == 96);
  const fs::path file = head.folder / "head.nrrd";
  fs::resize_file(file, fs::file_size(file) / 2);
  std::string problem;
  try {
    picture(prepared, context);
  } catch (const FileError& error) {
    problem = error.what();
  }
  CHECK(problem.find("head.nrrd: became shorter while its voxels were read") != std::string::npos);
  CHECK(problem.find('\n') == std::string::npos);
}
