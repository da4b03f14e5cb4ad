#include "catch.h"
#include "render/probe.h"
#include "render_fixture.h"
#include "volume/closed_forms.h"

using namespace slicelens;

namespace {

/// Nothing below `edge`, opacity `alpha` from it on.
TransferFunction step_at(double edge, double alpha) {
  return {{{edge, 1, 1, 1, 0}, {edge + 1e-6, 1, 1, 1, alpha}}, std::nullopt, "step"};
}

PreparedScene scene_of(const std::string& phantom, const std::string& keys, TransferFunction transfer) {
  return prepare_phantom(R"({"volume":{"phantom":")" + phantom +
                             R"(","size":[64,64,64]},"render":{"size":[64,64],"filter":"linear-exact"},)" +
                             keys + "}",
                         std::move(transfer));
}

std::vector<ProbeSample> samples_at(const PreparedScene& scene, const gl::Context& context, double x,
                                    double y) {
  const auto line = probe_line(scene, x, y);
  REQUIRE(line);
  return sample_line(scene, context, *line, probe_sample_count(scene, *line));
}

double distance_between(const PreparedScene& scene, double x, double y) {
  const auto line = probe_line(scene, x, y);
  return (line->far - line->near) / probe_sample_count(scene, *line);
}

} // namespace

TEST_CASE("the first visible sample lies on the ball, in both projections") {
  const gl::Context context = test_context();
  for (const std::string projection : {"orthographic", "perspective"}) {
    const PreparedScene scene =
        scene_of("ball", R"("camera":{"azimuth":33,"elevation":21,"projection":")" + projection + R"("})",
                 step_at(0, 0.5));
    const double h = smallest_spacing(scene.volume);
    const glm::dvec3 middle = center(scene.box);
    int hits = 0;
    for (double y = 20.5; y < 44; y += 4.3) {
      for (double x = 20.5; x < 44; x += 4.3) {
        const Ray ray = ray_from_pixel(scene.view, x, y);
        const double chord = ball_chord(scene.box, ray);
        const auto hit = first_visible(samples_at(scene, context, x, y));
        if (chord < 4 * h) // at the rim half a voxel across the ray is many along it
          continue;
        REQUIRE(hit);
        ++hits;
        const ProbeSample sample = samples_at(scene, context, x, y)[*hit];
        // The line's nearest point to the centre, less half the chord: a length along the ray.
        const double expected = glm::dot(middle - ray.origin, ray.direction) - chord / 2;
        CHECK(std::abs(sample.distance - expected) <= 0.5 * h);
        const glm::dvec3 world = world_from_texture(scene.box, sample.object);
        CHECK(glm::length(world - (ray.origin + sample.distance * ray.direction)) <
              1e-6 * glm::length(world));
        CHECK(glm::length(sample.texture - sample.object) < 1e-6); // nothing is warped
      }
    }
    CHECK(hits > 20);
  }
}

TEST_CASE("the first large gradient is found where the slabs meet, also behind a warp") {
  const gl::Context context = test_context();
  // Seen along y, the default: the slabs' values differ, and meet at t_y = 1/2.
  const std::string look = R"("warp":{"kind":"bifocal","focus":[[0.3,0.7],[0.4,0.6],[0.3,0.7]],
      "shown":[[0.2,0.8],[0.3,0.6],[0.3,0.7]]},"render":{"pipeline":"fragment","size":[64,64],
      "filter":"linear-exact"},"volume":{"phantom":"slabs","size":[64,64,64]})";
  PreparedScene scene = prepare_phantom("{" + look + "}", grey(0.1));
  const std::vector<ProbeSample> samples = samples_at(scene, context, 32.5, 32.5);
  // The largest gradient stands at the crossing; half of it is reached within half a voxel before.
  double largest = 0;
  for (const ProbeSample& s : samples)
    largest = std::max(largest, s.gradient);
  scene.scene.pick.gradient = 0.9 * largest;
  const auto hit = first_gradient(samples, gradient_threshold(scene));
  REQUIRE(hit);
  CHECK(gradient_threshold(scene) == 0.9 * largest);
  // By hand: u = 0.4 + (x − 0.3)·(2/3) is 1/2 at x = 0.45. Central differences over a voxel of the data
  // begin to see the step one voxel and a half before it, that is (1.5/64)·1.5 on display.
  CHECK(samples[*hit].object.y == Approx(0.45).margin(1.5 * 1.5 / 64 + 1.0 / 256));
  CHECK(samples[*hit].texture.y == Approx(0.4 + (samples[*hit].object.y - 0.3) * 2 / 3).margin(1e-5));
}

TEST_CASE("a probe's gradient is of the kind that shades the scene, and central without shading") {
  const gl::Context context = test_context();
  // The ramp rises by one over the box; the focus shows it stretched by 3/2 along x.
  const PreparedScene scene = prepare_phantom(
      R"({"volume":{"phantom":"ramp","size":[64,64,64]},"render":{"pipeline":"fragment","size":[64,64],"filter":"linear-exact"},
      "warp":{"kind":"bifocal","focus":[[0.3,0.7],[0.4,0.6],[0.3,0.7]],"shown":[[0.2,0.8],[0.3,0.6],[0.3,0.7]]}})",
      grey(0.1));
  const double slope = 2.0 / 3 / (64 * smallest_spacing(scene.volume));
  for (const std::string shading : {"none", "diffuse"}) {
    for (const std::string gradient : {"forward", "central", "prefiltered", "precomputed"}) {
      for (const std::string space : {"data", "object"}) {
        if (gradient == "precomputed" && space == "object")
          continue;
        const PreparedScene other =
            changed(scene, {"render.shading=" + shading, "render.gradient=" + gradient,
                            "render.gradient_space=" + space});
        const std::vector<ProbeSample> samples = samples_at(other, context, 32.5, 32.5);
        INFO(shading << " " << gradient << " " << space);
        // Halfs hold the differences of `precomputed`, 11 bits of the range.
        CHECK(samples[samples.size() / 2].gradient == Approx(slope).epsilon(1e-3));
      }
    }
  }
  // Slabs meet in a step, which a Gaussian makes flatter.
  const auto steepest = [&](const std::vector<std::string>& keys) {
    double largest = 0;
    for (const ProbeSample& sample :
         samples_at(changed(scene_of("slabs", R"("title":"")", grey(0.1)), keys), context, 32.5, 32.5))
      largest = std::max(largest, sample.gradient);
    return largest;
  };
  const double central = steepest({});
  CHECK(steepest({"render.gradient=prefiltered"}) == Approx(central)); // there is no copy without shading
  // With weights w of the voxels the copy's voxels beside the step are ½ ± ½w₀, the next ones w₁ farther, so
  // the difference of means over two voxels is w₀ + w₁ where it was 1.
  double sum = 0;
  for (int d = -4; d <= 4; ++d)
    sum += std::exp(-0.5 * d * d);
  CHECK(steepest({"render.gradient=prefiltered", "render.shading=diffuse"}) ==
        Approx((1 + std::exp(-0.5)) / sum * central).epsilon(0.01));
}

TEST_CASE("picking behind a twist finds what the twist shows, to half a voxel") {
  const gl::Context context = test_context();
  // About the line of sight through its centre, a ball is its own twisted picture: the same distances as
  // undeformed, at data points turned by −angle·(y − 1/2).
  const std::string twist =
      R"("warp":{"kind":"twist","axis":"y","angle":90},"render":{"pipeline":"fragment","size":[64,64],"filter":"linear-exact"})";
  const PreparedScene ball =
      prepare_phantom(R"({"volume":{"phantom":"ball","size":[64,64,64]},)" + twist + "}", step_at(0, 0.5));
  const double h = smallest_spacing(ball.volume);
  const glm::dvec3 middle = center(ball.box);
  for (const auto& [x, y] : {std::pair{32.5, 32.5}, {36.5, 30.5}, {28.5, 36.5}}) {
    const Ray ray = ray_from_pixel(ball.view, x, y);
    const std::vector<ProbeSample> samples = samples_at(ball, context, x, y);
    const auto hit = first_visible(samples);
    REQUIRE(hit);
    const double expected = glm::dot(middle - ray.origin, ray.direction) - ball_chord(ball.box, ray) / 2;
    CHECK(std::abs(samples[*hit].distance - expected) <= 0.5 * h);
    const glm::dvec3 p = samples[*hit].object - 0.5;
    const glm::dvec3 u = samples[*hit].texture - 0.5;
    const double angle = glm::radians(-90 * p.y); // R(−angle·q/L) about y takes z to x
    CHECK(u.x == Approx(p.x * std::cos(angle) + p.z * std::sin(angle)).margin(1e-5));
    CHECK(u.z == Approx(-p.x * std::sin(angle) + p.z * std::cos(angle)).margin(1e-5));
    CHECK(u.y == Approx(p.y).margin(1e-5));
  }
  // The slabs meet at t_y = 1/2, which a twist about y leaves where it is.
  PreparedScene slabs =
      prepare_phantom(R"({"volume":{"phantom":"slabs","size":[64,64,64]},)" + twist + "}", step_at(1.5, 0.5));
  const std::vector<ProbeSample> samples = samples_at(slabs, context, 32.5, 32.5);
  const auto visible = first_visible(samples);
  REQUIRE(visible);
  CHECK(std::abs(samples[*visible].object.y - 0.5) <= 0.5 / 64);
  double largest = 0;
  for (const ProbeSample& s : samples)
    largest = std::max(largest, s.gradient);
  const auto steep = first_gradient(samples, 0.99 * largest);
  REQUIRE(steep);
  CHECK(std::abs(samples[*steep].object.y - 0.5) <= 0.5 / 64 + 1.0 / 256);
  // α = 0.5 behind the crossing: the sum reaches one after two reference lengths.
  const double step = distance_between(slabs, 32.5, 32.5);
  const auto accumulated = first_accumulated(samples, step / slabs.unit_distance);
  REQUIRE(accumulated);
  CHECK(std::abs(samples[*accumulated].distance - samples[*visible].distance - 2 * slabs.unit_distance) <=
        0.5 * h);
}

TEST_CASE("summed opacity reaches one where the plain sum says so") {
  const gl::Context context = test_context();
  const PreparedScene scene = scene_of("box", R"("camera":{"azimuth":20,"elevation":10})", grey(0.05));
  const auto line = probe_line(scene, 30.5, 30.5);
  REQUIRE(line);
  const std::vector<ProbeSample> samples = samples_at(scene, context, 30.5, 30.5);
  const double step = distance_between(scene, 30.5, 30.5);
  const auto hit = first_accumulated(samples, step / scene.unit_distance);
  REQUIRE(hit);
  // Σ 0.05·Δs/Δ₀ = 1 after 20 reference lengths; one sample less or more for rounding.
  CHECK(samples[*hit].distance - line->near == Approx(20 * scene.unit_distance).margin(1.5 * step));
  CHECK_FALSE(first_accumulated(samples, 1e-6));
}

TEST_CASE("a line beside the volume meets nothing, and clipping planes shorten it") {
  const gl::Context context = test_context();
  const PreparedScene whole = scene_of("box", R"("camera":{"zoom":0.5})", grey(0.5));
  CHECK_FALSE(probe_line(whole, 1, 1));
  const PreparedScene cut =
      scene_of("box", R"("clip":[{"point":[0.5,0.25,0.5],"normal":[0,1,0],"space":"object"}])", grey(0.5));
  const auto line = probe_line(cut, 32, 32);
  REQUIRE(line);
  CHECK(line->begin.y == Approx(0.25));
  CHECK(line->end.y == Approx(1));
  const auto samples = samples_at(cut, context, 32, 32);
  CHECK(first_visible(samples) == std::optional<std::size_t>(0));
}
