// Samples left out in modes that look between samples, at labels, or at voxels that are classified already;
// and under warps whose bounds are searched for. The bars are those of skip_test.cpp.
#include "render/pass_tiles.h"
#include "scene/load_labels.h"
#include "skip_fixture.h"

using namespace slicelens;

namespace {

const std::string leafer = R"(warp={"kind":"leafer"})";
const std::string volume_lens = R"(warp={"kind":"volume-lens","magnification":3})";
const std::string landmarks =
    R"(warp={"kind":"landmarks","space":"texture","resolution":24,"pairs":[[[0.3,0.3,0.3],[0.35,0.3,0.2]],
       [[0.7,0.4,0.5],[0.7,0.5,0.5]],[[0.5,0.8,0.6],[0.45,0.8,0.6]],[[0.2,0.6,0.9],[0.2,0.6,0.8]],
       [[0.8,0.8,0.2],[0.8,0.9,0.3]]]})";

std::vector<std::string> iso(double value, const std::vector<std::string>& more = {}) {
  return with({"render.mode=iso", "render.pipeline=rays", "render.isovalue=" + std::to_string(value)}, more);
}

/// Organs and their labels, some without a voxel that shows.
PreparedScene frog_scene() {
  Scene scene = scene_from_json(
      R"({"volume": {"phantom": "organs", "size": [48, 48, 24], "labels": "organs-labels"},
  "camera": {"azimuth": 35, "elevation": -40, "zoom": 1.5},
  "render": {"size": [80, 64], "background": [0, 0, 0, 0]},
  "labels": [{"label": 0, "visible": false},
    {"label": 1, "visible": false},
    {"label": 2, "visible": false},
    {"label": 3, "transfer": {"points": [[-1000, 1, 0.9, 0.7, 0.5]]}},
    {"label": 11, "transfer": {"points": [[90, 0.6, 0.2, 0.1, 0], [130, 0.6, 0.2, 0.1, 0.4]]}}]})",
      "test");
  Volume volume = load_volume(scene.volume, {}, {});
  TransferFunction transfer = transfer_of(scene, volume);
  std::optional<LoadedLabels> labels = load_labels(scene, volume, {}, {});
  return prepare(std::move(scene), std::move(volume), std::move(transfer), {}, std::move(labels));
}

/// Share of the tiles of all passes that something is drawn in.
double drawn_share(const PreparedScene& prepared) {
  const PassTiles tiles = tiles_of_passes(prepared, -40, 39);
  std::size_t count = 0;
  for (const PlaneSpan& span : tiles.spans)
    count += span.first <= span.last ? 1 : 0;
  return static_cast<double>(count) / static_cast<double>(tiles.spans.size());
}

} // namespace

TEST_CASE("skipping changes nothing: surfaces", "[one-driver]") {
  for (const double value : {-500.0, 250.0, 1500.0})
    check_skipping(head_scene(), iso(value), no_hidden);
  check_skipping(head_scene(), iso(250, {"render.shading=diffuse", "render.filter=cubic"}), no_hidden);
  check_skipping(head_scene(), iso(250, {"render.jitter=1", "render.spacing=0.5"}), no_hidden);
  check_skipping(head_scene(), iso(250, {twist}), no_hidden);
  check_skipping(head_scene(), iso(250, {leafer}), no_hidden);
  check_skipping(head_scene(), iso(250, {lens}), no_hidden);
  check_skipping(head_scene(),
                 iso(250, {fisheye, R"(clip=[{"point":[0.51,0.5,0.5],"normal":[-1,0.3,0.2]}])"}), no_hidden);
}

TEST_CASE("skipping keeps surfaces that samples step over", "[one-driver]") {
  // All below in one half, all above in the other: with steps longer than a cell neither of the two samples
  // beside the surface need lie in a cell that has it.
  const PreparedScene halves = small_scene(grey(1), [](int, int j, int) { return j < 12 ? 0 : 1000; });
  for (const std::string spacing : {"1", "5", "11", "23"})
    check_skipping(halves, iso(500, {"render.spacing=" + spacing}), no_hidden);
  // The surface of one voxel at the corner of a cell, and surfaces of the smallest and the largest value.
  const PreparedScene voxel =
      small_scene(grey(1), [](int i, int j, int k) { return i == 8 && j == 8 && k == 8 ? 1000 : 0; });
  check_skipping(voxel, iso(300, {"render.spacing=0.3"}), no_hidden);
  check_skipping(halves, iso(0), no_hidden);
  check_skipping(halves, iso(1000), no_hidden);
}

TEST_CASE("skipping changes nothing: segments") {
  check_skipping(head_scene(), {"render.classification=preintegrated"});
}

TEST_CASE("skipping changes nothing: segments under all functions, steps, warps that cut", "[one-driver]") {
  const std::string segments = "render.classification=preintegrated";
  check_functions({segments});
  check_functions({segments, "render.spacing=4", "render.shading=diffuse"});
  check_skipping(head_scene(), {segments, "render.pipeline=fragment", twist});
  check_skipping(head_scene(), {segments, "render.pipeline=fragment", leafer});
  check_skipping(head_scene(), {segments, "render.pipeline=axis", volume_lens});
  check_skipping(head_scene(), {segments, R"(clip=[{"point":[0.51,0.5,0.5],"normal":[-1,0.3,0.2]}])"},
                 outlines);
}

TEST_CASE("skipping changes nothing: segments of rays", "[one-driver]") {
  const std::vector<std::string> segments = {"render.classification=preintegrated", "render.pipeline=rays"};
  check_functions(segments);
  check_functions(with(segments, {"render.spacing=4", "render.shading=diffuse"}));
  check_skipping(head_scene(), with(segments, {leafer}));
  check_skipping(head_scene(), with(segments, {fisheye}));
}

TEST_CASE("skipping keeps what shows only between samples", "[one-driver]") {
  // A band that no voxel has, between two halves that show nothing: segments alone know it.
  const PreparedScene halves = small_scene(tent(500), [](int, int j, int) { return j < 12 ? 0 : 1000; });
  for (const std::string pipeline : {"slices", "rays"}) {
    for (const std::string spacing : {"1", "5", "11"}) {
      gl::Context context = test_context();
      const std::vector<std::string> keys = {"render.classification=preintegrated",
                                             "render.spacing=" + spacing, "render.pipeline=" + pipeline};
      CHECK(share_over(picture(changed(halves, keys), context), make_image(64, 48), 1e-3) > 0.05);
      check_skipping(halves, keys, outlines);
    }
  }
}

TEST_CASE("skipping changes nothing: voxels classified beforehand") {
  check_skipping(head_scene(), {"render.classification=pre", "render.opacity_correction=frame"});
  check_skipping(head_scene(), {"render.classification=pre", "render.opacity_correction=frame",
                                "render.pipeline=fragment", twist});
}

TEST_CASE("skipping changes nothing: labels") {
  check_skipping(frog_scene(), {"render.shading=phong", "render.filter=linear-exact"});
  check_skipping(frog_scene(), {"render.pipeline=fragment", twist}, outlines);
  CHECK(changed(frog_scene(), {"render.skip=empty"}).skipping.empty);
}

TEST_CASE("skipping changes nothing: labels, some of them as a whole", "[one-driver]") {
  check_skipping(frog_scene(), {"render.pipeline=rays"});
  for (const std::string mode : {"mip", "xray"}) {
    const std::vector<std::string> keys = {"render.pipeline=rays", "labels[3].mode=" + mode};
    check_skipping(frog_scene(), keys);
    check_skipping(frog_scene(), with(keys, {"labels[4].mode=mip", twist}));
  }
}

TEST_CASE("skipping changes nothing: maps of single axes, lenses that cut, landmarks, all grids",
          "[one-driver]") {
  const std::vector<std::vector<std::string>> warped = {
      {"render.pipeline=axis", fisheye},
      {"render.pipeline=axis", fisheye, "render.axis_filter=nearest", "render.axis_texels=16"},
      {"render.pipeline=axis", volume_lens, "render.axis_texels=32"},
      {"render.pipeline=axis", R"(warp={"kind":"connected-lens","magnification":3})",
       "render.axis_texels=32"},
      {"render.pipeline=axis", R"(warp={"kind":"bifocal"})", "render.axis_texels=32"},
      {"render.pipeline=fragment", R"(warp=[{"kind":"fisheye"},{"kind":"twist","axis":"z","angle":70}])"},
      {"render.pipeline=fragment", volume_lens},
      {"render.pipeline=fragment", landmarks},
      {"render.pipeline=grid", "render.grid_size=[24,24,24]", leafer},
      {"render.pipeline=grid", "render.grid_size=[8,9,10]", twist},
  };
  for (const std::vector<std::string>& keys : warped) {
    INFO(keys.back());
    // Where a warp cuts, and between texels that are not weighed, rounding decides what a sample looks at.
    check_skipping(head_scene(), keys, outlines);
  }
}

TEST_CASE("under every kind of bounds tiles are left out") {
  PreparedScene scene = head_scene();
  scene.transfer = rising(600, 1200, 1);
  const std::vector<std::string> skip = {"render.skip=empty"};
  const double plain = drawn_share(changed(scene, skip));
  CHECK(plain < 0.4); // bone fills a third of the 16-pixel tiles of 80 passes over 80 × 64 pixels
  // A fisheye shows the middle of the head four times as large and so fills two thirds of them; before bounds
  // were known all of the box was drawn.
  for (const std::vector<std::string>& keys : std::vector<std::vector<std::string>>{
           {"render.pipeline=axis", R"(warp={"kind":"bifocal"})"},
           {"render.pipeline=axis", fisheye},
           {"render.pipeline=axis", volume_lens},
           {"render.pipeline=fragment", R"(warp={"kind":"connected-lens"})"},
           {"render.pipeline=fragment", landmarks},
           {"render.pipeline=grid", twist}}) {
    INFO(keys.back());
    const double share = drawn_share(changed(scene, with(keys, skip)));
    CHECK(share > 0.5 * plain);
    CHECK(share < 0.75);
  }
}
