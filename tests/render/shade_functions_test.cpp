// shaders/lib/shade.glsl compiled as C++, in double, against angles worked by hand.
#include "catch.h"

#include <glm/glm.hpp>

#include <cmath>

namespace {

namespace shade {
using namespace glm;
using real = double;
using vec3 = glm::dvec3;
struct Functions {
#include "lib/shade.glsl"
};
} // namespace shade

shade::Functions shared;
const double deg = glm::radians(1.0);
const glm::dvec3 gradient(0, 0, -2); // of a surface that faces +z
const glm::dvec3 flat(0);

/// Unit vector `degrees` from +z towards +x.
glm::dvec3 at(double degrees) { return {std::sin(degrees * deg), 0, std::cos(degrees * deg)}; }

double distance(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

} // namespace

TEST_CASE("diffuse light follows the cosine, on one side or both") {
  CHECK(shared.diffuse_factor(gradient, at(0), 0.1, 0.6, false) == Approx(0.7));
  CHECK(shared.diffuse_factor(gradient, at(60), 0.1, 0.6, false) == Approx(0.4));
  CHECK(shared.diffuse_factor(gradient, at(120), 0.1, 0.6, false) == Approx(0.1));
  CHECK(shared.diffuse_factor(gradient, at(120), 0.1, 0.6, true) == Approx(0.4));
  CHECK(shared.diffuse_factor(flat, at(0), 0.1, 0.6, true) == Approx(0.1));
}

TEST_CASE("the highlight is at the mirror image of the light and falls with a power of the cosine") {
  const auto share = [](double light, double eye, double power, bool two_sided) {
    return shared.specular_share(gradient, at(light), at(eye), 0.8, power, two_sided);
  };
  CHECK(share(40, -40, 10, false) == Approx(0.8));
  CHECK(share(40, -10, 10, false) == Approx(0.8 * std::pow(std::cos(30 * deg), 10)));
  CHECK(share(40, 20, 3, false) == Approx(0.8 * 0.125));     // 60° off: ½³
  CHECK(share(40, 55, 3, false) == Approx(0).margin(1e-12)); // more than 90° off
  CHECK(share(0, 0, 1, false) == Approx(0.8));
  // Light at the eye: the lobe is cos 2θ.
  CHECK(share(15, 15, 2, false) == Approx(0.8 * 0.75));
  // From behind: as for the surface turned round, or nothing.
  CHECK(share(140, -140, 10, false) == Approx(0).margin(1e-12));
  CHECK(share(140, 220, 10, true) == Approx(0.8));
  CHECK(shared.specular_share(flat, at(0), at(0), 0.8, 2, true) == Approx(0).margin(1e-12));
}

TEST_CASE("Phong's colour is the lit colour and white, never brighter than white") {
  const glm::dvec3 color(0.5, 0.25, 0);
  const glm::dvec3 lit = shared.phong_color(color, gradient, at(60), at(-30), 0.1, 0.6, 0.2, 4, false);
  const double white = 0.2 * std::pow(std::cos(30 * deg), 4);
  CHECK(distance(lit, 0.4 * color + white) < 1e-12);
  const glm::dvec3 bright = shared.phong_color({1, 0.5, 0}, gradient, at(0), at(0), 0.3, 0.7, 0.6, 4, false);
  CHECK(distance(bright, {1, 1, 0.6}) < 1e-12);
  CHECK(distance(shared.phong_color(color, flat, at(0), at(0), 0.1, 0.6, 0.2, 4, true), 0.1 * color) < 1e-12);
}

TEST_CASE("tone goes from cool to warm with the angle to the light") {
  const glm::dvec3 color(0.5, 0.2, 0.1);
  const glm::dvec3 cool(0, 0, 0.4);
  const glm::dvec3 warm(0.4, 0.3, 0);
  const auto tone = [&](const glm::dvec3& g, double light) {
    return shared.tone_color(color, g, at(light), cool, warm);
  };
  const glm::dvec3 away = cool + 0.2 * color;
  const glm::dvec3 towards = warm + 0.6 * color;
  CHECK(distance(tone(gradient, 0), towards) < 1e-12);
  CHECK(distance(tone(gradient, 180), away) < 1e-12);
  CHECK(distance(tone(gradient, 90), 0.5 * (away + towards)) < 1e-12);
  CHECK(distance(tone(gradient, 60), 0.25 * away + 0.75 * towards) < 1e-12);
  CHECK(distance(tone(flat, 0), 0.5 * (away + towards)) < 1e-12);
  CHECK(distance(shared.tone_color({1, 1, 1}, gradient, at(0), cool, {1, 0.4, 0}), {1, 1, 0.6}) < 1e-12);
}
