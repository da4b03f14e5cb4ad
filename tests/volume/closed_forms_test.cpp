// Closed forms against hand calculation and against brute-force sums that share no code with them.
#include "catch.h"
#include "volume/closed_forms.h"
#include "volume/phantom.h"
#include "volume/transfer.h"

#include <cmath>
#include <random>

using namespace slicelens;

namespace {

constexpr double kEdge = 32;

Box cube() { return make_box(glm::dvec3(kEdge), glm::dvec3(1), glm::dvec3(0.5 - kEdge / 2), glm::dmat3(1)); }

/// A line through the box in a random direction, its origin well outside.
Ray random_ray(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const glm::dvec3 direction = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  const glm::dvec3 through = 0.2 * kEdge * glm::dvec3(normal(random), normal(random), normal(random));
  return {through - 100.0 * direction, direction};
}

/// Front-to-back compositing of `count` midpoint samples over parameters [0, 200] of the ray, with samples
/// outside the cube contributing nothing. `classify` gives straight colour and opacity per unit length.
template <class Classify>
glm::dvec4 march(const Ray& ray, int count, const Classify& classify) {
  glm::dvec4 sum(0);
  const double step = 200.0 / count;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 t = (ray.origin + (i + 0.5) * step * ray.direction) / kEdge + 0.5;
    if (t.x < 0 || t.y < 0 || t.z < 0 || t.x > 1 || t.y > 1 || t.z > 1)
      continue;
    const glm::dvec4 rgba = classify(t);
    const double alpha = 1 - std::pow(1 - rgba.a, step);
    sum += (1 - sum.a) * glm::dvec4(glm::dvec3(rgba) * alpha, alpha);
  }
  return sum;
}

void check_near(const glm::dvec4& actual, const glm::dvec4& expected, double tolerance) {
  for (int c = 0; c < 4; ++c)
    CHECK(std::abs(actual[c] - expected[c]) <= tolerance);
}

} // namespace

TEST_CASE("extinction and opacity are inverse") {
  CHECK(extinction_from_opacity(0.5, 2) == Approx(std::log(2.0) / 2));
  CHECK(opacity_from_extinction(std::log(2.0) / 2, 4) == Approx(0.75));
  CHECK(opacity_from_extinction(extinction_from_opacity(1, 1), 3) == 1);
  CHECK(opacity_from_extinction(extinction_from_opacity(1, 1), 0) == 0);
}

TEST_CASE("chords have their hand-derived lengths") {
  const double edge = kEdge;
  CHECK(box_chord(cube(), {{0, -100, 0}, {0, 2, 0}}) == Approx(edge));
  CHECK(box_chord(cube(), {{0, 0, 0}, {1, 1, 1}}) == Approx(edge * std::sqrt(3.0)));
  CHECK(box_chord(cube(), {{0, 0, 0}, {1, 1, 0}}) == Approx(edge * std::sqrt(2.0)));
  CHECK(box_chord(cube(), {{edge, 0, 0}, {0, 1, 0}}) == 0);
  CHECK(sphere_chord({1, 2, 3}, 5, {{4, -7, 3}, {0, 1, 0}}) == Approx(8)); // 3-4-5
  CHECK(sphere_chord({1, 2, 3}, 5, {{6.1, 0, 3}, {0, 1, 0}}) == 0);
  CHECK(ball_chord(cube(), {{0, -50, 0}, {0, 3, 0}}) == Approx(0.8 * edge));
  CHECK(impact_distance({0, 0, 0}, {{3, 4, 9}, {0, 0, -2}}) == Approx(5));
}

TEST_CASE("the blob's integral and maximum agree with brute force") {
  std::mt19937 random(1);
  const double sigma = kEdge / 8;
  for (int round = 0; round < 20; ++round) {
    const Ray ray = random_ray(random);
    double inside = 0;
    double everywhere = 0;
    double largest = 0;
    constexpr int count = 40000;
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 p = ray.origin + (i + 0.5) * (200.0 / count) * ray.direction;
      const double value = std::exp(-glm::dot(p, p) / (2 * sigma * sigma));
      everywhere += value * 200.0 / count;
      if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= kEdge / 2) {
        inside += value * 200.0 / count;
        largest = std::max(largest, value);
      }
    }
    // Δ₀ = 2. The midpoint sum of a smooth function that vanishes at both ends is exact to rounding; cut at a
    // face it is wrong by up to a step times the value there (5e-3 · 3.4e-4).
    CHECK(blob_xray(cube(), ray, 2) == Approx(everywhere / 2).epsilon(1e-9).margin(1e-12));
    CHECK(blob_xray_clipped(cube(), ray, 2) == Approx(inside / 2).margin(2e-6));
    // The sample nearest to the peak is within half a step: (2.5e-3/σ)²/2 of the peak; at a face, a step's
    // slope.
    CHECK(blob_mip(cube(), ray) == Approx(largest).margin(5e-6));
  }
  const Ray middle{{0, -100, 0}, {0, 1, 0}};
  CHECK(blob_xray(cube(), middle, 1) == Approx(4 * std::sqrt(2 * 3.14159265358979)));
  CHECK(1 - blob_xray_clipped(cube(), middle, 1) / blob_xray(cube(), middle, 1) ==
        Approx(std::erfc(4 / std::sqrt(2.0))).epsilon(1e-6));
  CHECK(blob_mip(cube(), middle) == 1);
  CHECK(blob_mip(cube(), {{kEdge, 0, 0}, {0, 1, 0}}) == 0);
}

TEST_CASE("the ramp's voxels, trilinearly sampled, are what ramp_value says") {
  const Volume ramp = make_phantom("ramp", {5, 3, 2});
  for (double t = 0; t <= 1; t += 1.0 / 64) {
    const double u = std::clamp(t * 5 - 0.5, 0.0, 4.0);
    const auto i = std::min<std::size_t>(static_cast<std::size_t>(u), 3);
    const double f = u - static_cast<double>(i);
    // The voxels are floats.
    CHECK(value_at(ramp, i, 1, 1) * (1 - f) + value_at(ramp, i + 1, 1, 1) * f ==
          Approx(ramp_value(t, 5)).epsilon(1e-6));
  }
}

TEST_CASE("the ramp's emission and absorption agree with brute force") {
  std::mt19937 random(2);
  const glm::dvec4 low(1, .2, 0, .02);
  const glm::dvec4 high(.1, .6, 1, .3);
  for (int round = 0; round < 10; ++round) {
    const Ray ray = random_ray(random);
    const glm::dvec4 sum = march(ray, 400000, [&](const glm::dvec3& t) {
      const double v = std::clamp(t.x, 0.5 / 16, 1 - 0.5 / 16);
      const glm::dvec4 rgba = low * (1 - v) + high * v;
      return glm::dvec4(glm::dvec3(rgba), 1 - std::pow(1 - rgba.a, 1 / 1.5)); // Δ₀ = 1.5 to unit length
    });
    // The march errs by up to a step of 5e-4 at each face: 5e-4 · 0.24 each.
    check_near(ramp_dvr(cube(), ray, 16, low, high, 1.5), sum, 2.5e-4);
  }
}

TEST_CASE("a ramp of constant opacity has the elementary solution") {
  // Constant colour and α: C = c·(1 − (1 − α)^(L/Δ₀)) on any ray.
  const glm::dvec4 rgba(.5, .25, 1, .1);
  const Ray ray{{-50, -60, 3}, {1, 1.2, 0.05}};
  const double alpha = 1 - std::pow(0.9, box_chord(cube(), ray) / 2);
  check_near(ramp_dvr(cube(), ray, 8, rgba, rgba, 2), {.5 * alpha, .25 * alpha, alpha, alpha}, 1e-12);
  // Along y the value, and so the opacity, is constant: at x = 4, t = 0.625, α = 0.0625.
  const glm::dvec4 along = ramp_dvr(cube(), {{4, -99, 0}, {0, 1, 0}}, 64, {1, 1, 1, 0}, {1, 1, 1, .1}, 1);
  CHECK(along.a == Approx(1 - std::pow(1 - .0625, kEdge)));
  // From transparent to opaque along +x, white: optical depth ∫ −ln(1 − v) between v = 1/2nx and 1 − 1/2nx in
  // units of the edge is 1 with nx → ∞, so A → 1 − e^(−edge/Δ₀); colour equals opacity.
  const glm::dvec4 full =
      ramp_dvr(cube(), {{-99, 0, 0}, {1, 0, 0}}, 1000000, {1, 1, 1, 0}, {1, 1, 1, 1}, kEdge);
  CHECK(full.a == Approx(1 - std::exp(-1.0)).epsilon(1e-5));
  CHECK(full.r == Approx(full.a));
  // Reversing the ray keeps the opacity and changes the colour.
  const Ray there{{-99, 1, 2}, {1, 0.1, 0}};
  const Ray back{there.origin + 200.0 * there.direction, -there.direction};
  const glm::dvec4 a = ramp_dvr(cube(), there, 64, {1, 0, 0, 0}, {0, 0, 1, .2}, 1);
  const glm::dvec4 b = ramp_dvr(cube(), back, 64, {1, 0, 0, 0}, {0, 0, 1, .2}, 1);
  CHECK(a.a == Approx(b.a));
  CHECK(b.b > a.b + 0.1);
}

TEST_CASE("two slabs composite in the order the ray meets them") {
  const glm::dvec4 front(1, 0, 0, .05);
  const glm::dvec4 back(0, 0, 1, .1);
  // Along +y through half the edge each, Δ₀ = 1.
  const double a = 1 - std::pow(.95, kEdge / 2);
  const double b = 1 - std::pow(.9, kEdge / 2);
  check_near(slabs_dvr(cube(), {{1, -99, 2}, {0, 1, 0}}, front, back, 1),
             {a, 0, (1 - a) * b, a + (1 - a) * b}, 1e-12);
  check_near(slabs_dvr(cube(), {{1, 99, 2}, {0, -1, 0}}, front, back, 1), {(1 - b) * a, 0, b, a + b - a * b},
             1e-12);
  // Within one slab only.
  check_near(slabs_dvr(cube(), {{-99, -4, 2}, {1, 0, 0}}, front, back, 1),
             {1 - std::pow(.95, kEdge), 0, 0, 1 - std::pow(.95, kEdge)}, 1e-12);
  std::mt19937 random(3);
  for (int round = 0; round < 10; ++round) {
    const Ray ray = random_ray(random);
    const glm::dvec4 sum = march(ray, 400000, [&](const glm::dvec3& t) { return t.y < .5 ? front : back; });
    check_near(slabs_dvr(cube(), ray, front, back, 1), sum, 1e-4); // three edges of half a step · 0.1
  }
}

TEST_CASE("least, largest and mean values along a line agree with brute force") {
  std::mt19937 random(4);
  for (int round = 0; round < 20; ++round) {
    const Ray ray = random_ray(random);
    double least = 2;
    double most = -1;
    double ramp_sum = 0;
    double blob_sum = 0;
    double count = 0;
    for (int i = 0; i < 400000; ++i) {
      const glm::dvec3 t = (ray.origin + i * 5e-4 * ray.direction) / kEdge + 0.5;
      if (t.x < 0 || t.y < 0 || t.z < 0 || t.x > 1 || t.y > 1 || t.z > 1)
        continue;
      const double v = std::clamp(t.x, 0.5 / 16, 1 - 0.5 / 16);
      least = std::min(least, v);
      most = std::max(most, v);
      ramp_sum += v;
      blob_sum += std::exp(-glm::dot(t - 0.5, t - 0.5) * 32); // σ = 1/8
      count += 1;
    }
    const auto range = ramp_range(cube(), ray, 16);
    REQUIRE(range.has_value() == (count > 0));
    if (count < 1000) // the march's own ends would be a thousandth
      continue;
    // A step of 5e-4 is 1.6e-5 of the edge; means are off by a step of a chord of 0.5 at least.
    CHECK(range->least == Approx(least).margin(2e-5));
    CHECK(range->most == Approx(most).margin(2e-5));
    CHECK(range->average == Approx(ramp_sum / count).margin(1e-3));
    CHECK(blob_average(cube(), ray) == Approx(blob_sum / count).margin(1e-3));
  }
  // By hand: across y the value is one; along x, of two voxels, from 1/4 (half of the line) over the middle
  // to 3/4.
  const auto across = ramp_range(cube(), {{8, -99, 0}, {0, 1, 0}}, 16);
  CHECK(across->least == Approx(0.75));
  CHECK(across->average == Approx(0.75));
  const auto along = ramp_range(cube(), {{99, 0, 0}, {-1, 0, 0}}, 2);
  CHECK(along->least == 0.25);
  CHECK(along->most == 0.75);
  CHECK(along->average == Approx(0.5));
  CHECK_FALSE(ramp_range(cube(), {{99, 99, 0}, {0, 0, 1}}, 2));
}

TEST_CASE("a line meets a sphere where Pythagoras says") {
  const auto hit = sphere_hit({1, 2, 3}, 5, {{4, -98, 3}, {0, 2, 0}}); // 3 off the centre: 4 before it
  REQUIRE(hit);
  CHECK(*hit == Approx((100 - 4) / 2.0));
  CHECK_FALSE(sphere_hit({1, 2, 3}, 5, {{7, -98, 3}, {0, 2, 0}}));
}

TEST_CASE("a line integral in front of fog, and behind it") {
  const glm::dvec4 front(1, 0, 0, .05);
  const glm::dvec4 back(0, 0, 1, .1);
  // 16 voxels each, Δ₀ = 2: S = .05·16/2 = .4, of which half is shown; fog of 1 − .9⁸.
  const double fog = 1 - std::pow(.9, 8);
  check_near(slabs_xray_front(cube(), {{1, -99, 2}, {0, 1, 0}}, front, back, 2, 0.5),
             {.2, 0, .8 * fog, .2 + .8 * fog}, 1e-12);
  check_near(slabs_xray_front(cube(), {{1, 99, 2}, {0, -1, 0}}, front, back, 2, 0.5),
             {(1 - fog) * .2, 0, fog, fog + (1 - fog) * .2}, 1e-12);
  check_near(slabs_xray_front(cube(), {{1, -99, 2}, {0, 1, 0}}, front, back, 2, 9), {1, 0, 0, 1}, 1e-12);
}

TEST_CASE("the gradient of Marschner and Lobb's signal is that of differences") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 50; ++round) {
    const glm::dvec3 t(uniform(random), uniform(random), uniform(random));
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 h(0);
      h[axis] = 1e-6;
      // The third derivative is at most (2·2π·6·π/2)³/10 = 1.7e5: 1e-12/6 of it, and rounding of 1e-16/1e-6.
      CHECK(marschner_lobb_gradient(t)[axis] ==
            Approx((marschner_lobb(t + h) - marschner_lobb(t - h)) / 2e-6).margin(1e-6));
    }
  }
  CHECK(marschner_lobb_gradient(glm::dvec3(0.5)).x == 0); // the axis r = 0
}
