// Kinds of gradient: on volumes whose derivatives are known, and the GPU against the reference.
#include "catch.h"
#include "render/gradient_texture.h"
#include "render_fixture.h"
#include "volume_fixture.h"

using namespace slicelens;

namespace {

const std::string forward = "render.gradient=forward";
const std::string central = "render.gradient=central";
const std::string prefiltered = "render.gradient=prefiltered";
const std::string precomputed = "render.gradient=precomputed";

/// v = x² + 16·y in voxels, x and y from the box's corner, 64³; seen along +y, all that is before the middle
/// cut away, opaque, lit from −x on one side without ambient light: what is shown is −∂v/∂x over the length.
PreparedScene parabola(const std::string& pipeline) {
  Volume volume = volume_of(ScalarType::f32, {64, 64, 64},
                            [](int i, int j, int) { return (i + 0.5) * (i + 0.5) + 16 * (j + 0.5); });
  return prepare(
      scene_from_json(
          R"({"camera":{"parallel_scale":32},"clip":[{"point":[0.5,0.5,0.5],"normal":[0,1,0]}],)"
          R"("light":{"direction":[-1,0,0],"ambient":0,"diffuse":1,"two_sided":false},)"
          R"("render":{"size":[64,64],"filter":"linear-exact","shading":"diffuse","background":[0,0,0,0],"pipeline":")" +
              pipeline + R"("}})",
          "test"),
      std::move(volume), grey(1));
}

/// Largest error over the columns x from 22 to 42, which no kind's taps leave, for ∂v/∂x = 2(x + bias).
double parabola_error(const PreparedScene& scene, double bias, gl::Context& context) {
  const Image image = picture(scene, context);
  double largest = 0;
  int count = 0;
  for (int column = 0; column < 64; ++column) {
    const double x = pixel_ray(scene, column, 32).origin.x + 32; // the box's corner is at −32
    if (x < 22 || x > 42)
      continue;
    const double slope = 2 * (x + bias);
    const double expected = slope / std::sqrt(slope * slope + 16 * 16);
    largest = std::max(largest, std::abs(static_cast<double>(channel(image, column, 32, 0)) - expected));
    ++count;
  }
  REQUIRE(count == 20);
  return largest;
}

const std::string lamar = R"({"kind":"lamar","zoom":2,"center":[0.5,0.4,0.5],"inner":0.15,"outer":0.3})";
const std::string connected =
    R"({"kind":"connected-lens","center":[0.5,0.4375,0.5],"inner":0.15,"outer":0.3125,"magnification":2})";

PreparedScene head_scene(const std::string& warp, bool perspective) {
  return prepare_phantom(
      R"({"volume":{"phantom":"head","size":[40,40,40]},"camera":{"azimuth":33,"elevation":21,"roll":10,"projection":")" +
          std::string(perspective ? "perspective" : "orthographic") +
          R"("},"light":{"direction":[1,-1,0.5]},"render":{"size":[40,40],"filter":"linear-exact","background":[0,0,0,0]},"warp":)" +
          warp + "}",
      rising(-200, 1500, 0.5));
}

/// `keys` by a GPU pipeline against the reference. Under perspective rays, whose samples are the reference's.
void check_gpu(const PreparedScene& scene, std::vector<std::string> keys, const std::string& pipeline,
               gl::Context& context) {
  std::string text;
  for (const std::string& key : keys)
    text += key + " ";
  keys.push_back("render.pipeline=" + pipeline);
  const Image gpu = picture(changed(scene, keys), context);
  keys.back() = "render.pipeline=reference";
  const Image truth = picture(changed(scene, keys), context);
  const double decibels = psnr(gpu, truth);
  INFO(pipeline << ", " << text << ": " << decibels);
  CHECK(decibels >= 60);
  CHECK(share_over(truth, make_image(truth.width, truth.height), 0.02) > 0.05); // there is a picture
}

/// Every shading by every kind of gradient under one warp.
void check_matrix(const std::string& warp, const std::vector<std::string>& more_keys) {
  gl::Context context = test_context();
  for (const bool perspective : {false, true}) {
    const PreparedScene scene = head_scene(warp, perspective);
    const std::string pipeline = perspective ? "rays" : warp == "[]" ? "slices" : "fragment";
    for (const std::string shading : {"diffuse", "phong", "tone"}) {
      for (const std::string& gradient : {forward, central, prefiltered, precomputed}) {
        std::vector<std::string> keys = {"render.shading=" + shading, gradient};
        const bool in_object = more_keys.size() == 1 && more_keys[0] == "render.gradient_space=object";
        if (in_object && gradient == precomputed)
          continue;
        keys.insert(keys.end(), more_keys.begin(), more_keys.end());
        check_gpu(scene, keys, pipeline, context);
      }
    }
  }
}

} // namespace

TEST_CASE("derivatives of a parabola: central kinds are exact, forward is half a voxel ahead") {
  gl::Context context = test_context();
  for (const std::string pipeline : {"slices", "rays", "reference"}) {
    const PreparedScene scene = parabola(pipeline);
    INFO(pipeline);
    // Differences of floats near 3000 over two voxels: 2e-4 of 90.
    const double rounding = pipeline == "reference" ? 1e-6 : 1e-5;
    CHECK(parabola_error(changed(scene, {forward}), 0.5, context) < rounding);
    CHECK(parabola_error(changed(scene, {central}), 0, context) < rounding);
    // Shares of a range of 5000 as halfs: 11 bits.
    CHECK(parabola_error(changed(scene, {precomputed}), 0, context) <
          (pipeline == "reference" ? 1e-6 : 3e-4));
    // A Gaussian lifts a parabola by the same everywhere; what is left is the weights' rounding.
    for (const std::string resolution : {"full", "half", "quarter"}) {
      const PreparedScene smooth = changed(scene, {prefiltered, "render.gradient_resolution=" + resolution});
      CHECK(parabola_error(smooth, 0, context) < (pipeline == "reference" ? 1e-6 : 2e-5));
    }
  }
}

TEST_CASE("under a map that stretches, both spaces give the gradient of what is shown") {
  gl::Context context = test_context();
  // Linear in the data; the focus is shown stretched by 2, 3 and 4, so derivatives shrink by these.
  const Volume volume =
      volume_of(ScalarType::f32, {48, 48, 48}, [](int i, int j, int k) { return i + 2 * j + 3 * k; });
  PreparedScene scene = prepare(
      scene_from_json(
          R"({"camera":{"parallel_scale":24},"clip":[{"point":[0.5,0.5,0.5],"normal":[0,1,0],"space":"object"}],)"
          R"("light":{"direction":[-1,0,0],"ambient":0,"diffuse":1,"two_sided":false},)"
          R"("warp":{"kind":"bifocal","focus":[[0.35,0.65],[0.4,0.6],[0.425,0.575]],"shown":[[0.2,0.8],[0.2,0.8],[0.2,0.8]]},)"
          R"("render":{"size":[8,8],"filter":"linear-exact","shading":"diffuse","background":[0,0,0,0]}})",
          "test"),
      volume, grey(1));
  const glm::dvec3 gradient = glm::dvec3(1, 2, 3) / glm::dvec3(2, 3, 4);
  const double expected = gradient.x / glm::length(gradient);
  for (const std::string pipeline : {"axis", "fragment", "rays", "reference"}) {
    for (const std::string space : {"data", "object"}) {
      for (const std::string& kind : {forward, central, prefiltered}) {
        const Image image = picture(
            changed(scene, {kind, "render.gradient_space=" + space, "render.pipeline=" + pipeline}), context);
        INFO(pipeline << " " << space << " " << kind);
        CHECK(static_cast<double>(channel(image, 4, 4, 0)) == Approx(expected).margin(2e-4));
      }
    }
  }
}

TEST_CASE("shading by gradient, without a warp", "[one-driver]") { check_matrix("[]", {}); }
TEST_CASE("shading by gradient, under LaMar's lens", "[one-driver]") { check_matrix(lamar, {}); }
TEST_CASE("shading by gradient, under the connected lens", "[one-driver]") { check_matrix(connected, {}); }
TEST_CASE("shading by gradient in object space, under LaMar's lens", "[one-driver]") {
  check_matrix(lamar, {"render.gradient_space=object"});
}
TEST_CASE("shading by gradient in object space, under the connected lens", "[one-driver]") {
  check_matrix(connected, {"render.gradient_space=object"});
}

TEST_CASE("coarser copies, other sigmas and filters are the reference's as well", "[one-driver]") {
  gl::Context context = test_context();
  const PreparedScene scene = head_scene(connected, false);
  for (const std::string resolution : {"half", "quarter"}) {
    for (const std::string space : {"data", "object"})
      check_gpu(scene,
                {"render.shading=phong", prefiltered, "render.gradient_resolution=" + resolution,
                 "render.gradient_space=" + space},
                "fragment", context);
  }
  for (const std::string filter : {"linear", "cubic"}) {
    for (const std::string& gradient : {prefiltered, precomputed})
      check_gpu(scene,
                {"render.shading=diffuse", gradient, "render.filter=" + filter, "render.gradient_sigma=0.6"},
                "fragment", context);
  }
}

TEST_CASE("tables, grids and tessellations take the gradients of the exact map", "[one-driver]") {
  gl::Context context = test_context();
  for (const std::string space : {"data", "object"}) {
    for (const std::string& gradient : {forward, central, prefiltered, precomputed}) {
      if (space == "object" && gradient == precomputed)
        continue;
      for (const auto& [warp, pipeline] :
           {std::pair(lamar, std::string("tessellated")), std::pair(connected, std::string("axis")),
            std::pair(connected, std::string("grid"))}) {
        const PreparedScene scene = changed(head_scene(warp, false), {"render.shading=phong", gradient,
                                                                      "render.gradient_space=" + space,
                                                                      "render.grid_size=[65,65,65]"});
        const double decibels = psnr(picture(changed(scene, {"render.pipeline=" + pipeline}), context),
                                     picture(changed(scene, {"render.pipeline=fragment"}), context));
        INFO(pipeline << " " << space << " " << gradient << ": " << decibels);
        // Chords of a circle, texels of a table and nodes of a grid (docs/tolerances.md).
        CHECK(decibels >= 42);
      }
    }
  }
}

TEST_CASE("the kinds of gradient differ, and the second texture is counted") {
  gl::Context context = test_context();
  const PreparedScene scene = changed(head_scene("[]", false), {"render.shading=diffuse"});
  const RenderResult usual = render(changed(scene, {central}), &context, {});
  const auto more = [&](const std::vector<std::string>& keys) {
    const RenderResult other = render(changed(scene, keys), &context, {});
    // Differences of a trilinear interpolant are the interpolated differences: central and precomputed agree.
    if (keys[0] == precomputed)
      CHECK(psnr(other.image, usual.image) > 60);
    else
      CHECK(psnr(other.image, usual.image) < 50);
    return other.texture_bytes - usual.texture_bytes;
  };
  CHECK(more({precomputed}) == 6 * 40 * 40 * 40);
  CHECK(more({prefiltered}) == 4 * 40 * 40 * 40);
  CHECK(more({prefiltered, "render.gradient_resolution=half"}) == 4 * 20 * 20 * 20);
  CHECK(more({prefiltered, "render.gradient_resolution=quarter"}) == 4 * 10 * 10 * 10);
}

TEST_CASE("gradient and value in one texture show what two textures show") {
  gl::Context context = test_context();
  const PreparedScene scene = changed(head_scene(connected, true), {"render.shading=phong", precomputed});
  const std::string floats = "render.gradient_texture=rgba32f";
  for (const std::string pipeline : {"fragment", "rays"}) {
    for (const std::string filter : {"linear-exact", "cubic"}) { // cubic reads the value from its own texture
      const std::vector<std::string> keys = {"render.pipeline=" + pipeline, "render.filter=" + filter};
      const PreparedScene two = changed(scene, keys);
      const PreparedScene one = changed(two, {floats});
      CHECK(reads_value_with_gradient(one) == (filter == "linear-exact"));
      const Image halfs = picture(two, context);
      // Halfs turn normals by up to 0.03°, under the power of the highlight less than 1/255; the value is
      // exact.
      CHECK(max_difference(halfs, picture(one, context)) < 1.0 / 255);
    }
  }
  const PreparedScene plain = changed(head_scene("[]", false), {"render.shading=diffuse", precomputed});
  CHECK(render(changed(plain, {floats}), &context, {}).texture_bytes -
            render(plain, &context, {}).texture_bytes ==
        (16 - 6) * 40 * 40 * 40);
  CHECK_THROWS_WITH(changed(plain, {central, floats}), Catch::Contains("render.gradient_texture"));
}
