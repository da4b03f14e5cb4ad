// Filter `cubic`: the cubic B-spline, in the reference by 64 voxels and on the GPU by eight linear fetches.
//
// Expected values come from the spline's usual form, β(d) = 2/3 − d² + |d|³/2 for |d| < 1 and (2 − |d|)³/6 up
// to 2, summed over all voxels and copies of the edge's.
#include "catch.h"
#include "render_fixture.h"
#include "scene/image_scene.h"
#include "volume_fixture.h"

using namespace slicelens;
using Catch::Matchers::Contains;

namespace cubic_d {
using real = double;
using vec4 = glm::dvec4;
#include "lib/cubic.glsl"
} // namespace cubic_d

namespace {

const std::vector<std::string> pipelines = {"slices", "rays", "reference"};

double spline(double d) {
  d = std::abs(d);
  return d < 1 ? 2.0 / 3 - d * d + d * d * d / 2 : d < 2 ? std::pow(2 - d, 3) / 6 : 0;
}

/// Σ β(x − i)·f(i) over a row of n voxels, i clamped to it.
double smoothed(double x, int n, const std::function<double(int)>& f) {
  double sum = 0;
  for (int i = -3; i < n + 3; ++i)
    sum += spline(x - i) * f(std::clamp(i, 0, n - 1));
  return sum;
}

/// A row of voxels along x with the values f(i), seen from the front: pixel column x shows index (x + ½)/4 −
/// ½ as grey from 0 at the volume's smallest value to 1 at its largest.
PreparedScene row_scene(int n, const std::function<double(int)>& f, const std::string& keys) {
  const auto edge = static_cast<std::size_t>(n);
  Volume volume = volume_of(ScalarType::f32, {edge, 1, edge}, [&](int i, int, int) { return f(i); });
  const TransferFunction grey_scale{
      {{volume.min, 0, 0, 0, 1}, {std::max(volume.max, volume.min + 1), 1, 1, 1, 1}}, std::nullopt, ""};
  const std::string size = std::to_string(4 * n);
  return prepare(
      scene_from_json(R"({"camera":{"parallel_scale":)" + std::to_string(n / 2.0) +
                          R"(},"render":{"mode":"mip","filter":"cubic","background":[0,0,0,0],"size":[)" +
                          size + "," + size + "]," + keys + "}}",
                      "test"),
      std::move(volume), grey_scale);
}

PreparedScene head_scene() {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[48,48,48]},"camera":{"azimuth":33,"elevation":21,"roll":10},
          "render":{"size":[64,64],"filter":"cubic","background":[0,0,0,0]}})",
      {{{-500, 0.4, 0.2, 0.1, 0}, {200, 0.8, 0.6, 0.4, 0.05}, {1200, 1, 1, 0.9, 0.7}}, std::nullopt, ""});
}

std::string text_of(const std::vector<std::string>& keys) {
  std::string text;
  for (const std::string& key : keys)
    text += key + " ";
  return text;
}

const std::string planes =
    R"(clip=[{"point":[0.5,0.5,0.5],"normal":[-1,0.3,0.2]},{"point":[0.4,0.3,0.6],"normal":[0.2,1,0.1]}])";
const std::string lens =
    R"(warp={"kind":"lamar","zoom":3,"center":[0.5,0.4,0.55],"inner":0.14,"outer":0.25})";

} // namespace

TEST_CASE("B-spline weights at points worked by hand, and their moments") {
  const auto check = [](const glm::dvec4& w, const glm::dvec4& expected) {
    for (int i = 0; i < 4; ++i)
      CHECK(w[i] == Approx(expected[i]).margin(1e-15));
  };
  check(cubic_d::cubic_weights(0), {1.0 / 6, 2.0 / 3, 1.0 / 6, 0});
  check(cubic_d::cubic_weights(1), {0, 1.0 / 6, 2.0 / 3, 1.0 / 6});
  check(cubic_d::cubic_weights(0.5), glm::dvec4(1, 23, 23, 1) / 48.0);
  check(cubic_d::cubic_weights(0.25), glm::dvec4(27, 235, 121, 1) / 384.0);
  check(cubic_d::cubic_fetches(0), {-0.2, 1, 5.0 / 6, 1.0 / 6});
  check(cubic_d::cubic_fetches(0.5), {-1.0 / 24, 25.0 / 24, 0.5, 0.5});
  for (double f = 0; f < 1; f += 1.0 / 64) {
    const glm::dvec4 w = cubic_d::cubic_weights(f);
    INFO("f = " << f);
    CHECK(w.x + w.y + w.z + w.w == Approx(1).epsilon(1e-15));
    CHECK(-w.x + w.z + 2 * w.w == Approx(f).margin(1e-15));
    CHECK(w.x + w.z + 4 * w.w == Approx(f * f + 1.0 / 3).epsilon(1e-14));
    check(w, {spline(f + 1), spline(f), spline(f - 1), spline(f - 2)});
    // Two linear fetches of any four voxels are their weighted sum.
    const double v[4] = {3, -1, 4, 1.5};
    const glm::dvec4 fetch = cubic_d::cubic_fetches(f);
    const double low = fetch.x + 1; // between voxels i−1 and i
    const double high = fetch.y - 1;
    CHECK((low >= 0 && low <= 1 && high >= 0 && high <= 1));
    CHECK(fetch.z * glm::mix(v[0], v[1], low) + fetch.w * glm::mix(v[2], v[3], high) ==
          Approx(w.x * v[0] + w.y * v[1] + w.z * v[2] + w.w * v[3]).epsilon(1e-14));
  }
}

TEST_CASE("the cubic filter keeps constants and ramps, and lifts a parabola by a third") {
  gl::Context context = test_context();
  constexpr int n = 16;
  const auto parabola = [](double i) { return (i - 7.5) * (i - 7.5); };
  const auto ramp = [](double i) { return 2 * i - 5; };
  const auto noise = [](double i) { return std::fmod(7.3 * i * i, 5.0); };
  const std::vector<std::function<double(double)>> rows = {parabola, ramp, noise};
  for (const std::string& pipeline : pipelines) {
    const std::string keys = R"("pipeline":")" + pipeline + '"';
    for (std::size_t row = 0; row < rows.size(); ++row) {
      const auto& f = rows[row];
      const PreparedScene scene = row_scene(n, f, keys);
      const Image image = picture(scene, context);
      const double range = scene.volume.max - scene.volume.min;
      for (int x = 0; x < image.width; ++x) {
        const double i = (x + 0.5) / 4 - 0.5;
        const double shown = scene.volume.min + range * static_cast<double>(channel(image, x, 2 * n, 0));
        INFO(pipeline << ", row " << row << ", index " << i);
        // Floats: 1e-6 of a voxel in the coordinate, at most 15 of value a voxel.
        CHECK(shown == Approx(smoothed(i, n, f)).margin(1e-5 * range)); // the edges' copies included
        if (row == 0 && i >= 1 && i < n - 2)
          CHECK(shown == Approx(parabola(i) + 1.0 / 3).margin(1e-5 * range));
        if (row == 1 && i >= 1 && i < n - 2)
          CHECK(shown == Approx(ramp(i)).margin(1e-5 * range));
      }
    }
    const Image constant = picture(row_scene(
                                       n, [](int) { return -700.5; }, keys),
                                   context);
    CHECK(channel(constant, 3, 2 * n, 0) == 0);
    CHECK(channel(constant, 3, 2 * n, 3) == 1);
  }
}

TEST_CASE("a constant volume stays constant under the cubic filter, in every texture") {
  gl::Context context = test_context();
  const double alpha = 0.02;
  for (const std::string texture : {"r8", "r16", "r32f"}) {
    for (const std::string& pipeline : pipelines) {
      const PreparedScene scene =
          prepare(scene_from_json(R"({"render":{"filter":"cubic","size":[16,16],"volume_texture":")" +
                                      texture + R"(","pipeline":")" + pipeline + R"("}})",
                                  "test"),
                  volume_of(ScalarType::i16, {16, 16, 16}, [](int, int, int) { return -700; }), grey(alpha));
      INFO(texture << " " << pipeline);
      CHECK(channel(picture(scene, context), 8, 8, 0) == Approx(1 - std::pow(1 - alpha, 16)).margin(1e-5));
    }
  }
}

TEST_CASE("the X-ray of few voxels is the integral of their B-spline, edges and all three axes") {
  gl::Context context = test_context();
  // So few voxels that every sample has taps beyond an edge; no two axes alike.
  constexpr int nx = 5;
  constexpr int ny = 3;
  constexpr int nz = 4;
  const auto voxel = [](int i, int j, int k) {
    return std::fmod(0.37 * i * i + 0.61 * j + 0.23 * k * k * k, 1.0);
  };
  const auto value = [&](const glm::dvec3& x) {
    return smoothed(x.z, nz, [&](int k) {
      return smoothed(x.y, ny,
                      [&](int j) { return smoothed(x.x, nx, [&](int i) { return voxel(i, j, k); }); });
    });
  };
  const glm::dvec3 half = glm::dvec3(nx, ny, nz) / 2.0;
  const PreparedScene scene =
      prepare(scene_from_json(R"({"camera":{"azimuth":33,"elevation":21,"roll":10},"render":{"size":[16,16],
                  "mode":"xray","spacing":0.02,"xray_scale":0.2,"background":[0,0,0,0],"filter":"cubic"}})",
                              "test"),
              volume_of(ScalarType::f32, {nx, ny, nz}, voxel),
              {{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 1}}, std::nullopt, ""});
  Image expected = make_image(16, 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const Ray ray = pixel_ray(scene, x, y);
      const glm::dvec3 a = (-half - ray.origin) / ray.direction;
      const glm::dvec3 b = (half - ray.origin) / ray.direction;
      const glm::dvec3 low = glm::min(a, b);
      const glm::dvec3 high = glm::max(a, b);
      const double near = std::max({low.x, low.y, low.z});
      const double step = (std::min({high.x, high.y, high.z}) - near) / 200;
      double sum = 0;
      for (int s = 0; s < 200 && step > 0; ++s)
        sum += value(ray.origin + (near + (s + 0.5) * step) * ray.direction + half - 0.5) * step;
      channel(expected, x, y, 0) = static_cast<float>(0.2 * sum);
    }
  }
  const auto error = [&](const std::vector<std::string>& keys) {
    return mean_error(picture(changed(scene, keys), context), 0,
                      [&](int x, int y) { return static_cast<double>(channel(expected, x, y, 0)); });
  };
  for (const std::string& pipeline : pipelines) {
    const double cubic = error({"render.pipeline=" + pipeline});
    const double linear = error({"render.pipeline=" + pipeline, "render.filter=linear"});
    INFO(pipeline << ": " << cubic << ", linear " << linear);
    // Either end of a chord is known to half a spacing, .01 of values up to 1, at scale .2: 4e-3 at the
    // worst, a quarter of that where values are .5 and ends independent.
    CHECK(cubic < 1e-3);
    CHECK(linear > 3e-3); // the test tells the filters apart
  }
}

TEST_CASE("the cubic filter on the GPU is the reference's", "[one-driver]") {
  // 60 dB as for linear-exact (docs/tolerances.md), because llvmpipe's own filter of 16 and 32 bits is float:
  // 82 to 146 dB. softpipe's is wrong at single samples.
  gl::Context context = test_context();
  const PreparedScene head = head_scene();
  const std::vector<std::vector<std::string>> settings = {
      {"render.mode=dvr"},
      {"render.volume_texture=r32f", planes},
      {"render.mode=mip"},
      {"render.mode=xray", "render.xray_scale=0.1"},
      {"render.shading=diffuse"},
      {"render.shading=diffuse", "render.gradient=forward", "light.direction=[1,-1,0.5]"},
      {"camera.projection=perspective", "render.shading=diffuse"},
      {lens},
      {lens, planes, "render.shading=diffuse"},
      {lens, "render.mode=mip", "camera.projection=perspective"},
  };
  for (std::vector<std::string> keys : settings) {
    const std::string text = text_of(keys);
    const bool warped = text.find("warp") != std::string::npos;
    const bool perspective = text.find("perspective") != std::string::npos;
    keys.emplace_back("render.pipeline=reference");
    const Image truth = picture(changed(head, keys), context);
    keys.back() = "render.pipeline=rays";
    const double rays = psnr(picture(changed(head, keys), context), truth);
    INFO(text << "rays " << rays);
    CHECK(rays >= 60);
    if (perspective) // planes sample other points than spheres
      continue;
    keys.back() = std::string("render.pipeline=") + (warped ? "fragment" : "slices");
    const double slices = psnr(picture(changed(head, keys), context), truth);
    INFO("slices " << slices);
    CHECK(slices >= 60);
    if (!warped)
      continue;
    keys.back() = "render.pipeline=tessellated";
    const double tessellated = psnr(picture(changed(head, keys), context), truth);
    INFO("tessellated " << tessellated);
    CHECK(tessellated >= 60); // a polygon for the circle, as with every filter: 68 and more
  }
}

TEST_CASE("the cubic filter of classified colours and of levels is the reference's", "[one-driver]") {
  gl::Context context = test_context();
  const auto decibels = [&](std::vector<std::string> keys, const std::string& pipeline) {
    keys.push_back("render.pipeline=" + pipeline);
    const Image image = picture(changed(head_scene(), keys), context);
    keys.back() = "render.pipeline=reference";
    return psnr(image, picture(changed(head_scene(), keys), context));
  };
  // The driver filters 8-bit colours to 8 bits before the shader weighs them: the bar of `linear`.
  for (const std::string pipeline : {"slices", "rays"}) {
    const double pre = decibels({"render.classification=pre"}, pipeline);
    INFO(pipeline << ": pre " << pre);
    CHECK(pre >= 45);
  }
  const double levels = decibels({lens, "render.levels=3"}, "fragment");
  INFO("levels " << levels);
  CHECK(levels >= 60);
}

TEST_CASE("what cannot filter with a B-spline says so") {
  const auto refusal = [](const std::string& pipeline) {
    try {
      scene_from_json(R"({"render":{"filter":"cubic","pipeline":")" + pipeline + R"("}})", "test");
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  CHECK_THAT(refusal("fixed-function"),
             Contains("'fixed-function'") && Contains("'cubic'") && Contains("render.filter"));
  for (const std::string pipeline : {"slices", "tessellated", "fragment", "rays", "reference"})
    CHECK(refusal(pipeline) == "accepted");
  CHECK_THROWS_WITH(image_scene_from_json(R"({"render":{"filter":"cubic"}})", "test"),
                    Contains("render.filter 'cubic'") && Contains("linear-exact"));
}
