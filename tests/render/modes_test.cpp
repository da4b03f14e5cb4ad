// Minimum, average and first surface; opacities by the gradient; jitter; crop. Against closed forms, and the
// pipelines against each other.
#include "catch.h"
#include "core/errors.h"
#include "render_fixture.h"
#include "volume_fixture.h"

using namespace slicelens;

namespace {

using uint = std::uint32_t;
using real = double;
#include "lib/jitter.glsl"

const std::vector<std::string> pipelines = {"slices", "rays", "reference"};

/// 0.2 at the first voxel along y to 0.8 at the last: what the default camera looks along. Opacity is the
/// value.
PreparedScene ramp_along_view(const std::string& render) {
  Volume volume =
      volume_of(ScalarType::f32, {12, 16, 12}, [](int, int j, int) { return 0.2 + 0.6 * j / 15; });
  TransferFunction transfer{{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 1}}, std::nullopt, "value"};
  return prepare(
      scene_from_json(R"({"render": {"size": [9, 9], "background": [0, 0, 0, 0], )" + render + "}}", "test"),
      std::move(volume), std::move(transfer));
}

double alpha_in_middle(const PreparedScene& prepared, gl::Context& context) {
  return static_cast<double>(channel(picture(prepared, context), 4, 4, 3));
}

std::string refusal(const std::string& json) {
  try {
    (void)scene_from_json(json, "test");
  } catch (const UsageError& error) {
    return error.what();
  }
  return "accepted";
}

} // namespace

TEST_CASE("minimum, maximum and average of a ramp along the ray") {
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    INFO(pipeline);
    const auto alpha = [&](const std::string& mode) {
      return alpha_in_middle(
          ramp_along_view(R"("spacing": 0.5, "mode": ")" + mode + R"(", "pipeline": ")" + pipeline + "\""),
          context);
    };
    // The outer half voxels are constant, so the extremes are met exactly; samples lie symmetrically, so
    // their mean is the middle.
    CHECK(alpha("minip") == Approx(0.2).epsilon(1e-5));
    CHECK(alpha("mip") == Approx(0.8).epsilon(1e-5));
    CHECK(alpha("average") == Approx(0.5).epsilon(1e-5));
  }
  const Image outside = picture(ramp_along_view(R"("mode": "minip")"), context);
  CHECK(channel(outside, 0, 0, 3) == 0); // beside the volume there is no value
}

TEST_CASE("new modes are the same by slices, rays and the reference") {
  gl::Context context = test_context();
  const PreparedScene head = prepare_phantom(
      R"({"volume": {"phantom": "head", "size": [32, 32, 32]}, "camera": {"azimuth": 30, "elevation": 20},
          "render": {"size": [48, 48], "filter": "linear-exact"}})",
      rising(-500, 800, 0.3));
  const auto check = [&](std::vector<std::string> keys, double bar) {
    const auto by = [&](const std::string& pipeline) {
      std::vector<std::string> all = keys;
      all.push_back("render.pipeline=" + pipeline);
      return picture(changed(head, all), context);
    };
    const Image reference = by("reference");
    const bool warped = keys[0].rfind("warp", 0) == 0;
    const double slices = psnr(by(warped ? "fragment" : "slices"), reference);
    const double rays = psnr(by("rays"), reference);
    INFO(keys[0] << " " << keys.back() << ": slices " << slices << ", rays " << rays);
    CHECK(slices >= bar);
    CHECK(rays >= bar);
  };
  const std::string twist = R"(warp={"kind": "twist", "angle": 40})";
  // Orthographic slices and rays have the same samples: floats against double.
  check({"render.mode=minip", "crop={\"low\":[0.3,0.3,0.3],\"high\":[0.7,0.7,0.7]}"}, 90);
  check({"render.mode=average"}, 90);
  check({"render.mode=iso", "render.isovalue=-300", "render.shading=phong"}, 70);
  // Where a ray grazes the surface rounding decides whether two samples enclose it: single pixels.
  check({twist, "render.mode=iso", "render.isovalue=300", "render.shading=diffuse"}, 45);
  check({"render.mode=xray", "render.modulate_by_gradient=150"}, 80);
  check({twist, "render.modulate_by_gradient=150", "render.shading=diffuse"}, 80);
  check({"render.jitter=1", "render.jitter_seed=7"}, 80);
  check({twist, "render.jitter=0.5", "render.mode=mip"}, 80);
  check({"render.jitter=1", "render.mode=iso", "render.isovalue=300"}, 55);
  check({twist, "crop={\"low\":[0.2,0.3,0.1],\"high\":[0.9,0.8,0.7]}"}, 80);
}

TEST_CASE("the surface of a ball has the normals of a ball") {
  gl::Context context = test_context();
  // The phantom is a signed distance from a sphere, so the gradient has length one and the surface is the
  // level 0.
  for (const std::string& pipeline : pipelines) {
    const PreparedScene ball = prepare_phantom(
        R"({"volume": {"phantom": "ball", "size": [32, 32, 32]}, "light": {"ambient": 0, "diffuse": 1},
            "render": {"size": [64, 64], "background": [0, 0, 0, 0], "mode": "iso", "isovalue": 0, "shading": "diffuse", "spacing": 2,
            "pipeline": ")" +
            pipeline + "\"}}",
        constant_transfer({1, 1, 1, 0.1}));
    const Image image = picture(ball, context);
    double radius = 0; // from the picture itself: half its widest row of opaque pixels
    for (int y = 0; y < 64; ++y) {
      int count = 0;
      for (int x = 0; x < 64; ++x)
        count += channel(image, x, y, 3) > 0.5F;
      radius = std::max(radius, 0.5 * count);
    }
    REQUIRE(radius > 8);
    const auto off_middle = [](int x, int y) { return std::hypot(x + 0.5 - 32, y + 0.5 - 32); };
    const auto cosine = [&](int x, int y) {
      const double s = off_middle(x, y) / radius;
      return std::sqrt(std::max(0.0, 1 - s * s));
    };
    const auto inside = [&](int x, int y) { return off_middle(x, y) < 0.8 * radius; };
    INFO(pipeline);
    // Half a pixel of the radius is 1/20 of it: 0.03 of a cosine at s = 0.8, a hundredth on average.
    CHECK(mean_error(image, 0, cosine, inside) < 0.015);
    CHECK(mean_error(
              image, 3, [](int, int) { return 1.0; }, inside) < 1e-6);
  }
}

TEST_CASE("a surface lies between samples, and is open where only the edge cuts it") {
  gl::Context context = test_context();
  // The surface 0.5 of the ramp is the plane through the middle, whatever the spacing; all of it is covered.
  for (const char* spacing : {"0.7", "1", "3"}) {
    const PreparedScene scene =
        ramp_along_view(R"("mode": "iso", "isovalue": 0.5, "spacing": )" + std::string(spacing));
    CHECK(alpha_in_middle(scene, context) == Approx(1));
  }
  // 0.1 is nowhere; 0.2 is reached from above at the first voxel and never crossed.
  CHECK(alpha_in_middle(ramp_along_view(R"("mode": "iso", "isovalue": 0.1)"), context) == 0);
  PreparedScene clipped = ramp_along_view(R"("mode": "iso", "isovalue": 0.5)");
  clipped.scene.clip = {{{0.5, 0.6, 0.5}, {0, 1, 0}, ClipSpace::texture}};
  prepare_again(clipped);
  CHECK(alpha_in_middle(clipped, context) == 0); // the plane at 0.5 is cut away, and the cut has no cap
}

TEST_CASE("a surface on the very plane of a slice has no holes") {
  gl::Context context = test_context();
  // Seen along x, slices lie at 0.5 + (k + ½)·0.7/60 in the ramp, which is its value. A surface there is at a
  // place that two slices compute by different arithmetic; were their ways not to overlap, some of these
  // would be lost whole.
  for (const char* azimuth : {"90", "-90"}) {
    PreparedScene ramp = prepare_phantom(
        R"({"volume": {"phantom": "ramp", "size": [60, 60, 60]}, "camera": {"zoom": 4, "azimuth": )" +
            std::string(azimuth) +
            R"(}, "render": {"size": [8, 8], "spacing": 0.7, "mode": "iso", "filter": "linear-exact",
            "background": [0, 0, 0, 0]}})",
        grey(1));
    for (int k = -20; k < 20; ++k) {
      ramp.scene.render.isovalue = 0.5 + (k + 0.5) * 0.7 / 60;
      for (const ProjectionName projection : {ProjectionName::orthographic, ProjectionName::perspective}) {
        ramp.scene.camera.projection = projection;
        prepare_again(ramp);
        INFO("azimuth " << azimuth << ", slice " << k);
        CHECK(mean_error(picture(ramp, context), 3, [](int, int) { return 1.0; }) == 0);
      }
    }
  }
}

TEST_CASE("slices find the surfaces of rays, thin ones too, and no others") {
  gl::Context context = test_context();
  // Rings at the edge of what 64³ voxels hold: ridges that some rays pass between two samples.
  const PreparedScene rings = prepare_phantom(
      R"({"volume": {"phantom": "marschner-lobb", "size": [64, 64, 64]},
          "camera": {"azimuth": 33, "elevation": 21, "roll": 10},
          "render": {"size": [96, 96], "mode": "iso", "isovalue": 0.5, "filter": "linear-exact",
          "shading": "diffuse", "background": [0, 0, 0, 0]}})",
      grey(1));
  for (const char* spacing : {"render.spacing=2", "render.spacing=1"}) {
    const double decibels = psnr(picture(changed(rings, {spacing}), context),
                                 picture(changed(rings, {spacing, "render.pipeline=rays"}), context));
    INFO(spacing << ": " << decibels);
    CHECK(decibels > 70); // a pixel of another surface leaves 40 to 60
  }
}

TEST_CASE("opacities follow the gradient in proportion") {
  gl::Context context = test_context();
  // A ramp across the view: every sample of the middle ray has the slope 0.6/11 a voxel (unit spacing) and
  // the value 0.5.
  const auto line = [&](const std::string& pipeline, const std::string& more) {
    Volume volume =
        volume_of(ScalarType::f32, {12, 16, 12}, [](int i, int, int) { return 0.2 + 0.6 * i / 11; });
    TransferFunction transfer{{{0, 1, 1, 1, 0.01}, {1, 1, 1, 1, 0.01}}, std::nullopt, "constant"};
    return alpha_in_middle(prepare(scene_from_json(R"({"render": {"size": [9, 9], "background": [0, 0, 0, 0],
                                   "mode": "xray", "pipeline": ")" +
                                                       pipeline + "\"" + more + "}}",
                                                   "test"),
                                   std::move(volume), std::move(transfer)),
                           context);
  };
  for (const std::string& pipeline : pipelines) {
    const double whole = line(pipeline, "");
    REQUIRE(whole > 0);
    const double slope = 0.6 / 11;
    CHECK(line(pipeline, R"(, "modulate_by_gradient": )" + std::to_string(4 * slope)) / whole ==
          Approx(0.25).epsilon(1e-4));
    CHECK(line(pipeline, R"(, "modulate_by_gradient": )" + std::to_string(0.9 * slope)) / whole ==
          Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("offsets of pixels are spread evenly and have nothing in common") {
  double sum = 0;
  double squares = 0;
  double neighbours = 0;
  constexpr uint n = 256;
  for (uint y = 0; y < n; ++y) {
    for (uint x = 0; x < n; ++x) {
      const double offset = pixel_offset(x, y, 1);
      REQUIRE(offset >= -0.5);
      REQUIRE(offset < 0.5);
      sum += offset;
      squares += offset * offset;
      neighbours += offset * (pixel_offset(x + 1, y, 1) + pixel_offset(x, y + 1, 1));
    }
  }
  // Of 65536 even numbers in [−½, ½): mean 0 and variance 1/12, five standard deviations of each wide.
  CHECK(std::abs(sum / (n * n)) < 5 * std::sqrt(1.0 / 12) / n);
  CHECK(std::abs(squares / (n * n) - 1.0 / 12) < 5 * std::sqrt(1.0 / 180) / n);
  CHECK(std::abs(neighbours / (n * n)) < 5 * std::sqrt(2.0) / 12 / n);
  CHECK(pixel_offset(3, 4, 1) != pixel_offset(3, 4, 2));
}

TEST_CASE("jitter breaks up the rings that slices leave") {
  gl::Context context = test_context();
  // A thin shell sampled too coarsely: rings. The truth is the same by thin slices.
  const PreparedScene ball = prepare_phantom(
      R"({"volume": {"phantom": "ball", "size": [32, 32, 32]}, "render": {"size": [64, 64], "spacing": 2}})",
      TransferFunction{
          {{-0.03, 1, 1, 1, 0}, {-0.015, 1, 1, 1, 0.3}, {0.015, 1, 1, 1, 0.3}, {0.03, 1, 1, 1, 0}},
          std::nullopt,
          "shell"});
  const Image truth = picture(changed(ball, {"render.spacing=0.05"}), context);
  // A mean over many seeds takes every ray at many offsets: the rings, where all rays of a ring err alike,
  // average out.
  constexpr int seeds = 16;
  Image mean = make_image(64, 64);
  for (int seed = 1; seed <= seeds; ++seed) {
    const Image one =
        picture(changed(ball, {"render.jitter=1", "render.jitter_seed=" + std::to_string(seed)}), context);
    for (std::size_t i = 0; i < mean.pixels.size(); ++i)
      mean.pixels[i] += one.pixels[i] / static_cast<float>(seeds);
  }
  const double rings = psnr(picture(ball, context), truth);
  const double jittered = psnr(mean, truth);
  INFO("plain " << rings << " dB, mean of jittered " << jittered << " dB");
  CHECK(jittered > rings + 6);
}

TEST_CASE("a crop box is six clipping planes") {
  gl::Context context = test_context();
  const PreparedScene head = prepare_phantom(
      R"({"volume": {"phantom": "head", "size": [32, 32, 32]}, "camera": {"azimuth": 30, "elevation": 20},
          "render": {"size": [48, 48]}})",
      rising(-500, 800, 0.3));
  const std::string planes =
      R"(clip=[{"point":[0.3,0,0],"normal":[1,0,0]},{"point":[0.8,0,0],"normal":[-1,0,0]},
               {"point":[0,0.2,0],"normal":[0,1,0]},{"point":[0,0.7,0],"normal":[0,-1,0]},
               {"point":[0,0,0.4],"normal":[0,0,1]},{"point":[0,0,0.9],"normal":[0,0,-1]}])";
  const Image cropped =
      picture(changed(head, {R"(crop={"low":[0.3,0.2,0.4],"high":[0.8,0.7,0.9]})"}), context);
  CHECK(psnr(cropped, picture(changed(head, {planes}), context)) >= 90); // corners that round apart
  CHECK(psnr(cropped, picture(head, context)) < 40);
}

TEST_CASE("what the new modes cannot do is refused by name") {
  CHECK_THAT(refusal(R"({"render": {"mode": "average", "target": "rgba8"}})"), Catch::Contains("'average'"));
  CHECK_THAT(refusal(R"({"render": {"mode": "minip", "shading": "diffuse"}})"), Catch::Contains("'minip'"));
  CHECK_THAT(refusal(R"({"render": {"mode": "dvr", "isovalue": 3}})"), Catch::Contains("render.isovalue"));
  CHECK_THAT(refusal(R"({"render": {"mode": "iso", "pipeline": "tessellated"}, "warp": {"kind": "lamar"}})"),
             Catch::Contains("mode 'iso'"));
  CHECK_THAT(refusal(R"({"render": {"mode": "iso", "classification": "pre"}})"), Catch::Contains("'iso'"));
  CHECK_THAT(refusal(R"({"render": {"mode": "iso", "tiles": [2, 1, 1]}})"), Catch::Contains("'iso'"));
  CHECK_THAT(refusal(R"({"render": {"jitter": 1, "tiles": [2, 1, 1]}})"), Catch::Contains("render.jitter"));
  CHECK_THAT(refusal(R"({"render": {"jitter": 2}})"), Catch::Contains("render.jitter"));
  CHECK_THAT(refusal(R"({"render": {"mode": "mip", "modulate_by_gradient": 5}})"),
             Catch::Contains("modulate_by_gradient"));
  CHECK_THAT(
      refusal(
          R"({"render": {"mode": "average"}, "highlight": {"function": "focus", "focus": [[0.1,0.9],[0.1,0.9],[0.1,0.9]]}})"),
      Catch::Contains("'average'"));
  CHECK_THAT(refusal(R"({"crop": {"low": [0.5, 0, 0], "high": [0.5, 1, 1]}})"), Catch::Contains("crop.low"));
  CHECK_THAT(refusal(R"({"volumes": [{}, {}], "render": {"mode": "iso"}})"), Catch::Contains("'iso'"));
  CHECK_THAT(refusal(R"({"volumes": [{}, {}], "render": {"mode": "average"}})"),
             Catch::Contains("'average'"));
}

TEST_CASE("shapes in the plane of value and gradient are what a hand calculation says") {
  const std::vector<TransferShape> shapes = {{{0, 2, 4, 8}, {1, 1, 3, 5}, {1, 0, 0}, 0.5},
                                             {{3, 3, 9, 9}, {0, 0, 2, 2}, {0, 1, 0}, 0.8}};
  const auto close = [](const glm::dvec4& a, const glm::dvec4& b) { return glm::length(a - b) < 1e-12; };
  CHECK(close(evaluate(shapes, 1, 2.5), {1, 0, 0, 0.25})); // halfway up
  CHECK(close(evaluate(shapes, 2, 4), {1, 0, 0, 0.25}));   // halfway down the gradient
  CHECK(close(evaluate(shapes, 6, 2.5), {1, 0, 0, 0.25})); // halfway down the value, above the second
  CHECK(close(evaluate(shapes, 3, 2), {0.5 / 1.3, 0.8 / 1.3, 0, 1})); // both whole: 1.3, at most 1
  CHECK(close(evaluate(shapes, 9, 0), {0, 1, 0, 0.8}));               // a step's own place is inside
  CHECK(close(evaluate(shapes, 1, 0.99), {0, 0, 0, 0}));
  CHECK(close(evaluate(shapes, std::numeric_limits<double>::quiet_NaN(), 2), {0, 0, 0, 0}));
  // Texels of the table are the function: the middle row and column are half of the ranges.
  const TransferTable2D table = make_table(shapes, 0, 10.23);
  REQUIRE(table.rgba.size() == 4U * 1024 * 512);
  const auto texel = [&](int i, int j) {
    return table.rgba[4U * (static_cast<std::size_t>(j) * 1024U + static_cast<std::size_t>(i)) + 3];
  };
  CHECK(texel(200, 200) == Approx(0.5)); // value 2, gradient 200·5/511
  CHECK(texel(100, 200) == Approx(0.25));
  CHECK(texel(0, 0) == 0);
}

TEST_CASE("a transfer function of value and gradient sees the slope of a ramp") {
  gl::Context context = test_context();
  // Value 0.5 and slope 0.6/11 along the middle ray, as above; in `xray` S is the shape's opacity times the
  // length.
  const double slope = 0.6 / 11;
  const auto line = [&](const std::string& pipeline, double least, double most) {
    Volume volume =
        volume_of(ScalarType::f32, {12, 16, 12}, [](int i, int, int) { return 0.2 + 0.6 * i / 11; });
    Scene scene = scene_from_json(R"({"render": {"size": [9, 9], "background": [0, 0, 0, 0], "mode": "xray",
                                  "xray_scale": 1, "pipeline": ")" +
                                      pipeline + "\"}}",
                                  "test");
    scene.transfer.shapes = {{{0, 0, 1, 1}, {least, least, most, most}, {1, 1, 1}, 0.03}};
    return alpha_in_middle(prepare(std::move(scene), std::move(volume), grey(0.9)), context);
  };
  for (const std::string& pipeline : pipelines) {
    INFO(pipeline);
    CHECK(line(pipeline, 0.8 * slope, 1.2 * slope) ==
          Approx(0.03 * 16).epsilon(1e-4)); // 16 voxels of length one
    CHECK(line(pipeline, 0, 0.8 * slope) == Approx(0).margin(1e-6));
    CHECK(line(pipeline, 1.2 * slope, 3 * slope) == Approx(0).margin(1e-6));
  }
}

TEST_CASE("a transfer function of value and gradient is the same in every pipeline") {
  gl::Context context = test_context();
  const std::string json = R"({"volume": {"phantom": "head", "size": [32, 32, 32]}, "camera": {"azimuth": 30},
    "transfer": {"shapes": [{"value": [-600, -350, -250, 0], "gradient": [20, 50, 300, 500], "color": [0.9, 0.6, 0.5],
    "opacity": 0.2}, {"value": [150, 300, 1200, 1500], "gradient": [0, 20, 900, 1200], "opacity": 0.5}]},
    "render": {"size": [48, 48], "filter": "linear-exact"}})";
  const PreparedScene head = prepare_phantom(json, grey(0.5));
  for (const std::string warp : {"warp=null", R"(warp={"kind":"twist","angle":40})"}) {
    for (const char* shading : {"none", "phong"}) {
      const auto by = [&](const std::string& pipeline) {
        return picture(
            changed(head, {warp, std::string("render.shading=") + shading, "render.pipeline=" + pipeline}),
            context);
      };
      const Image reference = by("reference");
      // 1024 x 512 texels stand for the shapes, filtered linearly between.
      CHECK(psnr(by("fragment"), reference) >= 55);
      CHECK(psnr(by("rays"), reference) >= 55);
    }
  }
  CHECK_THAT(refusal(R"({"transfer": {"shapes": [{}], "preset": "CT-Bone"}})"),
             Catch::Contains("transfer.shapes"));
  CHECK_THAT(refusal(R"({"transfer": {"shapes": [{}]}, "render": {"mode": "mip"}})"),
             Catch::Contains("'mip'"));
  CHECK_THAT(refusal(R"({"transfer": {"shapes": [{"value": [1, 0, 2, 3]}]}})"),
             Catch::Contains("do not decrease"));
  CHECK_THAT(refusal(R"({"transfer": {"shapes": [{"gradient": [-1, 0, 2, 3]}]}})"),
             Catch::Contains("none below 0"));
}
