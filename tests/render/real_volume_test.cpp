// A real CT: 512×512×128 voxels of 16 bits, DICOM.
#include "catch.h"
#include "render_fixture.h"
#include "volume/read.h"

using namespace slicelens;

TEST_CASE("a chest CT: slices are rays, and perspective ones come to 60 dB", "[one-driver]") {
  const std::filesystem::path folder = real_volumes() / "ct_chest_large" / "series";
  if (real_volumes().empty() || !std::filesystem::exists(folder))
    SLICELENS_SKIP("ct_chest_large is not there (SLICELENS_VOLUMES names the folder of real volumes)");
  VolumeSource source;
  source.file = folder;
  Volume volume = read_volume(source);
  const double low = volume.min;
  const double range = volume.max - volume.min;
  PreparedScene scene = prepare(
      scene_from_json(R"({"camera":{"azimuth":33,"elevation":21,"roll":10},)"
                      R"("render":{"size":[128,128],"filter":"linear-exact","background":[0,0,0,0]}})",
                      "test"),
      std::move(volume), rising(low + range / 4, low + 3 * range / 4, 0.6));
  gl::Context context = test_context();
  const auto with = [&](const std::vector<std::string>& keys) {
    const Scene before = scene.scene; // changed() would copy the volume
    std::vector<KeyValue> changes;
    for (const std::string& key : keys)
      changes.push_back(parse_assignment(key));
    scene.scene = scene_from_json(scene_to_json(before), "test", changes);
    prepare_again(scene);
    Image image = picture(scene, context);
    scene.scene = before;
    prepare_again(scene);
    return image;
  };
  // The body leaves the scanner's field through the top and bottom of the box, so some samples may flip there
  // (parity_test.cpp says why); the bar holds all the same.
  const Image slices = with({});
  const Image rays = with({"render.pipeline=rays"});
  CHECK(share_over(slices, rays, 1e-3) <= 1e-3);
  CHECK(psnr(rays, with({"render.pipeline=reference"})) >= 60);
  CHECK(psnr(slices, with({"render.pipeline=reference"})) >= 60);

  const std::string perspective = "camera.projection=perspective";
  const double decibels = psnr(with({perspective, "render.spacing=0.25"}),
                               with({perspective, "render.spacing=0.25", "render.pipeline=rays"}));
  INFO(decibels);
  CHECK(decibels >= 60);
}
