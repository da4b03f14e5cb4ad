// Modes beside dvr against formulas, and filters and gradients on Marschner and Lobb's signal: what the
// tables of docs/accuracy.md claim, at a small size.
#include "catch.h"
#include "render_fixture.h"
#include "study/statistics.h"
#include "volume/closed_forms.h"

#include <cstring>

using namespace slicelens;

namespace {

const std::vector<std::string> pipelines = {"slices", "rays", "reference"};
const TransferFunction value_as_opacity{{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 1}}, std::nullopt, ""};

PreparedScene oblique(const std::string& phantom, int voxels, int pixels, const TransferFunction& transfer,
                      const std::string& projection = "orthographic") {
  const std::string n = std::to_string(voxels);
  const std::string size = std::to_string(pixels);
  return prepare_phantom(
      R"({"volume":{"phantom":")" + phantom + R"(","size":[)" + n + "," + n + "," + n +
          R"(]},"camera":{"azimuth":33,"elevation":21,"roll":10,"view_angle":40,"projection":")" +
          projection + R"("},"render":{"size":[)" + size + "," + size +
          R"(],"target":"rgba32f","filter":"linear-exact","background":[0,0,0,0]}})",
      transfer);
}

/// A shorter chord may hold no sample at spacing 2, the coarsest here, and then shows nothing.
std::function<bool(int, int)> crossed(const PreparedScene& scene) {
  return [&scene](int x, int y) { return box_chord(scene.box, pixel_ray(scene, x, y)) >= 2; };
}

/// Mean error of a mode on the ramp at spacings 2, 1, ½ and ¼.
std::vector<double> ramp_errors(const PreparedScene& ramp, const std::string& mode,
                                const std::string& pipeline, double RampRange::*value, gl::Context& context) {
  std::vector<double> errors;
  for (const char* spacing : {"2", "1", "0.5", "0.25"}) {
    const PreparedScene scene = changed(ramp, {"render.mode=" + mode, "render.pipeline=" + pipeline,
                                               std::string("render.spacing=") + spacing});
    errors.push_back(mean_error(
        picture(scene, context), 3,
        [&](int x, int y) { return (*ramp_range(scene.box, pixel_ray(scene, x, y), 32)).*value; },
        crossed(scene)));
  }
  return errors;
}

/// A black surface under a white highlight about the box's middle, which falls linearly on every axis: the
/// picture says where each surface point lies.
PreparedScene coded_ball(int voxels, int pixels, const std::string& projection) {
  PreparedScene ball = oblique("ball", voxels, pixels, constant_transfer({0, 0, 0, 1}), projection);
  return changed(ball, {"render.mode=iso", "render.isovalue=0", "render.pipeline=rays",
                        R"(highlight={"function":"distance","color":[1,1,1],
                                      "focus":[[0.4,0.6],[0.4,0.6],[0.4,0.6]]})"});
}

double place_code(const Box& box, const glm::dvec3& world) {
  const glm::dvec3 t(texture_from_world(box) * glm::dvec4(world, 1));
  return (1 - 2 * std::abs(t.x - 0.5)) * (1 - 2 * std::abs(t.y - 0.5)) * (1 - 2 * std::abs(t.z - 0.5));
}

/// The longer one of the ray's two ways in the box outside of a ball with this chord: a crossing needs a
/// sample there too.
double air_beside(const PreparedScene& scene, const Ray& ray, double chord) {
  const glm::dmat4 to_texture = texture_from_world(scene.box);
  const auto inside = intersect_unit_cube({glm::dvec3(to_texture * glm::dvec4(ray.origin, 1)),
                                           glm::dvec3(to_texture * glm::dvec4(ray.direction, 0))});
  const double middle = glm::dot(center(scene.box) - ray.origin, ray.direction);
  return inside ? std::max(middle - chord / 2 - inside->near, inside->far - middle - chord / 2) : 0;
}

} // namespace

TEST_CASE("least, largest and mean values on the ramp are met at first order") {
  gl::Context context = test_context();
  const std::vector<double> spacings = {2, 1, 0.5, 0.25};
  const std::vector<std::pair<std::string, double RampRange::*>> modes = {
      {"minip", &RampRange::least}, {"mip", &RampRange::most}, {"average", &RampRange::average}};
  for (const char* projection : {"orthographic", "perspective"}) {
    const PreparedScene ramp = oblique("ramp", 32, 32, value_as_opacity, projection);
    for (const auto& [mode, value] : modes) {
      for (const std::string& pipeline : pipelines) {
        const std::vector<double> errors = ramp_errors(ramp, mode, pipeline, value, context);
        INFO(projection << " " << mode << " " << pipeline << ": " << errors[0] << " " << errors[3]);
        // The first sample lies up to a spacing behind the entry, on average half of one, and the value
        // changes by at most 1/32 a voxel.
        CHECK(errors[3] <= 0.5 * 0.25 / 32);
        const double order = fitted_order(spacings, errors);
        CHECK(order > 0.85);
        CHECK(order < 1.2);
      }
    }
  }
}

TEST_CASE("the minimum of a hollow and the mean of a blob converge with the voxels at second order") {
  gl::Context context = test_context();
  for (const std::string& pipeline : pipelines) {
    std::vector<double> hollow_errors;
    std::vector<double> mean_errors;
    for (const int n : {16, 32, 64}) {
      PreparedScene scene =
          changed(oblique("blob", n, 32, value_as_opacity),
                  {"render.pipeline=" + pipeline, "render.spacing=0.25", "render.mode=average"});
      mean_errors.push_back(mean_error(
          picture(scene, context), 3,
          [&](int x, int y) { return blob_average(scene.box, pixel_ray(scene, x, y)); }, crossed(scene)));
      for (std::size_t i = 0; i < scene.volume.voxels.size(); i += sizeof(float)) { // 1 − blob
        float value = 0;
        std::memcpy(&value, &scene.volume.voxels[i], sizeof value);
        value = 1 - value;
        std::memcpy(&scene.volume.voxels[i], &value, sizeof value);
      }
      update_statistics(scene.volume);
      const PreparedScene hollow = changed(scene, {"render.mode=minip"});
      hollow_errors.push_back(mean_error(
          picture(hollow, context), 3,
          [&](int x, int y) { return 1 - blob_mip(hollow.box, pixel_ray(hollow, x, y)); }, crossed(hollow)));
    }
    INFO(pipeline << ": hollow " << hollow_errors[0] << " " << hollow_errors[2] << ", mean " << mean_errors[0]
                  << " " << mean_errors[2]);
    const std::vector<double> widths = {1.0 / 16, 1.0 / 32, 1.0 / 64};
    // Half the voxels' width and, as it is in voxels, half the spacing: a quarter of the error. The mean's
    // error also holds the unknown ends, of first order, where the blob is near nothing.
    CHECK(fitted_order(widths, hollow_errors) > 1.8);
    CHECK(fitted_order(widths, mean_errors) > 1.6);
    CHECK(hollow_errors[2] < 5e-4);
  }
}

TEST_CASE("the first surface of a ball is a voxel's square away from the sphere") {
  gl::Context context = test_context();
  for (const char* projection : {"orthographic", "perspective"}) {
    for (const std::string pipeline : {"fragment", "rays", "reference"}) {
      std::vector<double> errors; // along the ray, voxels
      for (const int n : {16, 32, 64}) {
        const PreparedScene scene = changed(coded_ball(n, 40, projection), {"render.pipeline=" + pipeline});
        const Image image = picture(scene, context);
        double sum = 0;
        int count = 0;
        for (int y = 0; y < 40; ++y) {
          for (int x = 0; x < 40; ++x) {
            const Ray ray = pixel_ray(scene, x, y);
            const auto hit = sphere_hit(center(scene.box), kBallRadius * n, ray);
            if (!hit)
              continue;
            const glm::dvec3 point = ray.origin + *hit * ray.direction;
            const double code = place_code(scene.box, point);
            const double slope = place_code(scene.box, point + 1e-3 * ray.direction) - code;
            const double cosine = -glm::dot(point, ray.direction) / (kBallRadius * n);
            if (cosine < 0.5 || std::abs(slope) * n < 0.5e-3) // grazing, or the code says little
              continue;
            sum += std::abs((static_cast<double>(channel(image, x, y, 0)) - code) / slope) * 1e-3;
            ++count;
          }
        }
        REQUIRE(count > 100);
        errors.push_back(sum / count);
      }
      INFO(projection << " " << pipeline << ": " << errors[0] << " " << errors[1] << " " << errors[2]);
      // Linear interpolation of a distance from a sphere of radius R errs by up to 1/(4R) across it, in
      // voxels; seen under up to 60° that is at most doubled.
      for (std::size_t i = 0; i < 3; ++i)
        CHECK(errors[i] < 2 / (4 * kBallRadius * 16 * std::pow(2.0, static_cast<double>(i))));
      CHECK(errors[2] < 0.35 * errors[0]); // in voxels first order, so in lengths second
    }
  }
}

TEST_CASE("a surface is missed only where the ray's way behind it or before it is shorter than a step") {
  gl::Context context = test_context();
  for (const std::string pipeline : {"fragment", "rays", "reference"}) {
    for (const double spacing : {8.0, 3.0, 1.0}) {
      const PreparedScene scene =
          changed(coded_ball(32, 64, "orthographic"),
                  {"render.pipeline=" + pipeline, "render.spacing=" + std::to_string(spacing)});
      const Image image = picture(scene, context);
      int missed = 0;
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          const Ray ray = pixel_ray(scene, x, y);
          const bool shown = channel(image, x, y, 3) > 0.5F;
          const double radius = kBallRadius * 32;
          // Interpolation makes the ball smaller by up to 1/(4R) = 0.02 voxels.
          const double chord = sphere_chord(center(scene.box), radius - 0.02, ray);
          INFO(pipeline << ", spacing " << spacing << ", chord " << chord);
          if (!shown) {
            CHECK((chord <= spacing || air_beside(scene, ray, chord) <= spacing));
            missed += chord > 0 ? 1 : 0;
          } else {
            CHECK(sphere_chord(center(scene.box), radius, ray) > 0);
          }
        }
      }
      if (spacing == 8)
        CHECK(missed > 0); // the law is tight enough to be seen
    }
  }
}

TEST_CASE("two labelled slabs seen obliquely: composited, and a line integral in front") {
  gl::Context context = test_context();
  constexpr int n = 32;
  const double a = 1 - std::exp(-2.0 / n);
  for (const LabelMode mode : {LabelMode::dvr, LabelMode::xray}) {
    for (const std::string& pipeline : pipelines) {
      if (mode == LabelMode::xray && pipeline == "slices")
        continue; // slices have no runs
      std::vector<double> errors;
      for (const char* spacing : {"1", "0.25"}) {
        PreparedScene scene =
            changed(oblique("slabs", n, 32, grey(0)),
                    {"render.pipeline=" + pipeline, std::string("render.spacing=") + spacing});
        scene.scene.render.mode = Mode::two_level;
        scene.scene.volume.labels = "halves";
        scene.scene.labels = {{1, "", mode, std::nullopt, true}, {2, "", LabelMode::dvr, std::nullopt, true}};
        Volume labels = scene.volume;
        labels.type = ScalarType::u8;
        labels.voxels.resize(std::size_t{n} * n * n);
        for (std::size_t i = 0; i < labels.voxels.size(); ++i)
          labels.voxels[i] = static_cast<std::byte>(i / n % n < n / 2 ? 1 : 2);
        update_statistics(labels);
        scene = prepare(
            scene.scene, scene.volume, grey(0), {},
            LoadedLabels{labels, {constant_transfer({1, 0, 0, a / 2}), constant_transfer({0, 0, 1, a})}});
        const glm::dvec4 front(1, 0, 0, a / 2);
        const glm::dvec4 back(0, 0, 1, a);
        const Image image = picture(scene, context);
        double worst = 0;
        for (int c = 0; c < 4; ++c) {
          worst = std::max(worst,
                           mean_error(
                               image, c,
                               [&](int x, int y) {
                                 const Ray ray = pixel_ray(scene, x, y);
                                 return mode == LabelMode::dvr
                                            ? slabs_dvr(scene.box, ray, front, back, scene.unit_distance)[c]
                                            : slabs_xray_front(scene.box, ray, front, back,
                                                               scene.unit_distance, scene.xray_scale)[c];
                               },
                               crossed(scene)));
        }
        errors.push_back(worst);
      }
      INFO(pipeline << (mode == LabelMode::dvr ? " dvr " : " xray ") << errors[0] << " " << errors[1]);
      // As for the other closed forms: a third of τΔ = 2/32·¼ at most.
      CHECK(errors[1] <= 2.0 / n * 0.25 / 3);
      CHECK(errors[1] < 0.4 * errors[0]); // a quarter at first order
    }
  }
}

TEST_CASE("filters reconstruct Marschner and Lobb's signal at their orders") {
  gl::Context context = test_context();
  const auto error = [&](const std::string& filter, int n) {
    PreparedScene scene = oblique("marschner-lobb", n, 32, grey(0));
    const glm::dvec3 focus = world_from_texture(scene.box, {0.7, 0.6, 0.5});
    const glm::dvec3 forward = scene.view.forward;
    CameraSettings& camera = scene.scene.camera;
    camera = {};
    camera.focal_point = focus;
    camera.position = focus - 4.0 * n * forward;
    camera.view_up = scene.view.up;
    camera.parallel_scale = n / 8.0;
    PlaneSettings plane;
    plane.point = glm::dvec3(0.7, 0.6, 0.5);
    plane.normal = -forward;
    plane.range = glm::dvec2(0, 1);
    scene.scene.planes = {plane};
    prepare_again(scene);
    scene = changed(scene, {"render.filter=" + filter});
    return mean_error(picture(scene, context), 0, [&](int x, int y) {
      const Ray ray = pixel_ray(scene, x, y);
      const double s = glm::dot(focus - ray.origin, ray.direction);
      return marschner_lobb(
          glm::dvec3(texture_from_world(scene.box) * glm::dvec4(ray.origin + s * ray.direction, 1)));
    });
  };
  const double nearest = error("nearest", 80);
  const double linear = error("linear-exact", 80);
  const double cubic = error("cubic", 80);
  INFO("nearest " << nearest << ", linear " << linear << ", cubic " << cubic);
  // Half the width is half of the nearest voxel's error and a quarter of the others', nearly: at 80³ a ring
  // has 6.6 voxels and the next term of the series still counts.
  CHECK(nearest / error("nearest", 160) == Approx(2).epsilon(0.15));
  CHECK(linear / error("linear-exact", 160) == Approx(4).epsilon(0.15));
  CHECK(cubic / error("cubic", 160) == Approx(4).epsilon(0.15));
  // ∫f(1 − f)/2 = 1/12 of h²f'' on each axis for linear, 1/6 for the B-spline.
  CHECK(cubic / linear == Approx(2).epsilon(0.15));
  CHECK(nearest > 2 * linear);
}

TEST_CASE("gradients on Marschner and Lobb's signal") {
  gl::Context context = test_context();
  const auto angle = [&](const std::vector<std::string>& keys, int n) {
    // Cut across the view, opaque, lit along each axis: the first slice behind the cut shows k = (1 + n·l)/2.
    PreparedScene scene = oblique("marschner-lobb", n, 20, constant_transfer({0, 0, 0, 1}));
    ClipSettings cut;
    cut.normal = scene.view.forward;
    scene.scene.clip = {cut};
    scene.scene.light.cool = glm::dvec3(0);
    scene.scene.light.warm = glm::dvec3(1);
    prepare_again(scene);
    scene = changed(scene, {"render.shading=tone", "render.spacing=0.25"});
    scene = changed(scene, keys);
    std::vector<Image> along;
    for (const char* light : {"[1,0,0]", "[0,1,0]", "[0,0,1]"})
      along.push_back(picture(changed(scene, {std::string("light.direction=") + light}), context));
    double sum = 0;
    int count = 0;
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 20; ++x) {
        const Ray ray = pixel_ray(scene, x, y);
        const double s = 0.5 * scene.spacing - glm::dot(ray.origin, ray.direction);
        const glm::dvec3 t(texture_from_world(scene.box) * glm::dvec4(ray.origin + s * ray.direction, 1));
        if (glm::any(glm::greaterThan(glm::abs(t - 0.5), glm::dvec3(0.375))))
          continue;
        glm::dvec3 seen;
        for (std::size_t c = 0; c < 3; ++c)
          seen[static_cast<int>(c)] = 2 * static_cast<double>(channel(along[c], x, y, 0)) - 1;
        const double cosine = glm::dot(glm::normalize(seen), -glm::normalize(marschner_lobb_gradient(t)));
        sum += glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
        ++count;
      }
    }
    REQUIRE(count > 50);
    return sum / count;
  };
  const double central = angle({"render.gradient=central"}, 80);
  const double forward = angle({"render.gradient=forward"}, 80);
  const double full = angle({"render.gradient=prefiltered"}, 80);
  const double quarter = angle({"render.gradient=prefiltered", "render.gradient_resolution=quarter"}, 80);
  const double precomputed = angle({"render.gradient=precomputed"}, 80);
  const double finer = angle({"render.gradient=central"}, 160);
  const double finer_forward = angle({"render.gradient=forward"}, 160);
  INFO("central " << central << ", " << finer << ", forward " << forward << ", " << finer_forward << ", full "
                  << full << ", quarter " << quarter << ", precomputed " << precomputed);
  CHECK(finer < 0.4 * central);          // second order
  CHECK(finer_forward > 0.35 * forward); // first
  CHECK(forward > central);
  CHECK(full > central); // smoothing takes what is there away
  CHECK(quarter > 2 * full);
  CHECK(precomputed == Approx(central).margin(0.1)); // halfs of the data's range: 0.03° and their sum
}

TEST_CASE("over the view angle: shells, planes corrected by fragment, by frame, not at all") {
  gl::Context context = test_context();
  for (const char* angle : {"2", "60", "150"}) {
    const PreparedScene head = changed(oblique("head", 40, 32, rising(-340, 1310, 0.002), "perspective"),
                                       {std::string("camera.view_angle=") + angle, "render.spacing=0.5"});
    const Image rays = picture(changed(head, {"render.pipeline=rays"}), context);
    const auto against_rays = [&](const std::string& key) {
      return psnr(picture(changed(head, {key}), context), rays);
    };
    const double shells = against_rays("render.proxy=shells");
    const double fragment = against_rays("render.opacity_correction=fragment");
    const double frame = against_rays("render.opacity_correction=frame");
    const double none = against_rays("render.opacity_correction=none");
    INFO(angle << "°: shells " << shells << ", fragment " << fragment << ", frame " << frame << ", none "
               << none);
    CHECK(shells > 100);
    CHECK(shells > fragment);
    CHECK(fragment > 80);
    CHECK(none < frame);
    // At 2° rays are all but parallel, and 1/cos θ is 1.00015. Elsewhere planes and shells still sample other
    // points half a voxel apart, which leaves 98 dB at 60°; parity_test.cpp asks for 20 dB at half that
    // spacing.
    if (std::string(angle) != "2")
      CHECK(fragment > frame + 8);
  }
}
