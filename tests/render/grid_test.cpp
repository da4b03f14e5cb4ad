// Grids of any spacing, pose and number of voxels, against integrals taken in the test.
#include "catch.h"
#include "render_fixture.h"
#include "volume_fixture.h"

#include <glm/gtc/matrix_transform.hpp>

using namespace slicelens;

namespace {

const std::vector<std::string> pipelines = {"slices", "rays", "reference"};

/// A volume whose value rises along its three index axes: v = Σ wₐ·iₐ/(nₐ − 1), w = (.2, .3, .5). Trilinear
/// interpolation keeps it linear between the outer voxel centres; beyond them it is constant.
struct Tilted {
  static constexpr std::array<std::size_t, 3> dims{12, 20, 8};
  glm::dvec3 spacing{2, 1, 3.5};
  glm::dmat3 direction{1};
  glm::dvec3 weights{0.2, 0.3, 0.5};

  Tilted() {
    direction = glm::dmat3(glm::rotate(glm::rotate(glm::dmat4(1), 0.7, glm::dvec3(0.3, 0.5, 0.8)), -1.1,
                                       glm::dvec3(1, -0.2, 0.4)));
  }

  Volume volume() const {
    Volume result = volume_of(ScalarType::f32, dims, [this](int i, int j, int k) {
      return weights.x * i / 11 + weights.y * j / 19 + weights.z * k / 7;
    });
    result.spacing = spacing;
    result.direction = direction;
    result.origin = {100, -40, 7};
    return result;
  }

  /// Index coordinates of a world point, by the inverse of origin + direction·(spacing ∘ index).
  glm::dvec3 index_of(const glm::dvec3& world) const {
    return glm::transpose(direction) * (world - glm::dvec3(100, -40, 7)) / spacing;
  }

  bool inside(const glm::dvec3& i) const {
    for (int a = 0; a < 3; ++a) {
      if (i[a] < -0.5 || i[a] > static_cast<double>(dims[static_cast<std::size_t>(a)]) - 0.5)
        return false;
    }
    return true;
  }

  double value(const glm::dvec3& i) const {
    const glm::dvec3 last(11, 19, 7);
    return glm::dot(weights, glm::clamp(i, glm::dvec3(0), last) / last);
  }

  /// ∫ v ds in world units along a ray, by fine midpoints.
  double line_integral(const Ray& ray) const {
    constexpr double step = 0.01;
    double sum = 0;
    const double middle = glm::dot(glm::dvec3(100, -40, 7) - ray.origin, ray.direction);
    for (double s = middle - 60; s < middle + 60; s += step) {
      const glm::dvec3 i = index_of(ray.origin + (s + step / 2) * ray.direction);
      sum += inside(i) ? value(i) * step : 0;
    }
    return sum;
  }
};

PreparedScene scene_of(Volume volume, const TransferFunction& transfer, const std::string& render,
                       const std::string& camera = R"("azimuth":33,"elevation":21,"roll":10)") {
  return prepare(
      scene_from_json(R"({"camera":{)" + camera + R"(},"render":{"background":[0,0,0,0],)" + render + "}}",
                      "test"),
      std::move(volume), transfer);
}

const TransferFunction value_as_opacity{{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 1}}, std::nullopt, ""};

} // namespace

TEST_CASE("unequal spacings in a turned pose: the X-ray is the line integral in world space") {
  gl::Context context = test_context();
  const Tilted tilted;
  for (const std::string projection : {"orthographic", "perspective"}) {
    for (const std::string& pipeline : pipelines) {
      const PreparedScene scene =
          scene_of(tilted.volume(), value_as_opacity,
                   R"("size":[24,24],"mode":"xray","filter":"linear-exact","spacing":0.1,"xray_scale":0.03,)"
                   R"("pipeline":")" +
                       pipeline + R"(")",
                   R"("azimuth":33,"elevation":21,"roll":10,"projection":")" + projection + R"(")");
      const double error = mean_error(picture(scene, context), 0, [&](int x, int y) {
        // Δ₀ is the smallest spacing, 1.
        return 0.03 * tilted.line_integral(pixel_ray(scene, x, y));
      });
      INFO(pipeline << ", " << projection << ": " << error);
      // Either end of a chord is known to ±Δ/2 = .05 at values up to 1: 3e-3·½ at most at a pixel's end.
      CHECK(error < 1e-3);
    }
  }
}

TEST_CASE("unequal spacings in a turned pose: the normal is the world-space gradient") {
  gl::Context context = test_context();
  const Tilted tilted;
  // d v/d world = direction · (w / ((n − 1)·spacing)), the same everywhere inside.
  const glm::dvec3 gradient = tilted.direction * (tilted.weights / (glm::dvec3(11, 19, 7) * tilted.spacing));
  const glm::dvec3 light = glm::normalize(glm::dvec3(-0.3, -1, 0.6));
  const double expected = 0.2 + 0.7 * std::max(0.0, -glm::dot(glm::normalize(gradient), light));
  REQUIRE(expected > 0.3);
  REQUIRE(expected < 0.85);
  // A crop of one and a half voxels keeps every tap away from the border, where the volume is flat.
  std::string clip = "clip=[";
  for (int a = 0; a < 3; ++a) {
    const double margin = 1.6 / static_cast<double>(Tilted::dims[static_cast<std::size_t>(a)]);
    for (const double side : {1.0, -1.0}) {
      glm::dvec3 point(0.5);
      point[a] = side > 0 ? margin : 1 - margin;
      const glm::dvec3 normal = side * tilted.direction[a];
      const auto text = [](const glm::dvec3& v) {
        return "[" + std::to_string(v.x) + "," + std::to_string(v.y) + "," + std::to_string(v.z) + "]";
      };
      clip += (clip.back() == '[' ? "{" : ",{") + std::string(R"("point":)") + text(point) + R"(,"normal":)" +
              text(normal) + "}";
    }
  }
  for (const std::string& pipeline : pipelines) {
    for (const std::string kind : {"forward", "central", "precomputed"}) {
      PreparedScene scene = scene_of(tilted.volume(), grey(0.1),
                                     R"("size":[32,32],"shading":"diffuse","filter":"linear-exact")");
      scene = changed(scene, {clip + "]", "render.pipeline=" + pipeline, "render.gradient=" + kind,
                              "light.direction=[-0.3,-1,0.6]", "light.ambient=0.2", "light.diffuse=0.7",
                              "light.two_sided=false"});
      const Image image = picture(scene, context);
      double largest = 0;
      int covered = 0;
      for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
        if (image.pixels[i + 3] < 0.05F)
          continue;
        ++covered;
        largest = std::max(largest, std::abs(static_cast<double>(image.pixels[i]) /
                                                 static_cast<double>(image.pixels[i + 3]) -
                                             expected));
      }
      INFO(pipeline << ", " << kind << ": " << largest << " over " << covered);
      CHECK(covered > 20);
      // Differences of floats near 1 over one voxel (about .04): 1e-5 of the gradient.
      // Halfs of differences: 11 bits.
      CHECK(largest < (kind == "precomputed" ? 5e-4 : 1e-4));
    }
  }
}

TEST_CASE("one voxel, and one layer of voxels") {
  gl::Context context = test_context();
  const auto one = [](int, int, int) { return 5; };
  const double alpha = 0.3;
  for (const std::array<std::size_t, 3> dims :
       {std::array<std::size_t, 3>{1, 1, 1}, {16, 16, 1}, {1, 16, 16}, {2, 1, 2}}) {
    for (const std::string& pipeline : pipelines) {
      for (const std::string shading : {"none", "diffuse"}) {
        const PreparedScene scene = scene_of(volume_of(ScalarType::u8, dims, one), grey(alpha),
                                             R"("size":[32,32],"spacing":0.05,"pipeline":")" + pipeline +
                                                 R"(","shading":")" + shading + R"(")");
        const glm::dvec3 half = glm::dvec3(dims[0], dims[1], dims[2]) / 2.0;
        const auto chord = [&](int x, int y) {
          const Ray ray = pixel_ray(scene, x, y);
          const glm::dvec3 a = (-half - ray.origin) / ray.direction;
          const glm::dvec3 b = (half - ray.origin) / ray.direction;
          const glm::dvec3 low = glm::min(a, b);
          const glm::dvec3 high = glm::max(a, b);
          return std::max(0.0, std::min({high.x, high.y, high.z}) - std::max({low.x, low.y, low.z}));
        };
        const Image image = picture(scene, context);
        const auto expected = [&](int x, int y) { return 1 - std::pow(1 - alpha, chord(x, y)); };
        INFO(pipeline << ", " << dims[0] << "x" << dims[1] << "x" << dims[2]);
        CHECK(mean_error(image, 3, expected) < 3e-3); // τΔ/3 = 6e-3 on covered pixels, half of all
        // No gradient: only the ambient share of white is left under light.
        const double light = shading == "none" ? 1.0 : 0.3;
        CHECK(mean_error(image, 0, [&](int x, int y) { return light * expected(x, y); }) < 3e-3);
      }
    }
  }
}

TEST_CASE("a constant volume is drawn in every texture and mode") {
  gl::Context context = test_context();
  const double alpha = 0.02;
  for (const std::string texture : {"auto", "r8", "r16", "r32f"}) {
    for (const std::string& pipeline : pipelines) {
      for (const std::string mode : {"dvr", "mip", "xray"}) {
        const PreparedScene scene = scene_of(
            volume_of(ScalarType::i16, {16, 16, 16}, [](int, int, int) { return -700; }), grey(alpha),
            R"("size":[16,16],"xray_scale":1,"volume_texture":")" + texture + R"(","pipeline":")" + pipeline +
                R"(","mode":")" + mode + R"(")",
            R"("azimuth":0)");
        const float value = channel(picture(scene, context), 8, 8, 0);
        INFO(texture << " " << pipeline << " " << mode);
        // 16 voxels straight through.
        const double expected = mode == "dvr"   ? 1 - std::pow(1 - alpha, 16)
                                : mode == "mip" ? alpha
                                                : 16 * alpha;
        CHECK(value == Approx(expected).margin(1e-5));
      }
    }
  }
}

TEST_CASE("not a number and infinity are drawn as the smallest value") {
  gl::Context context = test_context();
  const double bad[3] = {std::nan(""), INFINITY, -INFINITY};
  const auto values = [&](int i, int j, int k) {
    return (i + j + k) % 3 == 0 ? bad[(i * 4 + j * 2 + k) % 3] : 2.0 + i;
  };
  const auto replaced = [&](int i, int j, int k) { return (i + j + k) % 3 == 0 ? 2.0 : 2.0 + i; };
  for (const std::string& pipeline : pipelines) {
    for (const std::string texture : {"auto", "r16"}) {
      const std::string render = R"("size":[24,24],"filter":"linear-exact","volume_texture":")" + texture +
                                 R"(","pipeline":")" + pipeline + R"(")";
      const Image image = picture(
          scene_of(volume_of(ScalarType::f32, {6, 6, 6}, values), rising(2, 7, 0.5), render), context);
      const Image expected = picture(
          scene_of(volume_of(ScalarType::f32, {6, 6, 6}, replaced), rising(2, 7, 0.5), render), context);
      INFO(pipeline << " " << texture);
      CHECK(max_difference(image, expected) == 0);
      CHECK(channel(image, 12, 12, 3) > 0.1F);
    }
  }
}
