// Where a file's axes point decides where its voxels are drawn: one brain in several orders of axes is one
// picture.
#include "catch.h"
#include "render_fixture.h"
#include "volume/read.h"

#include <cstring>
#include <limits>

using namespace slicelens;

namespace {

PreparedScene brain_of(const std::filesystem::path& file) {
  VolumeSource source;
  source.file = file;
  return prepare(
      scene_from_json(R"({"render":{"size":[128,128],"mode":"mip","filter":"linear-exact"}})", "test"),
      read_volume(source), rising(0, 92, 1));
}

/// Pixels of the marks, which are the brightest thing by far, in the left half and the right half.
std::pair<int, int> marked_pixels(const Image& image) {
  std::pair<int, int> count{0, 0};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (channel(image, x, y, 0) > 0.9F)
        ++(x < image.width / 2 ? count.first : count.second);
    }
  }
  return count;
}

} // namespace

TEST_CASE("a brain in six orders of axes is one picture, its R and L on their sides", "[one-driver]") {
  const std::filesystem::path folder = real_volumes() / "nifti_tricky" / "orientations_12";
  if (real_volumes().empty() || !std::filesystem::exists(folder))
    SLICELENS_SKIP("orientations_12 is not there (SLICELENS_VOLUMES names the folder of real volumes)");
  gl::Context context = test_context();
  const std::vector<std::vector<std::string>> cameras = {
      {}, {"camera.elevation=90"}, {"camera.azimuth=40", "camera.elevation=25"}};
  std::vector<Image> first;
  for (const char* name : {"RAS", "LAS", "LPS", "RPI", "AIR", "ASL"}) {
    const PreparedScene scene = brain_of(folder / (std::string(name) + ".nii.gz"));
    for (std::size_t k = 0; k < cameras.size(); ++k) {
      CAPTURE(name, k);
      const Image image = picture(changed(scene, cameras[k]), context);
      if (first.size() < cameras.size())
        first.push_back(image);
      const double decibels = psnr(first[k], image);
      INFO(decibels);
      // The same voxels in another order: only the rounding of their places differs.
      CHECK(decibels >= 35);
      if (k != 1)
        continue;
      // From above with the face at the bottom, the patient's right is at the left. An R has more strokes
      // than an L.
      const auto [left, right] = marked_pixels(image);
      CAPTURE(left, right);
      CHECK(right > 100);
      CHECK(left > 1.2 * right);
    }
  }
}

TEST_CASE("voxels without a value show nothing, whatever the smallest value shows") {
  // 8³ voxels of value 1 with a hole of NaN through the middle, seen along it. The background is transparent
  // black.
  Volume volume;
  volume.dims = {8, 8, 8};
  volume.type = ScalarType::f32;
  std::vector<float> values(512, 1.0F);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t x = i % 8;
    const std::size_t z = i / 64;
    if (x >= 3 && x < 5 && z >= 3 && z < 5)
      values[i] =
          i % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
  }
  volume.voxels.resize(values.size() * sizeof(float));
  std::memcpy(volume.voxels.data(), values.data(), volume.voxels.size());
  update_statistics(volume);
  REQUIRE(volume.non_finite == 32);
  const Scene scene = scene_from_json(
      R"({"render":{"size":[64,64],"filter":"nearest","background":[0,0,0,0]},"camera":{"parallel_scale":4}})",
      "test");
  // The volume's one value is opaque; only values below it are empty.
  const PreparedScene prepared = prepare(scene, volume, step_transfer(0.5, {0, 0, 0, 0}, {1, 1, 1, 0.9}));
  CHECK(prepared.volume.non_finite == 0);
  gl::Context context = test_context();
  for (const char* pipeline : {"slices", "rays", "reference"}) {
    CAPTURE(pipeline);
    const Image image = picture(changed(prepared, {std::string("render.pipeline=") + pipeline}), context);
    // The box fills the picture: 8 pixels a voxel. The hole is [24, 40) in both directions.
    CHECK(channel(image, 32, 32, 3) == 0);
    CHECK(channel(image, 25, 38, 3) == 0);
    CHECK(channel(image, 22, 32, 3) > 0.99F);
    CHECK(channel(image, 32, 42, 3) > 0.99F);
  }
}
