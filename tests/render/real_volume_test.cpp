// A real CT: 512×512×128 voxels of 16 bits, DICOM.
#include "catch.h"
#include "render_fixture.h"
#include "scene/load.h"
#include "scene/load_labels.h"
#include "volume/read.h"

#include <zlib.h>

#include <array>

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

namespace {

/// The bytes of a gzipped file after `skip` of them.
std::vector<std::uint8_t> gunzipped(const std::filesystem::path& file, std::size_t skip, std::size_t count) {
  std::vector<std::uint8_t> bytes(skip + count);
  gzFile in = gzopen(file.c_str(), "rb");
  const int got = gzread(in, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(in);
  REQUIRE(got == static_cast<int>(bytes.size()));
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(skip));
  return bytes;
}

} // namespace

TEST_CASE("a real RGB volume shows the very bytes of its file", "[one-driver]") {
  // CT perfusion maps of a head as a scanner's software coloured them, 256×286×15 voxels of RGB. Data begin
  // at byte 352, vox_offset of the header; i runs to the left and j to the front in LPS.
  const std::filesystem::path file = real_volumes() / "nifti_tricky" / "niivue" / "ct_perfusion.nii.gz";
  if (real_volumes().empty() || !std::filesystem::exists(file))
    SLICELENS_SKIP("nifti_tricky is not there (SLICELENS_VOLUMES names the folder of real volumes)");
  const std::vector<std::uint8_t> bytes = gunzipped(file, 352, std::size_t{3} * 256 * 286 * 15);
  // From below, one pixel a voxel, only the ninth slice left and everything opaque.
  Scene settings = scene_from_json(
      R"({"camera":{"elevation":-90},"crop":{"low":[0,0,0.5335],"high":[1,1,0.5999]},)"
      R"("transfer":{"points":[[0,1,1,1,1]]},)"
      R"("render":{"size":[256,286],"filter":"nearest","spacing":0.5,"background":[0,0,0,1]}})",
      "test");
  settings.volume.phantom.reset();
  settings.volume.file = file.string();
  settings.camera.parallel_scale = 0.5 * 286 * 0.78125;
  Volume volume = load_volume(settings.volume, {}, {});
  REQUIRE(volume.dims == std::array<std::size_t, 3>{256, 286, 15});
  TransferFunction transfer = transfer_of(settings, volume);
  const PreparedScene scene = prepare(settings, std::move(volume), std::move(transfer));
  gl::Context context = test_context();
  for (const char* pipeline : {"slices", "rays", "reference"}) {
    INFO(pipeline);
    const Image image = picture(changed(scene, {std::string("render.pipeline=") + pipeline}), context);
    double largest = 0;
    double coloured = 0;
    for (int y = 0; y < 286; ++y) {
      for (int x = 0; x < 256; ++x) {
        const std::size_t voxel = 3 * ((std::size_t{8} * 286 + static_cast<std::size_t>(285 - y)) * 256 +
                                       static_cast<std::size_t>(x));
        for (int c = 0; c < 3; ++c)
          largest = std::max(largest, std::abs(static_cast<double>(channel(image, x, y, c)) -
                                               bytes[voxel + static_cast<std::size_t>(c)] / 255.0));
        coloured += bytes[voxel] != bytes[voxel + 1] ? 1 : 0;
      }
    }
    CHECK(coloured > 10000); // the slice is one of colours
    CHECK(largest < 1e-6);   // opaque voxels of 8 bits, nearest: only floats of k/255
  }
}

TEST_CASE("a real brain in a real head, two-level: the labelled voxels are what is seen, by slices, rays and "
          "shells",
          "[one-driver]") {
  // MR of a head, 160×232×160 voxels of 1 × 0.8984 × 0.8984 mm as NIfTI in RAS, and a mask of its brain as
  // NRRD in LPS: the same voxels from two other ends.
  const std::filesystem::path folder = real_volumes() / "seg3d_brain";
  if (real_volumes().empty() || !std::filesystem::exists(folder))
    SLICELENS_SKIP("seg3d_brain is not there (SLICELENS_VOLUMES names the folder of real volumes)");
  Scene settings = scene_from_json(
      R"({"volume":{"phantom":"box","labels":"given below"},"camera":{"azimuth":30,"elevation":20},)"
      R"("transfer":{"points":[[40,0.9,0.7,0.6,0],[120,0.9,0.7,0.6,0.03]]},)"
      R"("render":{"size":[128,128],"filter":"linear-exact","background":[0,0,0,0]},)"
      R"("labels":[{"label":1,"transfer":{"points":[[100,1,0.3,0.2,0],[250,1,0.9,0.4,0.5]]}}]})",
      "test");
  settings.volume.phantom.reset();
  settings.volume.file = (folder / "MR.nii.gz").string();
  settings.volume.labels = (folder / "Brain.nrrd").string();
  Volume volume = load_volume(settings.volume, {}, {});
  TransferFunction transfer = transfer_of(settings, volume);
  std::optional<LoadedLabels> labels = load_labels(settings, volume, {}, {});
  REQUIRE(labels);
  double brain = 0; // mm³, straight from the file
  for (const std::byte voxel : labels->volume.voxels)
    brain += voxel == std::byte{1} ? 0.898437 * 0.898437 : 0;
  REQUIRE(brain > 5e5);
  const PreparedScene scene =
      prepare(settings, std::move(volume), std::move(transfer), {}, std::move(labels));
  gl::Context context = test_context();
  // A mist of one opacity in the brain and nothing elsewhere: −ln(1 − α) of a pixel is the way through the
  // brain, and ways times the pixels' area are its volume. 128² rays of 2 mm see 1 % of an outline of some
  // 10⁴ pixels.
  PreparedScene mist = scene;
  mist.transfer = constant_transfer({0, 0, 0, 0});
  mist.labels.loaded->transfers[0] = constant_transfer({1, 1, 1, 0.001});
  mist.labels.loaded->transfers[0]->unit_distance = 1;
  prepare_again(mist);
  for (const char* pipeline : {"slices", "rays"}) {
    const Image image = picture(changed(mist, {std::string("render.pipeline=") + pipeline}), context);
    double ways = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x)
        ways += std::log(1 - static_cast<double>(channel(image, x, y, 3))) / std::log(1 - 0.001);
    }
    const double pixel = 2 * mist.view.half_height / image.height;
    INFO(pipeline);
    CHECK(ways * pixel * pixel == Approx(brain).epsilon(0.01));
  }
  // From nearby, because the head leaves the box, on whose outline the rasteriser flips samples
  // (docs/tolerances.md).
  const auto by = [&](const std::string& pipeline, std::vector<std::string> keys) {
    keys.insert(keys.end(), {"camera.zoom=4", "render.pipeline=" + pipeline});
    return picture(changed(scene, keys), context);
  };
  const Image rays = by("rays", {});
  CHECK(share_over(by("slices", {}), rays, 1e-3) <= 1e-3);
  CHECK(psnr(rays, by("reference", {})) >= 55); // softpipe's own filter and light have this bar elsewhere
  CHECK(share_over(by("slices", {"labels[0].mode=mip"}), by("rays", {"labels[0].mode=mip"}), 1e-3) <= 1e-3);
  const std::string perspective = "camera.projection=perspective";
  CHECK(share_over(by("slices", {perspective, "render.proxy=shells"}), by("rays", {perspective}), 1e-3) <=
        1e-3);
}
