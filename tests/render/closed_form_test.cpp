#include "catch.h"
#include "render_fixture.h"
#include "volume/closed_forms.h"

using namespace slicelens;

namespace {

const std::string oblique = R"("camera":{"azimuth":33,"elevation":21,"roll":10},)";
const std::vector<std::string> pipelines = {"slices", "rays", "reference"};

PreparedScene closed_form_scene(const std::string& phantom, const std::string& pipeline,
                                const std::string& mode, double spacing, int voxels,
                                TransferFunction transfer) {
  const std::string size = std::to_string(voxels);
  return prepare_phantom(
      R"({"volume":{"phantom":")" + phantom + R"(","size":[)" + size + "," + size + "," + size + "]}," +
          oblique + R"("render":{"pipeline":")" + pipeline + R"(","mode":")" + mode +
          R"(","size":[96,96],"target":"rgba32f","filter":"linear-exact","background":[0,0,0,0],"xray_scale":0.02,"spacing":)" +
          std::to_string(spacing) + "}}",
      std::move(transfer));
}

/// Whether pixel (x, y) shows the box.
std::function<bool(int, int)> in_box(const PreparedScene& scene) {
  return [&scene](int x, int y) { return box_chord(scene.box, pixel_ray(scene, x, y)) > 0; };
}

} // namespace

// Bars of 1e-3, over the pixels that show the box: at spacing ¼ a chord is known to ±Δ/2 at either end, which
// at the extinctions used here (optical depth 2 over the box's edge of 128 voxels) is up to τΔ = 4e-3 at
// single pixels; with both phases uniform the mean is τΔ/3 times the transmittance behind.

constexpr int voxels = 128;
const double thin = 1 - std::exp(-2.0 / voxels);

TEST_CASE("a box of constant extinction seen obliquely has the opacity of its chord") {
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    const PreparedScene scene = closed_form_scene("box", pipeline, "dvr", 0.25, voxels, grey(thin));
    const Image image = picture(scene, context);
    const double tau = extinction_from_opacity(thin, scene.unit_distance);
    const double error = mean_error(
        image, 3,
        [&](int x, int y) {
          return opacity_from_extinction(tau, box_chord(scene.box, pixel_ray(scene, x, y)));
        },
        in_box(scene));
    INFO(pipeline << ": " << error);
    CHECK(error <= 1e-3);
  }
}

TEST_CASE("a ramp of opacity and colour matches the integral of emission and absorption") {
  gl::Context context = test_context();
  const glm::dvec4 low(1, 0.2, 0, 0);
  const glm::dvec4 high(0.1, 0.5, 1, 2 * thin);
  for (const std::string& pipeline : pipelines) {
    const PreparedScene scene =
        closed_form_scene("ramp", pipeline, "dvr", 0.25, voxels,
                          {{{0, 1, 0.2, 0, 0}, {1, 0.1, 0.5, 1, 2 * thin}}, std::nullopt, ""});
    const Image image = picture(scene, context);
    for (int c = 0; c < 4; ++c) {
      const double error = mean_error(
          image, c,
          [&](int x, int y) {
            return ramp_dvr(scene.box, pixel_ray(scene, x, y), voxels, low, high, scene.unit_distance)[c];
          },
          in_box(scene));
      INFO(pipeline << " channel " << c << ": " << error);
      CHECK(error <= 1e-3);
    }
  }
}

TEST_CASE("two slabs come in the order in which the ray meets them") {
  gl::Context context = test_context();
  const glm::dvec4 front(1, 0, 0, thin / 2);
  const glm::dvec4 back(0, 0, 1, thin);
  for (const std::string& pipeline : pipelines) {
    const PreparedScene scene =
        closed_form_scene("slabs", pipeline, "dvr", 0.25, voxels, step_transfer(1.5, front, back));
    const Image image = picture(scene, context);
    for (int c = 0; c < 4; ++c) {
      const double error = mean_error(
          image, c,
          [&](int x, int y) {
            return slabs_dvr(scene.box, pixel_ray(scene, x, y), front, back, scene.unit_distance)[c];
          },
          in_box(scene));
      INFO(pipeline << " channel " << c << ": " << error);
      CHECK(error <= 1e-3);
    }
  }
}

TEST_CASE("a blob's X-ray and maximum match their formulas") {
  gl::Context context = test_context();
  // α(v) = v: the identity as transfer function, grey = opacity.
  const TransferFunction identity{{{0, 0, 0, 0, 0}, {1, 1, 1, 1, 1}}, std::nullopt, ""};
  const TransferFunction value_as_grey{{{0, 0, 0, 0, 1}, {1, 1, 1, 1, 1}}, std::nullopt, ""};
  for (const std::string& pipeline : pipelines) {
    const PreparedScene xray = closed_form_scene("blob", pipeline, "xray", 0.5, 128, identity);
    const double xray_error = mean_error(
        picture(xray, context), 0,
        [&](int x, int y) {
          return xray.xray_scale * blob_xray_clipped(xray.box, pixel_ray(xray, x, y), xray.unit_distance);
        },
        in_box(xray));
    INFO(pipeline << ": X-ray " << xray_error);
    CHECK(xray_error <= 1e-3);
    const PreparedScene mip = closed_form_scene("blob", pipeline, "mip", 0.25, 128, value_as_grey);
    const double mip_error = mean_error(
        picture(mip, context), 0, [&](int x, int y) { return blob_mip(mip.box, pixel_ray(mip, x, y)); },
        in_box(mip));
    INFO(pipeline << ": MIP " << mip_error);
    CHECK(mip_error <= 1e-3);
  }
}

TEST_CASE("a ball cut from its distance field by a step converges at first order in the spacing") {
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    std::vector<double> errors;
    for (const double spacing : {2.0, 1.0, 0.5, 0.25}) {
      const PreparedScene scene = closed_form_scene("ball", pipeline, "dvr", spacing, 64,
                                                    step_transfer(0, {1, 1, 1, 0}, {1, 1, 1, 2 * thin}));
      const double tau = extinction_from_opacity(2 * thin, scene.unit_distance);
      errors.push_back(mean_error(
          picture(scene, context), 3,
          [&](int x, int y) {
            return opacity_from_extinction(tau, ball_chord(scene.box, pixel_ray(scene, x, y)));
          },
          [&](int x, int y) { return ball_chord(scene.box, pixel_ray(scene, x, y)) > 0; }));
    }
    INFO(pipeline << ": " << errors[0] << " " << errors[1] << " " << errors[2] << " " << errors[3]);
    // First order halves the error with the spacing; over three halvings the fitted order must be near 1.
    const double order = std::log2(errors[0] / errors[3]) / 3;
    CHECK(order > 0.8);
    CHECK(order < 1.3);
  }
}
