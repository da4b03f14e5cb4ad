// Pictures through a pool of bricks: the same as with the volume in one texture.
#include "catch.h"
#include "render_fixture.h"
#include "volume_fixture.h"

using namespace slicelens;

namespace {

/// 96³ texels of 2 bytes: 1.7 MiB, 216 pages of 16³ voxels, of which 1 MiB holds at most 90.
PreparedScene head_scene(const std::string& rest = "") {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[96,96,96]},"camera":{"azimuth":33,"elevation":21,"roll":10},
          "render":{"size":[96,96],"background":[0,0,0,0]})" +
          rest + "}",
      rising(100, 1500, 0.3));
}

struct Compared {
  double decibels = 0;
  PoolCounts pool;
};

Compared compared(const PreparedScene& head, std::vector<std::string> keys, gl::Context& context) {
  const Image whole = picture(changed(head, keys), context);
  keys.emplace_back("render.memory=1");
  keys.emplace_back("render.brick=16");
  const RenderResult paged = render(changed(head, keys), &context, {});
  REQUIRE(paged.pools.size() == 1);
  return {psnr(whole, paged.image), paged.pools[0]};
}

std::string text_of(const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys)
    text += key + " ";
  return text;
}

using Variants = std::vector<std::vector<std::string>>;

/// In parts, or there is nothing to be seen at their borders.
void check_no_seam(const PreparedScene& head, const Variants& variants, gl::Context& context) {
  for (const auto& keys : variants) {
    const Compared result = compared(head, keys, context);
    INFO(text_of(keys) << ": " << result.decibels << " dB, " << result.pool.parts << " parts");
    // Coordinates in the pool round differently: 85 (8-bit targets) to 160 dB; an overlap of one voxel too
    // few gives less than 60, a page too few less than 40.
    CHECK(result.decibels >= 80);
    const std::string text = text_of(keys);
    const bool needs_few = text.find("levels") != text.npos || text.find("clip") != text.npos;
    CHECK((result.pool.parts > 1 || needs_few));
    CHECK(result.pool.capacity < result.pool.pages);
  }
}

} // namespace

TEST_CASE("bricks leave no seam in slices of any mode, filter and light", "[one-driver]") {
  gl::Context context = test_context();
  check_no_seam(head_scene(),
                {{},
                 {"render.order=front-to-back"},
                 {"camera.projection=perspective"},
                 {"render.filter=nearest"},
                 {"render.filter=linear-exact"},
                 {"render.filter=cubic"},
                 {"render.shading=diffuse"},
                 {"render.shading=diffuse", "render.gradient=forward"},
                 {"render.shading=phong", "render.filter=cubic", "camera.projection=perspective"},
                 {"render.modulate_by_gradient=20"},
                 {"render.mode=mip"},
                 {"render.mode=minip"},
                 {"render.mode=average"},
                 {"render.mode=xray"},
                 {"render.mode=iso", "render.shading=diffuse"},
                 {"render.classification=pre"},
                 {"render.classification=preintegrated"},
                 {"camera.projection=perspective", "render.proxy=shells"},
                 {"render.jitter=1"},
                 {"render.target=rgba8"},
                 {"render.spacing=2.7"},
                 {"render.planes_per_pass=16"},
                 {"render.planes_per_pass=16", "render.skip=empty"},
                 {"render.skip=empty+hidden", "render.order=front-to-back"},
                 {R"(clip=[{"point":[0.5,0.4,0.5],"normal":[0.2,1,0.1]}])"}},
                context);
}

TEST_CASE("bricks leave no seam in rays of any mode", "[one-driver]") {
  gl::Context context = test_context();
  check_no_seam(head_scene(R"(,"warp":[])"),
                {{"render.pipeline=rays"},
                 {"render.pipeline=rays", "camera.projection=perspective"},
                 {"render.pipeline=rays", "render.shading=diffuse", "render.filter=cubic"},
                 {"render.pipeline=rays", "render.mode=mip"},
                 {"render.pipeline=rays", "render.mode=mip", "camera.projection=perspective"},
                 {"render.pipeline=rays", "render.mode=minip"},
                 {"render.pipeline=rays", "render.mode=average"},
                 {"render.pipeline=rays", "render.mode=xray"},
                 {"render.pipeline=rays", "render.mode=iso", "render.shading=diffuse"},
                 {"render.pipeline=rays", "render.classification=preintegrated"},
                 {"render.pipeline=rays", "render.classification=pre"},
                 {"render.pipeline=rays", "render.jitter=1"},
                 {"render.pipeline=rays", "render.skip=empty"}},
                context);
}

TEST_CASE("bricks leave no seam under warps", "[one-driver]") {
  gl::Context context = test_context();
  const std::string lens = R"(,"warp":{"kind":"lamar","zoom":3,"inner":0.12,"outer":0.22})";
  check_no_seam(head_scene(lens),
                {{"render.pipeline=tessellated"},
                 {"render.pipeline=tessellated", "camera.projection=perspective", "render.shading=diffuse"},
                 {"render.pipeline=fragment"},
                 {"render.pipeline=rays"},
                 {"render.pipeline=rays", "render.mode=mip"},
                 {"render.pipeline=tessellated", "render.levels=3"},
                 {"render.pipeline=fragment", "render.levels=3"},
                 {"render.pipeline=rays", "render.levels=3", "camera.projection=perspective"}},
                context);
  check_no_seam(head_scene(R"(,"warp":{"kind":"twist","angle":60})"),
                {{"render.pipeline=fragment"},
                 {"render.pipeline=tessellated"},
                 {"render.pipeline=rays"},
                 {"render.pipeline=rays", "render.shading=diffuse", "render.gradient_space=data"}},
                context);
  check_no_seam(head_scene(R"(,"warp":[{"kind":"bend","angle":40},{"kind":"sine","amplitude":0.05}])"),
                {{"render.pipeline=fragment"}, {"render.pipeline=rays"}}, context);
}

TEST_CASE("bricks of labels lie beside those of values", "[one-driver]") {
  gl::Context context = test_context();
  Scene scene = scene_from_json(
      R"({"volume":{"phantom":"organs","size":[112,112,56],"labels":"organs-labels"},
          "render":{"mode":"two-level","size":[96,96]},"camera":{"azimuth":20},
          "labels":[{"label":1,"mode":"mip"},{"label":2,"mode":"dvr"}]})",
      "test");
  LoadedLabels labels;
  labels.volume = make_phantom("organs-labels", {112, 112, 56});
  labels.transfers.resize(2);
  const PreparedScene organs =
      prepare(scene, make_phantom("organs", {112, 112, 56}), rising(-100, 400, 0.2), {}, std::move(labels));
  for (const std::vector<std::string>& keys : Variants{{}, {"render.order=front-to-back"}}) {
    const Compared result = compared(organs, keys, context);
    INFO(result.decibels << " dB");
    CHECK(result.decibels >= 80);
    CHECK(result.pool.parts > 1);
  }
  // A ray's run through an object cannot be cut.
  CHECK_THROWS_WITH(compared(organs, {"render.pipeline=rays"}, context), Catch::Contains("render.memory"));
}

TEST_CASE("each of several volumes has a pool of its own", "[one-driver]") {
  gl::Context context = test_context();
  const auto drawn = [&](const std::vector<std::string>& keys) {
    Scene scene = scene_from_json(
        R"({"volumes":[{"phantom":"head","size":[96,96,96]},
                       {"phantom":"engine","size":[32,32,16],"placement":{"scale":1.5}}],
            "render":{"size":[96,96]},"camera":{"azimuth":33,"elevation":21}})",
        "test");
    std::vector<LoadedVolume> others(1);
    others[0].volume = make_phantom("engine", {32, 32, 16});
    others[0].transfer = rising(60, 200, 0.2);
    return render(
        changed(prepare(scene, make_phantom("head", {96, 96, 96}), rising(100, 1500, 0.3), std::move(others)),
                keys),
        &context, {});
  };
  for (const std::string pipeline : {"slices", "rays"}) {
    for (const std::string mode : {"dvr", "mip"}) {
      const std::vector<std::string> keys = {"render.pipeline=" + pipeline, "render.mode=" + mode};
      std::vector<std::string> paged = keys;
      paged.insert(paged.end(), {"render.memory=1", "render.brick=16"});
      const RenderResult result = drawn(paged);
      REQUIRE(result.pools.size() == 1); // the engine fits its texture
      CHECK(result.pools[0].parts > 1);
      INFO(pipeline << " " << mode);
      CHECK(psnr(drawn(keys).image, result.image) >= 80);
    }
  }
}

TEST_CASE("bricks agree on every driver where the filter is the shader's") {
  gl::Context context = test_context();
  check_no_seam(head_scene(), {{"render.filter=linear-exact"}, {"render.filter=nearest", "render.mode=mip"}},
                context);
}

TEST_CASE("a picture where one slice needs more bricks than there are is drawn in bands", "[one-driver]") {
  gl::Context context = test_context();
  const PreparedScene large =
      prepare(scene_from_json(R"({"render":{"size":[96,96]}})", "test"),
              volume_of(ScalarType::f32, {144, 16, 144},
                        [](int i, int j, int k) { return std::sin(0.3 * i) + std::cos(0.2 * k) + 0.1 * j; }),
              rising(-1, 2, 0.2));
  const RenderResult bands = render(changed(large, {"render.memory=1", "render.brick=16"}), &context, {});
  REQUIRE(bands.pools.size() == 1);
  // All 81 pages are at one depth, so every slice needs them all: more than the pool's 44.
  CHECK(bands.pools[0].pages == 81);
  CHECK(bands.pools[0].capacity < 81);
  CHECK(bands.pools[0].parts >= 2);
  CHECK(psnr(picture(large, context), bands.image) >= 80);
}
