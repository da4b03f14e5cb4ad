// Several resolutions through a lens: which level is read where, and what it holds.
#include "catch.h"
#include "render/bricks.h"
#include "render_fixture.h"
#include "volume/pyramid.h"
#include "volume_fixture.h"

using namespace slicelens;

namespace {

const std::vector<std::string> warped = {"tessellated", "fragment", "rays", "reference"};

/// A lens as deep as the volume, so that a pixel's whole ray is in one region.
PreparedScene lens_scene(const std::string& more = "") {
  TransferFunction transfer = rising(100, 1500, 0.3);
  transfer.unit_distance = 4; // a voxel's length, whatever the level
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[64,64,64]},"camera":{"azimuth":20,"elevation":10},
          "warp":{"kind":"lamar","zoom":4,"center":[0.5,0.5,0.5],"inner":0.15,"outer":0.3,"depth_inner":3,
                  "depth_outer":4,"angular_segments":64},
          "render":{"levels":3,"size":[96,96],"filter":"linear-exact","background":[0,0,0,0]})" +
          more + "}",
      std::move(transfer));
}

/// Distance of a pixel from the picture's middle (the lens axis) in units of the box's longest edge.
double radius_of(const PreparedScene& scene, int x, int y) {
  const View& view = scene.view;
  const double unit = 2 * view.half_height / view.height / scene.space.longest;
  return unit * std::hypot(x + 0.5 - view.width / 2.0, y + 0.5 - view.height / 2.0);
}

double largest_where(const Image& a, const Image& b, const std::function<bool(int, int)>& take) {
  double largest = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      for (int c = 0; c < 4 && take(x, y); ++c)
        largest = std::max(largest, static_cast<double>(std::abs(channel(a, x, y, c) - channel(b, x, y, c))));
    }
  }
  return largest;
}

} // namespace

TEST_CASE("a coarser level holds means of pairs, any size, centres in place") {
  const Volume volume = volume_of(ScalarType::u8, {5, 2, 1}, [](int i, int j, int) { return 10 * i + j; });
  const Volume half = half_size(volume);
  CHECK(half.dims == std::array<std::size_t, 3>{3, 1, 1});
  CHECK(value_at(half, 0, 0, 0) == 5.5);  // (0 + 10 + 1 + 11)/4
  CHECK(value_at(half, 1, 0, 0) == 25.5); // (20 + 30 + 21 + 31)/4
  CHECK(value_at(half, 2, 0, 0) == 40.5); // voxel 4 alone: (40 + 41)/2
  CHECK(half.min == volume.min);
  CHECK(half.max == volume.max);
  // Its first voxel's centre lies between those of the voxels it stands for.
  CHECK(glm::length(half.origin - (volume.origin + glm::dvec3(0.5, 0.5, 0.5))) < 1e-15);
  CHECK(half.spacing == glm::dvec3(2));
  CHECK(level_dims({256, 9, 1}, 3) == std::array<std::size_t, 3>{32, 2, 1});
  const Volume part = crop(volume, {1, 1, 0}, {3, 1, 1});
  CHECK(value_at(part, 0, 0, 0) == 11);
  CHECK(value_at(part, 2, 0, 0) == 31);
  CHECK_THROWS_AS(crop(volume, {3, 0, 0}, {3, 1, 1}), UsageError);
}

TEST_CASE("the level falls with the logarithm of the magnification, from the coarsest to 0") {
  const double log_zoom = std::log(4.0);
  CHECK(level_of(1, 2, log_zoom) == 2);
  CHECK(level_of(4, 2, log_zoom) == 0);
  CHECK(level_of(2, 2, log_zoom) == Approx(1).epsilon(1e-12)); // half of the logarithm
  CHECK(level_of(0.5, 2, log_zoom) == 2);                      // minified: still the coarsest
  CHECK(level_of(9, 2, log_zoom) == 0);
  CHECK(level_of(1 + 1e-6, 2, log_zoom) == 2); // the band that takes up the rounding of q
  CHECK(level_of(4 * (1 - 1e-6), 2, log_zoom) == 0);
  CHECK(level_of(1, 2, 0) == 2); // no lens
  double last = 2;
  for (int i = 0; i <= 10000; ++i) {
    const double level = level_of(1 + 3.0 * i / 10000, 2, log_zoom);
    CHECK(level <= last);
    // Slope (L−1)(1 + 2·band)/ln Q per ln q, and ln q advances by at most 3/10000.
    CHECK(last - level <= 2 * (1 + 2.0 / 1024) / log_zoom * 3e-4 + 1e-12);
    last = level;
  }
}

TEST_CASE("textures hold the coarsest level whole and finer ones where the lens looks") {
  const Volume volume = volume_of(ScalarType::f32, {64, 64, 64}, [](int i, int, int) { return i; });
  const Scene scene = scene_from_json(
      R"({"warp":{"kind":"lamar","shape":"square","border":"linear","zoom":4,"inner":0.125,"outer":0.25},
          "render":{"levels":2,"size":[16,16]}})",
      "test");
  // The default camera looks along y, so the lens' cube is [¼, ¾]³: voxel units 16 to 48, with the margin 15
  // to 49, for which linear interpolation reads voxels ⌊14.5⌋ = 14 to ⌈48.5⌉ = 49. The level's band takes
  // 0.05 voxels off, which rounds away.
  const PreparedScene prepared = prepare(scene, volume, grey(0.1));
  const BrickPlan plan = plan_bricks(prepared);
  REQUIRE(plan.bricks.size() == 2);
  CHECK(plan.bricks[0].level == 1);
  CHECK(plan.bricks[0].size == std::array<std::size_t, 3>{32, 32, 32});
  CHECK(plan.bricks[1].level == 0);
  CHECK(plan.bricks[1].first == std::array<std::size_t, 3>{14, 14, 14});
  CHECK(plan.bricks[1].size == std::array<std::size_t, 3>{36, 36, 36});
  gl::Context context = test_context();
  const RenderResult result = render(prepared, &context, {});
  const std::size_t voxels = 32 * 32 * 32 + 36 * 36 * 36;
  CHECK(result.whole_texture_bytes - result.texture_bytes == 4 * (64 * 64 * 64 - voxels));
}

TEST_CASE("constant and linear volumes look the same at every level") {
  gl::Context context = test_context();
  for (const bool ramp : {false, true}) {
    // 45 voxels: odd at two levels. Clipped away from the edges, where means are one-sided, by more than the
    // four voxels that a gradient at level 2 reaches.
    Volume volume = volume_of(ScalarType::f32, {45, 45, 45},
                              [&](int i, int j, int k) { return ramp ? i + 0.5 * j - 0.25 * k : 3.0; });
    volume.min = ramp ? -11 : 0;
    volume.max = 66;
    const PreparedScene scene = prepare(
        scene_from_json(
            R"({"warp":{"kind":"lamar","zoom":3,"inner":0.2,"outer":0.35},"camera":{"azimuth":20,"elevation":10},
                "clip":[{"point":[0.3,0.3,0.3],"normal":[1,0,0]},{"point":[0.3,0.3,0.3],"normal":[0,1,0]},
                        {"point":[0.3,0.3,0.3],"normal":[0,0,1]},{"point":[0.7,0.7,0.7],"normal":[-1,0,0]},
                        {"point":[0.7,0.7,0.7],"normal":[0,-1,0]},{"point":[0.7,0.7,0.7],"normal":[0,0,-1]}],
                "render":{"size":[48,48],"filter":"linear-exact","shading":"diffuse"}})",
            "test"),
        std::move(volume), rising(-11, 66, 0.1));
    for (const std::string& pipeline : warped) {
      const PreparedScene one = changed(scene, {"render.pipeline=" + pipeline});
      const double largest =
          max_difference(picture(one, context), picture(changed(one, {"render.levels=3"}), context));
      INFO(pipeline << (ramp ? ", ramp: " : ", constant: ") << largest);
      CHECK(largest < 2e-5); // float rounding of the values, summed over 60 samples
    }
  }
}

TEST_CASE("the zoom region is of full resolution, what is outside the lens of the coarsest", "[one-driver]") {
  gl::Context context = test_context();
  const PreparedScene levels = lens_scene();
  const PreparedScene full = changed(levels, {"render.levels=1"});
  // The coarse volume by itself: its voxels are four times as long, so a quarter of the spacing is as far.
  Scene plain = scene_from_json(scene_to_json(levels.scene), "test",
                                {parse_assignment("render.levels=1"), parse_assignment("render.spacing=0.25"),
                                 parse_assignment("warp=[]"), parse_assignment("render.pipeline=slices")});
  const PreparedScene coarse = prepare(plain, half_size(half_size(levels.volume)), levels.transfer);
  for (const std::string shading : {"none", "diffuse"}) {
    const std::string key = "render.shading=" + shading;
    const Image coarse_picture = picture(changed(coarse, {key}), context);
    for (const std::string& pipeline : warped) {
      const std::vector<std::string> keys = {key, "render.pipeline=" + pipeline};
      const Image seen = picture(changed(levels, keys), context);
      const Image fine = picture(changed(full, keys), context);
      const double inside =
          largest_where(seen, fine, [&](int x, int y) { return radius_of(levels, x, y) < 0.145; });
      const double outside =
          largest_where(seen, coarse_picture, [&](int x, int y) { return radius_of(levels, x, y) > 0.305; });
      const double between = largest_where(
          seen, fine, [&](int x, int y) { return std::abs(radius_of(levels, x, y) - 0.28) < 0.02; });
      INFO(pipeline << ", shading " << shading << ": inside " << inside << ", outside " << outside);
      CHECK(inside < 1e-3);
      // Coarse levels are coded over the volume's range in 16 bits, here as floats: rounding, and the sign of
      // near-zero gradients.
      CHECK(outside < 5e-3);
      CHECK(between > 1e-2); // the levels do something
    }
  }
}

TEST_CASE("pipelines agree about levels", "[one-driver]") {
  gl::Context context = test_context();
  for (const std::string shading : {"none", "diffuse"}) {
    const PreparedScene scene =
        changed(lens_scene(), {"warp.depth_inner=0.15", "warp.depth_outer=0.3", "render.shading=" + shading});
    const Image truth = picture(changed(scene, {"render.pipeline=reference"}), context);
    const Image fragment = picture(changed(scene, {"render.pipeline=fragment"}), context);
    const Image rays = picture(changed(scene, {"render.pipeline=rays"}), context);
    const Image mesh = picture(changed(scene, {"render.pipeline=tessellated", "warp.radial_segments=64",
                                               "warp.angular_segments=128"}),
                               context);
    INFO(shading << ": fragment " << psnr(fragment, truth) << ", rays " << psnr(rays, truth)
                 << ", tessellated against fragment " << psnr(mesh, fragment) << " dB");
    CHECK(psnr(fragment, truth) >= 60);
    CHECK(psnr(rays, truth) >= 60);
    CHECK(psnr(mesh, fragment) >= 45);
  }
}
