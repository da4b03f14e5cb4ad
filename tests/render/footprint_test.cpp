// render.footprint: the level that the spacing of samples in the data asks for, and what it is worth.
#include "catch.h"
#include "gl_fullscreen.h"
#include "refusal.h"
#include "render/footprint.h"
#include "render/level_function.h"
#include "render/shaders.h"
#include "render_fixture.h"
#include "volume_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

#include <numbers>
#include <random>

using namespace slicelens;

namespace {

constexpr double pi = std::numbers::pi;

/// Data in x ∈ [0.06, 0.94] shown eight times narrower; the other axes stay.
const std::string squeeze =
    R"({"kind":"bifocal","focus":[[0.06,0.94],[0.25,0.75],[0.25,0.75]],"shown":[[0.445,0.555],[0.25,0.75],[0.25,0.75]]})";
const std::string fisheye = R"({"kind":"fisheye","center":[0.4,0.3,0.55],"distortion":3})";
const std::string sine = R"({"kind":"sine","axis":"x","along":"z","amplitude":0.1,"wavelength":0.2})";
const std::string twist = R"({"kind":"twist","axis":"z","angle":200})";

PreparedScene phantom_scene(const std::string& phantom, int voxels, int pixels, const std::string& more = "",
                            TransferFunction transfer = rising(0.1, 1, 0.3)) {
  const std::string n = std::to_string(voxels);
  const std::string size = std::to_string(pixels);
  return prepare_phantom(R"({"volume":{"phantom":")" + phantom + R"(","size":[)" + n + "," + n + "," + n +
                             R"(]},"camera":{"azimuth":33,"elevation":21,"roll":10},"render":{"size":[)" +
                             size + "," + size +
                             R"(],"footprint":"mip","filter":"linear-exact","xray_scale":0.1,)" +
                             R"("background":[0,0,0,0]})" + more + "}",
                         std::move(transfer));
}

glm::dmat3 turn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const glm::dvec3 axis = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  return glm::dmat3(glm::rotate(glm::dmat4(1), 3 * normal(random), axis));
}

struct Case {
  glm::dmat3 matrix;
  double largest;
};

/// Matrices with known singular values: single, double, triple and zero ones, up to 1:1000.
std::vector<Case> cases(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-5, 5);
  std::vector<Case> list;
  for (int i = 0; i < count; ++i) {
    glm::dvec3 s(std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random)));
    if (i % 5 == 1)
      s.y = s.x;
    if (i % 5 == 2)
      s = glm::dvec3(s.x);
    if (i % 5 == 3)
      s.z = 0;
    const double largest = std::max({s.x, s.y, s.z});
    list.push_back(
        {turn(random) * glm::dmat3(s.x, 0, 0, 0, s.y, 0, 0, 0, s.z) * glm::transpose(turn(random)), largest});
  }
  return list;
}

} // namespace

TEST_CASE("the largest singular value is that which a matrix was made with") {
  for (const Case& c : cases(2000)) {
    // Where two are one, the root of the rounding of the determinant: √1e-16, with some room.
    CHECK(LevelFunction().largest_singular_value(c.matrix) == Approx(c.largest).epsilon(1e-6));
  }
  CHECK(LevelFunction().largest_singular_value(glm::dmat3(0)) < 1e-9);
}

TEST_CASE("the driver's largest singular value is that of double precision") {
  gl::Context context = test_context();
  const gl::Functions& gl = context.functions();
  const std::string body = "uniform mat3 m;\nout vec4 color;\n#include \"lib/levels.glsl\"\n"
                           "void main() { color = vec4(largest_singular_value(m)); }\n";
  std::vector<gl::ShaderSource> stages = shader_stage(GL_VERTEX_SHADER, "picture.vert", {});
  const auto fragment = shader_stage(GL_FRAGMENT_SHADER, "singular.frag", {}, {{"singular.frag", body}});
  stages.insert(stages.end(), fragment.begin(), fragment.end());
  const gl::Program program = gl::make_program(gl, stages);
  const gl::Target target = gl::make_target(gl, 1, 1, GL_RGBA32F);
  gl::bind_target(gl, target);
  for (const Case& c : cases(200)) {
    gl.UseProgram(program.name());
    set_uniform(gl, program, "m", glm::mat3(c.matrix));
    draw_fullscreen(gl, program);
    // √ of float rounding where two are one, and the drivers' polynomial for acos (1e-4).
    CHECK(gl::read_pixels(gl, target)[0] == Approx(c.largest).epsilon(1e-3));
  }
}

TEST_CASE("levels by hand: pixels, slices, voxels of any shape, depth") {
  // 64 world units high, 32³ voxels of one unit: 16 pixels are 4 voxels each, level 2, wherever one looks.
  const Volume cube = volume_of(ScalarType::f32, {32, 32, 32}, [](int i, int, int) { return i; });
  const auto scene = [&](const std::string& camera, const std::string& render, Volume volume) {
    return prepare(
        scene_from_json(R"({"camera":{)" + camera + R"(},"render":{"footprint":"mip",)" + render + "}}",
                        "test"),
        std::move(volume), grey(0.1));
  };
  const std::string high = R"("parallel_scale":32)";
  const auto level = [&](const PreparedScene& prepared, const glm::dvec3& p) {
    return footprint_level(prepared, p);
  };
  CHECK(level(scene(high, R"("size":[16,16])", cube), {0.1, 0.9, 0.5}) == Approx(2).epsilon(1e-9));
  CHECK(scene(high, R"("size":[16,16])", cube).levels == 3);
  CHECK(scene(high, R"("size":[64,64])", cube).levels == 1); // a pixel is a voxel
  CHECK(scene(high, R"("size":[16,16],"levels":2)", cube).levels == 2);
  CHECK(level(scene(high, R"("size":[16,16],"levels":2)", cube), glm::dvec3(0.5)) == 1);
  CHECK(level(scene(high, R"("size":[16,16],"spacing":8)", cube), glm::dvec3(0.5)) ==
        Approx(3).epsilon(1e-9));
  CHECK(scene(high, R"("size":[1,1])", cube).levels == 6); // 64 voxels a pixel, but 32 voxels have 6 levels
  // Voxels of 1 × 1 × 4: the same pixel is four voxels wide but one high.
  Volume slab = cube;
  slab.spacing = {1, 1, 4};
  CHECK(level(scene(high, R"("size":[16,16])", slab), glm::dvec3(0.5)) == Approx(2).epsilon(1e-9));
  Volume flat = cube;
  flat.spacing = {4, 4, 4}; // h is 4: slices are a voxel apart
  CHECK(level(scene(high, R"("size":[16,16])", flat), glm::dvec3(0.5)) == Approx(0).margin(1e-9));
  // Perspective: a pixel grows with its depth, 2·tan(15°)·depth/16 here, right and up alike: a double
  // singular value, which costs half the digits.
  const PreparedScene seen = scene(R"("projection":"perspective")", R"("size":[16,16])", cube);
  for (const double y : {0.1, 0.9}) {
    const glm::dvec3 p(0.3, y, 0.6);
    const double away = depth(seen.view, world_from_texture(seen.box, p));
    CHECK(level(seen, p) == Approx(std::log2(2 * std::tan(pi / 12) * away / 16)).epsilon(1e-7));
  }
}

TEST_CASE("levels by hand: what a map makes of the steps") {
  // Pixels and slices of one voxel: the level is log2 of the map's own largest singular value.
  const auto level = [](const std::string& warp, const glm::dvec3& p) {
    const Volume cube = volume_of(ScalarType::f32, {64, 64, 64}, [](int i, int, int) { return i; });
    return footprint_level(prepare(scene_from_json(R"({"camera":{"parallel_scale":64,"azimuth":30},
        "render":{"footprint":"mip","size":[128,128]},"warp":)" +
                                                       warp + "}",
                                                   "test"),
                                   cube, grey(0.1)),
                           p);
  };
  CHECK(level(squeeze, {0.5, 0.5, 0.5}) == Approx(3).epsilon(1e-6)); // 0.88/0.11 = 8
  CHECK(level(squeeze, {0.2, 0.5, 0.5}) == Approx(0).margin(1e-6));  // x magnified, y and z as they are
  CHECK(level(R"({"kind":"twist","angle":0})", glm::dvec3(0.3)) == Approx(0).margin(1e-6));
  // A shear by g has the largest singular value (g + √(g² + 4))/2; g = 2πA/λ where the sine is steepest.
  const double g = 2 * pi * 0.1 / 0.2;
  CHECK(level(sine, {0.5, 0.5, 0.6}) == Approx(std::log2((g + std::sqrt(g * g + 4)) / 2)).epsilon(1e-6));
}

TEST_CASE("without minification mip is point sampling to the byte, from one texture") {
  gl::Context context = test_context();
  const PreparedScene mip = phantom_scene("brick", 32, 64);
  CHECK(mip.levels == 1);
  const RenderResult result = render(mip, &context, {});
  CHECK(result.volume_textures == 1);
  CHECK(result.image.pixels == picture(changed(mip, {"render.footprint=point"}), context).pixels);
}

TEST_CASE("constant and linear volumes look the same at the level of the footprint") {
  gl::Context context = test_context();
  // 45 voxels: odd at two levels. Clipped away from the edges, where means are one-sided.
  Volume volume =
      volume_of(ScalarType::f32, {45, 45, 45}, [](int i, int j, int k) { return i + 0.5 * j - 0.25 * k; });
  const PreparedScene scene =
      prepare(scene_from_json(
                  R"({"camera":{"azimuth":20,"elevation":10},"warp":{"kind":"twist","angle":40},
              "clip":[{"point":[0.3,0.3,0.3],"normal":[1,0,0]},{"point":[0.3,0.3,0.3],"normal":[0,1,0]},
                      {"point":[0.3,0.3,0.3],"normal":[0,0,1]},{"point":[0.7,0.7,0.7],"normal":[-1,0,0]},
                      {"point":[0.7,0.7,0.7],"normal":[0,-1,0]},{"point":[0.7,0.7,0.7],"normal":[0,0,-1]}],
              "render":{"size":[24,24],"filter":"linear-exact","shading":"diffuse","gradient_space":"data"}})",
                  "test"),
              std::move(volume), rising(-11, 66, 0.1));
  for (const std::string pipeline : {"fragment", "tessellated", "rays", "reference"}) {
    const PreparedScene point = changed(scene, {"render.pipeline=" + pipeline});
    const PreparedScene mip = changed(point, {"render.footprint=mip"});
    REQUIRE(mip.levels >= 3); // pixels of 45·√3/24 = 3.2 voxels, and more under the twist
    const double largest = max_difference(picture(point, context), picture(mip, context));
    INFO(pipeline << ": " << largest);
    CHECK(largest < 2e-5); // float rounding of the values, summed over 60 samples
  }
}

namespace {

void check_pipelines(const PreparedScene& scene, std::vector<std::string> pipelines, gl::Context& context) {
  const Image truth = picture(changed(scene, {"render.pipeline=reference"}), context);
  CHECK(scene.levels >= 2);
  CHECK(share_over(truth, make_image(truth.width, truth.height), 0.02) > 0.02); // there is a picture
  const Image point =
      picture(changed(scene, {"render.pipeline=reference", "render.footprint=point"}), context);
  CHECK(psnr(truth, point) < 50); // the levels do something
  for (const std::string& pipeline : pipelines) {
    const double decibels = psnr(picture(changed(scene, {"render.pipeline=" + pipeline}), context), truth);
    INFO(pipeline << " " << decibels << " dB");
    CHECK(decibels >= 55);
  }
}

} // namespace

TEST_CASE("every mode reads the levels of the reference, slices without a warp", "[one-driver]") {
  gl::Context context = test_context();
  const PreparedScene plain = phantom_scene("marschner-lobb", 64, 24);
  for (const std::string mode : {"render.mode=dvr", "render.mode=mip", "render.mode=xray",
                                 "render.shading=diffuse", "render.filter=linear", "render.filter=cubic"}) {
    INFO(mode);
    check_pipelines(changed(plain, {mode}), {"slices", "rays"}, context);
    check_pipelines(changed(plain, {mode, "camera.projection=perspective", "camera.view_angle=50"}), {"rays"},
                    context);
  }
}

TEST_CASE("deformed samples read the levels of the reference", "[one-driver]") {
  gl::Context context = test_context();
  for (const std::string& warp : {squeeze, fisheye, sine, twist}) {
    const PreparedScene scene = phantom_scene("marschner-lobb", 32, 20, R"(,"warp":)" + warp);
    for (const std::string mode : {"dvr", "mip", "xray"}) {
      INFO(warp << " " << mode);
      check_pipelines(changed(scene, {"render.mode=" + mode}), {"fragment", "rays"}, context);
    }
    check_pipelines(changed(scene, {"camera.projection=perspective", "camera.view_angle=50"}), {"rays"},
                    context);
  }
}

TEST_CASE("gradients of deformed samples take their taps at the reference's level", "[one-driver]") {
  gl::Context context = test_context();
  for (const std::string& warp : {squeeze, twist}) {
    const PreparedScene scene =
        changed(phantom_scene("marschner-lobb", 32, 20, R"(,"warp":)" + warp), {"render.shading=diffuse"});
    for (const std::string space : {"data", "object"}) {
      INFO(warp << " " << space);
      const std::string gradient = space == "data" ? "central" : "forward";
      check_pipelines(changed(scene, {"render.gradient=" + gradient, "render.gradient_space=" + space}),
                      {"fragment", "rays"}, context);
    }
  }
}

TEST_CASE("meshes, tables and grids read the levels of the map that they hold", "[one-driver]") {
  gl::Context context = test_context();
  const auto against_fragment = [&](const std::string& warp, const std::vector<std::string>& keys) {
    const PreparedScene scene =
        phantom_scene("marschner-lobb", 48, 24, R"(,"warp":)" + warp, rising(0.1, 1, 0.1));
    const Image fragment = picture(changed(scene, {"render.pipeline=fragment"}), context);
    const double decibels = psnr(picture(changed(scene, keys), context), fragment);
    // Against the same without levels the map's own error alone is left.
    std::vector<std::string> point = keys;
    point.emplace_back("render.footprint=point");
    const double map_alone =
        psnr(picture(changed(scene, point), context),
             picture(changed(scene, {"render.pipeline=fragment", "render.footprint=point"}), context));
    INFO(warp << " " << keys[0] << ": " << decibels << " dB, point " << map_alone);
    CHECK(decibels >= 55);
    // The level follows the map's derivative, which a table's or a grid's differences know less well than the
    // map itself: 72 dB where the fisheye's tables alone are 116 dB from it.
    CHECK(decibels >= std::min(map_alone - 6, 65.0));
  };
  against_fragment(fisheye, {"render.pipeline=axis", "render.axis_texels=1024"});
  against_fragment(R"({"kind":"connected-lens","magnification":0.7,"inner":0.15,"outer":0.4})",
                   {"render.pipeline=axis", "render.axis_texels=1024"});
  against_fragment(fisheye, {"render.pipeline=tessellated", "render.subdivision=128"});
  against_fragment(twist, {"render.pipeline=grid", "render.grid_size=128"});
  // A lens of LaMar's with levels of its own no longer decides: its samples do.
  against_fragment(R"({"kind":"lamar","zoom":3,"inner":0.2,"outer":0.35})",
                   {"render.pipeline=tessellated", "warp.radial_segments=64", "warp.angular_segments=128"});
}

namespace {

/// What a picture of the same view would show if every pixel were the mean of `factor`² rays with `factor`
/// times as many samples each.
Image supersampled(const PreparedScene& scene, int factor, gl::Context& context) {
  const auto times = [&](std::size_t n) { return std::to_string(n * static_cast<std::size_t>(factor)); };
  const RenderSettings& render = scene.scene.render;
  const Image fine =
      picture(changed(scene, {"render.footprint=point", "render.pipeline=rays",
                              "render.size=[" + times(render.size[0]) + "," + times(render.size[1]) + "]",
                              "render.spacing=" + std::to_string(render.spacing / factor)}),
              context);
  Image image = make_image(fine.width / factor, fine.height / factor);
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      for (int c = 0; c < 4; ++c)
        channel(image, x / factor, y / factor, c) +=
            channel(fine, x, y, c) / static_cast<float>(factor * factor);
    }
  }
  return image;
}

} // namespace

TEST_CASE("where a deformation or a small picture squeezes fine detail, levels beat points", "[one-driver]") {
  gl::Context context = test_context();
  struct Squeezed {
    std::string name;
    std::function<double(int, int, int)> pattern; ///< in [0, 1], by voxel
    std::string warp;
    int pixels;
    int factor; ///< of the supersampled picture
  };
  // Waves of 6 voxels that are squeezed 8 times, along the squeezed axis: what a level blurs across it is
  // smooth. A pixel is a displayed voxel, so that the map alone asks for a level. Without a warp a pixel is 9
  // voxels.
  const auto wave = [](int i) { return std::sin(2 * pi * i / 6.0); };
  const std::vector<Squeezed> cases = {
      {"waves squeezed 8 times", [&](int i, int, int) { return 0.5 + 0.5 * wave(i); }, squeeze, 112, 5},
      {"pillars without a warp", [&](int i, int, int k) { return 0.5 + 0.5 * wave(i) * wave(k); }, "[]", 12,
       8}};
  // White, opacity linear in the value: so the mean of values is nearly the mean of what they show. Looked at
  // along y, in which the patterns do not change: rays across a pattern average it by themselves.
  const TransferFunction white{{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 0.05}}, std::nullopt, ""};
  for (const Squeezed& c : cases) {
    const auto window = [](int i) { return std::pow(std::sin(pi * (i + 0.5) / 64), 2); }; // no outline
    Volume volume = volume_of(ScalarType::f32, {64, 64, 64}, [&](int i, int j, int k) {
      return c.pattern(i, j, k) * window(i) * window(j) * window(k);
    });
    const std::string size = std::to_string(c.pixels);
    const PreparedScene scene =
        prepare(scene_from_json(R"({"render":{"size":[)" + size + "," + size +
                                    R"(],"footprint":"mip","background":[0,0,0,0]},"warp":)" + c.warp + "}",
                                "test"),
                std::move(volume), white);
    const Image truth = supersampled(scene, c.factor, context);
    CHECK(share_over(truth, make_image(truth.width, truth.height), 0.02) > 0.02); // there is a picture
    for (const std::string& pipeline :
         {std::string("rays"), std::string(c.warp == "[]" ? "slices" : "fragment")}) {
      const std::string key = "render.pipeline=" + pipeline;
      const double mip = psnr(picture(changed(scene, {key}), context), truth);
      const double point = psnr(picture(changed(scene, {key, "render.footprint=point"}), context), truth);
      INFO(c.name << ", " << pipeline << ": mip " << mip << " dB, point " << point);
      CHECK(mip >= point + 3); // half the mean square error
    }
  }
}

TEST_CASE("footprint mip is refused by name where there is no choice of resolution") {
  const auto refused = [](const std::string& keys, const std::string& name) {
    const std::string text = refusal([&] { (void)scene_from_json(keys, "test"); });
    INFO(keys << ": " << text);
    CHECK(text.find("render.footprint") != std::string::npos);
    CHECK(text.find(name) != std::string::npos);
  };
  const std::string mip = R"({"render":{"footprint":"mip",)";
  refused(mip + R"("classification":"pre"}})", "'pre'");
  refused(mip + R"("pipeline":"fixed-function"}})", "'fixed-function'");
  refused(mip + R"("tiles":[2,1,1]}})", "render.tiles");
  refused(mip + R"("shading":"diffuse","gradient":"prefiltered"}})", "'prefiltered'");
  refused(mip + R"("shading":"diffuse","gradient":"precomputed"}})", "'precomputed'");
  refused(mip + R"("size":[9,9]},"planes":[{}]})", "planes");
  refused(mip + R"("size":[9,9]},"volumes":[{"phantom":"ball"},{"phantom":"box"}]})", "several volumes");
}
