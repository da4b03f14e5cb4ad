// Small pictures of phantoms as they were when somebody last looked at them: tests/golden/*.png.
//
// A failure writes actual, expected and amplified difference and says where. When a change of the picture is
// meant, run the tests with SLICELENS_UPDATE_GOLDEN=1, look at the new files, and commit them with the
// reason:
//   SLICELENS_UPDATE_GOLDEN=1 ctest --preset release -R 'render: golden'
//
// The filter is linear-exact: softpipe's own linear filter is off by up to .17 at single samples (a MIP by it
// is 44 dB from the reference, 129 dB with linear-exact).
#include "catch.h"
#include "image/image_io.h"
#include "image/pictures.h"
#include "render_fixture.h"
#include "scene/load.h"
#include "study/metrics.h"

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

/// As an 8-bit file holds it.
Image quantised(Image image) {
  for (float& value : image.pixels)
    value = std::round(std::clamp(value, 0.0F, 1.0F) * 255) / 255;
  return image;
}

void check_golden(const std::string& name, const std::string& json) {
  gl::Context context = test_context();
  Scene scene = scene_from_json(json, name);
  Volume volume = load_volume(scene.volume, {}, {});
  TransferFunction transfer = transfer_of(scene, volume);
  const Image actual =
      quantised(picture(prepare(std::move(scene), std::move(volume), std::move(transfer)), context));
  const fs::path file = fs::path(SLICELENS_SOURCE_DIR) / "tests" / "golden" / (name + ".png");
  if (std::getenv("SLICELENS_UPDATE_GOLDEN") != nullptr && !softpipe_requested()) {
    write_image(actual, file, PixelDepth::png8);
    SLICELENS_SKIP("wrote " + file.string() + " anew; look at it");
  }
  const Image expected = read_image(file);
  const Metrics metrics = compare_images(actual, expected);
  // docs/tolerances.md: the drivers round differently, and single samples on edges flip.
  const bool same =
      metrics.max_abs <= 3.0 / 255 + 1e-6 && metrics.over_1_255 <= 1e-3 && metrics.ssim >= 0.999;
  std::string where;
  if (!same) {
    const fs::path folder = fs::current_path() / "golden_failures";
    fs::create_directories(folder);
    const std::string driver = softpipe_requested() ? "_softpipe" : "";
    write_image(actual, folder / (name + driver + "_actual.png"), PixelDepth::png8);
    write_image(expected, folder / (name + driver + "_expected.png"), PixelDepth::png8);
    write_image(difference_image(actual, expected, 32), folder / (name + driver + "_difference_x32.png"),
                PixelDepth::png8);
    where = folder.string();
  }
  INFO(name << ": largest difference " << metrics.max_abs * 255 << "/255, over one step "
            << metrics.over_1_255 * 100 << " %, SSIM " << metrics.ssim
            << "; actual, expected and difference are in " << where);
  CHECK(same);
}

} // namespace

TEST_CASE("golden: bones of the head in diffuse light") {
  check_golden("head_bone", R"({"volume":{"phantom":"head","size":[64,64,64]},"transfer":{"preset":"CT-Bone"},
    "camera":{"azimuth":30,"elevation":10,"zoom":1.5},"render":{"size":[96,96],"filter":"linear-exact","shading":"diffuse"}})");
}
TEST_CASE("golden: the engine in perspective") {
  check_golden("engine_perspective", R"({"volume":{"phantom":"engine","size":[64,64,32]},
    "camera":{"azimuth":-30,"elevation":25,"projection":"perspective","view_angle":60,"zoom":1.6},
    "transfer":{"unit_distance":0.4},"render":{"size":[96,96],"filter":"linear-exact","spacing":0.5}})");
}
TEST_CASE("golden: the brick, cut, front to back") {
  check_golden("brick",
               R"({"volume":{"phantom":"brick","size":[64,64,64]},"camera":{"azimuth":30,"elevation":20},
    "render":{"size":[96,96],"filter":"linear-exact","shading":"diffuse","gradient":"forward","order":"front-to-back",
              "background":[0.2,0.25,0.3,1]},
    "clip":[{"point":[0.6,0.5,0.5],"normal":[-1,-0.4,0]}]})");
}
TEST_CASE("golden: X-ray of the blob") {
  check_golden("blob_xray", R"({"volume":{"phantom":"blob","size":[64,64,64]},
    "transfer":{"points":[[0,1,1,1,0],[1,1,1,1,1]]},
    "render":{"size":[96,96],"filter":"linear-exact","mode":"xray","xray_scale":0.05}})");
}
TEST_CASE("golden: maximum of the head with MR contrast, by rays") {
  check_golden("head_mr_mip",
               R"({"volume":{"phantom":"head-mr","size":[64,64,64]},"transfer":{"preset":"MR-MIP"},
    "camera":{"azimuth":25,"elevation":20,"zoom":1.5},
    "render":{"size":[96,96],"filter":"linear-exact","mode":"mip","pipeline":"rays"}})");
}
TEST_CASE("golden: the head under a tessellated lens") {
  check_golden("head_lens", R"({"volume":{"phantom":"head","size":[64,64,64]},"transfer":{"preset":"CT-Bone"},
    "camera":{"azimuth":-20,"elevation":5,"zoom":1.5},"render":{"size":[96,96],"filter":"linear-exact","shading":"diffuse"},
    "warp":{"kind":"lamar","zoom":2,"center":[0.38,0.28,0.53],"inner":0.11,"outer":0.2,"angular_segments":16,"radial_segments":8}})");
}
