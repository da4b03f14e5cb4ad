// Diffuse light against the analytic normals of a ball, and every shader that can be asked for.
#include "catch.h"
#include "render/rays.h"
#include "render/slices.h"
#include "render_fixture.h"
#include "volume/closed_forms.h"

using namespace slicelens;

namespace {

constexpr double radius = 0.4 * 64; // of phantom ball at 64³, world units

/// The ball as an opaque surface without ambient light. The camera looks along (1, 1, −1)/√3.
PreparedScene ball_scene(const std::string& pipeline, const std::string& gradient,
                         const std::string& direction) {
  return prepare_phantom(
      R"({"volume":{"phantom":"ball","size":[64,64,64]},"camera":{"position":[-80,-80,80],"parallel_scale":28},)"
      R"("light":{"ambient":0,"diffuse":1,"two_sided":false,"direction":)" +
          direction +
          R"(},"render":{"size":[64,64],"spacing":0.25,"filter":"linear-exact","background":[0,0,0,0],)"
          R"("shading":"diffuse","gradient":")" +
          gradient + R"(","pipeline":")" + pipeline + R"("}})",
      step_transfer(0, {1, 1, 1, 0}, {1, 1, 1, 1}));
}

/// Outward normal where the ray first meets the ball; nothing beyond 90 % of its radius, where a quarter of a
/// voxel along the ray goes far round the surface.
std::optional<glm::dvec3> normal_at(const Ray& ray) {
  const double middle = -glm::dot(ray.origin, ray.direction);
  const double b2 = glm::dot(ray.origin, ray.origin) - middle * middle;
  if (b2 > 0.81 * radius * radius)
    return std::nullopt;
  const double s = middle - std::sqrt(radius * radius - b2);
  return (ray.origin + s * ray.direction) / radius;
}

} // namespace

TEST_CASE("normals of a ball, from three lights", "[one-driver]") {
  gl::Context context = test_context();
  const glm::dvec3 lights[3] = {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  const std::string texts[3] = {"[-1,0,0]", "[0,-1,0]", "[0,0,1]"};
  for (const std::string pipeline : {"slices", "rays", "reference"}) {
    for (const std::string gradient : {"forward", "central"}) {
      const PreparedScene scene = ball_scene(pipeline, gradient, texts[0]);
      Image pictures[3];
      for (int i = 0; i < 3; ++i)
        pictures[i] = picture(ball_scene(pipeline, gradient, texts[i]), context);
      double sum = 0;
      double largest = 0;
      int count = 0;
      for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
          const auto normal = normal_at(pixel_ray(scene, x, y));
          // Only where all three lights reach: one-sided light says nothing elsewhere.
          if (!normal || glm::dot(*normal, lights[0]) < 0.1 || glm::dot(*normal, lights[1]) < 0.1 ||
              glm::dot(*normal, lights[2]) < 0.1)
            continue;
          glm::dvec3 seen(0);
          for (int i = 0; i < 3; ++i)
            seen += static_cast<double>(channel(pictures[i], x, y, 0)) * lights[i];
          const double cosine = glm::dot(glm::normalize(seen), *normal);
          const double degrees = glm::degrees(std::acos(std::min(1.0, cosine)));
          sum += degrees;
          largest = std::max(largest, degrees);
          ++count;
        }
      }
      INFO(pipeline << ", " << gradient << ": mean " << sum / count << ", largest " << largest);
      REQUIRE(count > 200);
      // The sample lies up to Δ = ¼ voxel behind the surface: up to ¼·tan(incidence)/25.6 rad = .6°/√3 … in
      // the mean .2°. A forward difference is centred half a voxel off on each axis, √3/2/25.6 rad = 1.9°
      // where that offset is tangential.
      CHECK(sum / count < (gradient == "central" ? 0.4 : 2.0));
      CHECK(largest < (gradient == "central" ? 1.5 : 3.5));
    }
  }
}

TEST_CASE("light at the camera, on both sides or one", "[one-driver]") {
  gl::Context context = test_context();
  for (const std::string projection : {"orthographic", "perspective"}) {
    for (const std::string pipeline : {"slices", "rays", "reference"}) {
      const PreparedScene scene =
          changed(ball_scene(pipeline, "central", "null"),
                  {"camera.projection=" + projection, "light.ambient=0.1", "light.diffuse=0.8"});
      const auto expected = [&](int x, int y) {
        const Ray ray = pixel_ray(scene, x, y);
        return 0.1 + 0.8 * glm::dot(*normal_at(ray), -ray.direction);
      };
      const double error = mean_error(picture(scene, context), 0, expected, [&](int x, int y) {
        return normal_at(pixel_ray(scene, x, y)).has_value();
      });
      INFO(pipeline << ", " << projection << ": " << error);
      CHECK(error < 0.005); // .4° of angle (see above) change the cosine by at most .007
    }
  }
  // From behind only the ambient share is left on one side, and all of the light on two.
  const PreparedScene behind = changed(ball_scene("slices", "central", "[0.57735,0.57735,-0.57735]"),
                                       {"light.ambient=0.1", "light.diffuse=0.8"});
  CHECK(channel(picture(behind, context), 32, 32, 0) == Approx(0.1).margin(1e-4));
  CHECK(channel(picture(changed(behind, {"light.two_sided=true"}), context), 32, 32, 0) ==
        Approx(0.9).margin(0.005));
}

TEST_CASE("every shader that a scene can ask for compiles") {
  gl::Context context = test_context();
  const gl::Functions& gl = context.functions();
  const PreparedScene base = prepare_phantom(R"({"volume":{"phantom":"blob","size":[4,4,4]}})", grey(0.5));
  int count = 0;
  for (const std::string look : {"render.mode=dvr", "render.mode=mip", "render.mode=xray",
                                 "render.gradient=forward", "render.gradient=central"}) {
    for (const std::string filter : {"nearest", "linear", "linear-exact"}) {
      for (const std::string projection : {"orthographic", "perspective"}) {
        for (const std::string correction : {"none", "frame", "fragment"}) {
          for (const std::string light : {"null", "[1,0,0]"}) {
            const bool lit = look.find("gradient") != std::string::npos;
            if (!lit && light != "null")
              continue;
            const PreparedScene scene =
                changed(base, {look, "render.filter=" + filter, "camera.projection=" + projection,
                               "render.opacity_correction=" + correction, "light.direction=" + light,
                               lit ? "render.shading=diffuse" : "render.shading=none", "render.spacing=0.5"});
            INFO(look << " " << filter << " " << projection << " " << correction << " " << light);
            CHECK_NOTHROW(SliceRenderer(gl, scene));
            CHECK_NOTHROW(RayRenderer(gl, changed(scene, {"render.pipeline=rays"})));
            CHECK_NOTHROW(
                RayRenderer(gl, changed(scene, {"render.pipeline=rays", "render.early_termination=0.9",
                                                R"(clip=[{"normal":[1,0,0]},{"normal":[0,1,0]}])"})));
            ++count;
          }
        }
      }
    }
  }
  CHECK(count == (3 + 2 * 2) * 3 * 2 * 3);
}
