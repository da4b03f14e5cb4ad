// What deformations do to a volume, against cases worked by hand. The volume is a cube of 32³ voxels (or 32 ×
// 16 × 32), which the default camera sees along y in a square picture: √3 of the cube's edge high and wide
// (parallel scale: half the diagonal), so the cube's own outline is a third of the picture.
#include "catch.h"
#include "core/errors.h"
#include "scene/scene_json.h"
#include "study/lens_metrics.h"
#include "volume/phantom.h"

#include <cmath>
#include <numbers>

using namespace slicelens;
using glm::dvec3;

namespace {

constexpr double pi = std::numbers::pi;

PreparedScene scene(const std::string& warp, const std::string& more = "",
                    const std::array<std::size_t, 3>& dims = {32, 32, 32}) {
  return prepare(
      scene_from_json(R"({"warp":)" + warp + R"(,"render":{"size":[256,256]})" + more + "}", "test"),
      make_phantom("ball", dims), TransferFunction{});
}

double metric(const std::string& name, const PreparedScene& prepared) {
  const auto measured = measure_lens({name}, prepared);
  REQUIRE(measured.size() == 1);
  REQUIRE(measured[0].second);
  return *measured[0].second;
}

} // namespace

TEST_CASE("without a warp nothing is magnified, folded or torn") {
  const PreparedScene plain = scene("[]");
  const std::vector<std::pair<std::string, double>> expected = {{"magnification", 1},
                                                                {"magnification_max", 1},
                                                                {"magnification_volume", 1},
                                                                {"magnification_volume_max", 1},
                                                                {"fold_over", 0},
                                                                {"jacobian_min", 1},
                                                                {"samples_per_voxel", 1},
                                                                {"focus_share", 0}};
  for (const auto& [name, value] : expected) {
    CAPTURE(name);
    CHECK(metric(name, plain) == Approx(value).margin(1e-12));
  }
  CHECK(metric("jump", plain) < 1.01e-7);     // what the identity moves between two points 1e-7 apart
  CHECK(fold_over(plain, 10).points == 1001); // the grid's and the focus
  CHECK(displayed_focus(plain) == dvec3(0.5));
}

TEST_CASE("LaMar's circular lens of zoom 4 magnifies 4 times across the view and not along it") {
  const std::string lens =
      R"({"kind":"lamar","zoom":4,"inner":0.3,"outer":0.4,"depth_inner":0.3,"depth_outer":0.4})";
  const PreparedScene prepared = scene(lens);
  CHECK(metric("magnification", prepared) == Approx(4));
  CHECK(metric("magnification_volume", prepared) == Approx(std::cbrt(16.0)));
  // The border's slope only grows from 1/4 (the chord's is (.4 − .075)/.1), so nothing is larger.
  CHECK(metric("magnification_max", prepared) == Approx(4));
  CHECK(metric("magnification_volume_max", prepared) == Approx(std::cbrt(16.0)));
  CHECK(metric("fold_over", prepared) == 0);
  CHECK(metric("jacobian_min", prepared) == Approx(1.0 / 16));
  // No slope in the border exceeds 3/2 · 3.25 across plus the change along the depth of r·15/.4.
  CHECK(metric("jump", prepared) < 3e-6);
  CHECK(metric("samples_per_voxel", prepared) == Approx(1)); // slices lie where they lay
  // A circle of radius .3 of 256/√3 pixels: 44. Points on a grid miss its area by some of the 280 on its rim.
  CHECK(metric("focus_share", prepared) == Approx(pi * 0.09 / 3).epsilon(0.01));
  const PreparedScene square = scene(
      R"({"kind":"lamar","shape":"square","zoom":2,"inner":0.3,"outer":0.4,"depth_inner":0.3,"depth_outer":0.4})");
  CHECK(metric("magnification", square) == Approx(2));
  CHECK(metric("focus_share", square) == Approx(0.36 / 3).epsilon(0.02));
  // In perspective the lens is still one circle: radius .3 at the distance (√3/2)/sin 15° of the eye, where
  // the picture's half height is that times tan 15°.
  const double half = std::sqrt(0.75) / std::cos(pi / 12);
  const PreparedScene perspective = scene(lens, R"(,"camera":{"projection":"perspective"})");
  CHECK(metric("magnification", perspective) == Approx(4));
  CHECK(metric("focus_share", perspective) == Approx(pi * 0.09 / (4 * half * half)).epsilon(0.01));
}

TEST_CASE("a fisheye of distortion 3") {
  const PreparedScene prepared = scene(R"({"kind":"fisheye","distortion":3})");
  // u' = 4/(4 − 3g)² on each axis, g the distance from the middle as a share of the half edge: 1/4 at g = 0.
  CHECK(metric("magnification", prepared) == Approx(4));
  CHECK(metric("magnification_volume", prepared) == Approx(4));
  CHECK(metric("samples_per_voxel", prepared) == Approx(4));
  CHECK(metric("jacobian_min", prepared) == Approx(1.0 / 64));
  CHECK(metric("magnification_max", prepared) ==
        Approx(4)); // at the focus: the grid's nearest points have 3.9
  CHECK(metric("fold_over", prepared) == 0);
  // Magnified is where (4 − 3g_x)(4 − 3g_z) > 4: ∫(4 − 4/(4 − 3g))/3 dg = 4/3 − 4/9·ln 4 of the cube's face.
  CHECK(metric("focus_share", prepared) == Approx((4.0 / 3 - 4.0 / 9 * std::log(4.0)) / 3).epsilon(0.01));
}

TEST_CASE("the bifocal display magnifies its box by the ratio of its edges") {
  const PreparedScene prepared = scene(R"({"kind":"bifocal"})"); // .4 to .6 shown in .25 to .75
  for (const char* name : {"magnification", "magnification_max", "magnification_volume", "samples_per_voxel"})
    CHECK(metric(name, prepared) == Approx(2.5));
  CHECK(metric("jacobian_min", prepared) == Approx(std::pow(0.4, 3)));
  CHECK(metric("focus_share", prepared) == Approx(0.25 / 3).epsilon(0.02));
}

TEST_CASE("a twist keeps every volume") {
  const PreparedScene prepared = scene(R"({"kind":"twist","angle":90})");
  CHECK(metric("jacobian_min", prepared) == Approx(1));
  CHECK(metric("magnification_volume_max", prepared) == Approx(1));
  CHECK(metric("magnification", prepared) == Approx(1));
  // Seen across its axis the unit square shows √(1 + (angle·x)²) ≥ 1 of the data: never larger than it is.
  CHECK(metric("magnification_max", prepared) <= 1 + 1e-12);
  CHECK(metric("magnification_max", prepared) > 0.99);
  CHECK(metric("fold_over", prepared) == 0);
  CHECK(metric("focus_share", prepared) == 0);
}

TEST_CASE("Cohen's lens tears where the connected lens does not") {
  const std::string box = R"("center":[0.5,0.5,0.5],"inner":0.1,"outer":0.25,"magnification":2})";
  const PreparedScene torn = scene(R"({"kind":"volume-lens",)" + box);
  const PreparedScene whole = scene(R"({"kind":"connected-lens",)" + box);
  // Offsets of two axes, (1 − 1/m)(δ − oτ²) with δ = i + (o − i)τ, are largest at τ = (o − i)/(2o) = .3: δ =
  // .145, ½(.145 − .0225) = .06125. Lines 1/31 apart miss that place by at most half, where the offset's
  // curvature 2o/(o − i)²·½ takes 11·(1/62)² = .003 of each at most.
  const double largest = std::sqrt(2.0) * 0.06125;
  CHECK(metric("jump", torn) <= largest + 1e-6);
  CHECK(metric("jump", torn) > 0.95 * largest);
  CHECK(metric("jump", whole) < 1e-6);
  CHECK(metric("magnification", torn) == Approx(2));
  CHECK(metric("magnification", whole) == Approx(2));
  // Of two cells on each axis the middles lie at 1/4 and 3/4: on the corners of the lens' box, its cuts.
  const FoldOver on_cuts = fold_over(torn, 2);
  CHECK(on_cuts.near_cuts == 8);
  CHECK(on_cuts.points == 1); // the focus
  CHECK(on_cuts.fraction() == 0);
  CHECK(on_cuts.jacobian_min == Approx(1.0 / 8));
  CHECK(fold_over(whole, 2).points == 9);
}

TEST_CASE("a fold is found, with its share of the volume") {
  // No scene may ask for it: a linear border that falls from .36 to .2, slope −2, between radius .12 and .2.
  PreparedScene prepared = scene("[]");
  LamarLens lens;
  lens.border = LensBorder::linear;
  LamarMap map = lamar_map(lens, prepared.space, prepared.warp_view);
  map.minification = 3;
  map.depth_inner = 1;
  map.depth_outer = 2;
  prepared.maps = {map};
  const FoldOver folds = fold_over(prepared);
  CHECK(folds.fraction() == Approx(pi * (0.04 - 0.0144)).epsilon(0.03)); // 330 cells across, its rims 130
  // det J = −2·f/r: −6 at the inner rim; cells lie up to 1/64 from it, where f/r has lost (.03/.12 +
  // .03/.36).
  CHECK(folds.jacobian_min > -6);
  CHECK(folds.jacobian_min < -5.3);
}

TEST_CASE("no warp of a scene's own defaults folds, and only declared cuts tear") {
  for (const WarpInfo& info : warp_infos()) {
    if (info.kind == "landmarks" || info.kind == "field")
      continue; // these need points or a file
    CAPTURE(info.kind);
    const PreparedScene prepared = scene(R"({"kind":")" + info.kind + "\"}");
    for (const auto& [name, value] : measure_lens(lens_metric_names(), prepared)) {
      CAPTURE(name);
      // Only a cut can hide the focus: the middle of an opened ball shows nothing.
      CHECK((value.has_value() || has_cuts(prepared.maps[0])));
    }
    CHECK(metric("fold_over", prepared) == 0);
    CHECK(metric("jacobian_min", prepared) > 0);
    // No default has a slope of 100; 1e-7 apart that makes 1e-5.
    if (has_cuts(prepared.maps[0]) && info.kind != "bend") // the bend's cut lies behind the volume
      CHECK(metric("jump", prepared) > 0.01);
    else
      CHECK(metric("jump", prepared) < 1e-5);
  }
}

TEST_CASE("the focus goes where later warps carry it") {
  const std::string lens = R"({"kind":"lamar","zoom":4,"inner":0.2,"outer":0.3})";
  const PreparedScene moved = scene("[" + lens + R"(,{"kind":"shift","offset":[0.1,0,0]}])");
  const dvec3 focus = displayed_focus(moved);
  CHECK(focus.x == Approx(0.6));
  CHECK(focus.y == Approx(0.5));
  CHECK(metric("magnification", moved) == Approx(4));
  CHECK(metric("focus_share", moved) == Approx(pi * 0.04 / 3).epsilon(0.02));
  // Carried to the picture's edge, √3/2 above the middle, half of it is seen.
  const PreparedScene edge = scene("[" + lens + R"(,{"kind":"shift","offset":[0,0,0.8660254]}])");
  CHECK(metric("focus_share", edge) == Approx(pi * 0.04 / 6).epsilon(0.03));
  // of two lenses the last
  const PreparedScene two =
      scene("[" + lens + R"(,{"kind":"lamar","zoom":2,"inner":0.04,"outer":0.08,"center":[0.1,0.5,0.5]}])");
  CHECK(displayed_focus(two).x == Approx(0.1));
  // the sphere of a pulse, magnified twice at its centre
  const PreparedScene pulse = scene(R"({"kind":"pulse","radius":0.4,"magnification":2})");
  CHECK(metric("magnification", pulse) == Approx(2));
  CHECK(metric("magnification_volume", pulse) == Approx(2));
  CHECK(metric("focus_share", pulse) == Approx(pi * 0.16 / 3).epsilon(0.01));
}

TEST_CASE("samples per voxel count the voxels of the viewing direction") {
  // Voxels of the phantom are 1/32 and 1/16 of the cube: the view goes along the long ones, and spacing is in
  // units of the short ones.
  const PreparedScene plain = scene("[]", "", {32, 16, 32});
  const double length = plain.volume.spacing.y;
  CHECK(metric("samples_per_voxel", plain) == Approx(length / plain.spacing));
  const PreparedScene lens =
      scene(R"({"kind":"connected-lens","inner":0.1,"outer":0.3,"magnification":3})", "", {32, 16, 32});
  CHECK(metric("samples_per_voxel", lens) == Approx(3 * length / lens.spacing));
}

TEST_CASE("lens metrics are asked for by name") {
  const PreparedScene plain = scene("[]");
  const auto measured = measure_lens({"jump", "magnification"}, plain);
  REQUIRE(measured.size() == 2);
  CHECK(measured[0].first == "jump");
  CHECK(measured[1].first == "magnification");
  for (const std::string& name : lens_metric_names())
    CHECK_NOTHROW(validate_lens_metric(name));
  CHECK_THROWS_WITH(validate_lens_metric("magnifcation"), Catch::Matchers::Contains("'magnifcation'") &&
                                                              Catch::Matchers::Contains("magnification?"));
  CHECK_THROWS_AS(measure_lens({"psnr"}, plain), UsageError);
}
