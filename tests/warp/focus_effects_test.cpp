// Highlight and attenuation (Cohen, Brodlie and Phillips 2008 §3.2 and §3.3) by hand. Equations are the
// paper's.
#include "catch.h"
#include "warp/focus_effects.h"
#include "warp/warp.h"

#include <cmath>

using namespace slicelens;

namespace {

/// [.2, .6] on x, about .4; [.4, .6] on y; [.1, .5] on z.
const AxisRanges region = {glm::dvec2(0.2, 0.6), glm::dvec2(0.4, 0.6), glm::dvec2(0.1, 0.5)};

FocusEffects highlighting(HighlightFunction function, double power) {
  return focus_effects({function, power, {0, 1, 0}, region}, {}, std::nullopt);
}

FocusEffects attenuating(AttenuationFunction function, double power, const glm::dvec3& gaze = glm::dvec3(0)) {
  FocusEffects effects = focus_effects({}, {function, power, region}, std::nullopt);
  effects.gaze = gaze;
  return effects;
}

// Powers are of numbers near 1: pow is within 1 or 2 units in the last place.
Approx exactly(double value) { return Approx(value).margin(1e-14).epsilon(1e-14); }

} // namespace

TEST_CASE("highlight: the hat of equation 1, linear") {
  const FocusEffects e = highlighting(HighlightFunction::distance, 1);
  // h = max(1 − 2|.4 − x|, 0)
  CHECK(highlight_on_axis(e, 0, 0.4) == exactly(1));
  CHECK(highlight_on_axis(e, 0, 0.5) == exactly(0.8));
  CHECK(highlight_on_axis(e, 0, 0.15) == exactly(0.5));
  CHECK(highlight_on_axis(e, 0, 0) == exactly(0.2));
  CHECK(highlight_on_axis(e, 0, 0.9) == exactly(0));
  CHECK(highlight_on_axis(e, 0, 1) == 0);
  CHECK(highlight_on_axis(e, 1, 0.25) == exactly(0.5)); // about 1/2
  CHECK(highlight_on_axis(e, 2, 0.3) == exactly(1));    // about .3
}

TEST_CASE("highlight: powers 2, 3, 2.5 and 0") {
  const double at = 0.15; // the hat is 1/2
  CHECK(highlight_on_axis(highlighting(HighlightFunction::distance, 2), 0, at) == exactly(0.25));
  CHECK(highlight_on_axis(highlighting(HighlightFunction::distance, 3), 0, at) == exactly(0.125));
  CHECK(highlight_on_axis(highlighting(HighlightFunction::distance, 2.5), 0, at) ==
        exactly(0.17677669529663687));         // 1/(4√2)
  for (const double x : {0.0, 0.15, 0.4, 1.0}) // x⁰ = 1, for 0 as well
    CHECK(highlight_on_axis(highlighting(HighlightFunction::distance, 0), 0, x) == 1);
  CHECK(highlight_on_axis(highlighting(HighlightFunction::distance, 2.5), 0, 1) == 0);
}

TEST_CASE("highlight: constant within the focus region, its borders included") {
  for (const double power : {0.0, 1.0, 3.0}) {
    const FocusEffects e = highlighting(HighlightFunction::focus, power);
    for (const double x : {0.2, 0.3, 0.4, 0.6})
      CHECK(highlight_on_axis(e, 0, x) == 1);
    for (const double x : {0.0, 0.1999999, 0.6000001, 1.0})
      CHECK(highlight_on_axis(e, 0, x) == 0);
    CHECK(highlight_at(e, {0.3, 0.5, 0.2}) == 1);
    CHECK(highlight_at(e, {0.3, 0.5, 0.6}) == 0);
  }
}

TEST_CASE("highlight and attenuation are products over the axes") {
  // (.5) · (1 − 2·.1) · (1 − 2·.2)
  CHECK(highlight_at(highlighting(HighlightFunction::distance, 1), {0.15, 0.4, 0.5}) ==
        exactly(0.5 * 0.8 * 0.6));
  CHECK(highlight_at(highlighting(HighlightFunction::distance, 2), {0.15, 0.4, 0.5}) ==
        exactly(0.25 * 0.64 * 0.36));
  // x/.2, y/.4, (1 − z)/.5
  CHECK(attenuation_at(attenuating(AttenuationFunction::distance, 1), {0.1, 0.3, 0.9}) ==
        exactly(0.5 * 0.75 * 0.2));
}

TEST_CASE("highlight: equation 2 blends the colour") {
  shared::FocusEffectsFunctions<double> functions;
  const glm::dvec3 color(1, 0.5, 0);
  const glm::dvec3 green(0, 1, 0);
  CHECK(functions.highlighted(color, green, 0) == color);
  CHECK(functions.highlighted(color, green, 1) == green);
  CHECK(functions.highlighted(color, green, 0.25) == glm::dvec3(0.75, 0.625, 0));
}

TEST_CASE("attenuation: equation 3") {
  const FocusEffects e = attenuating(AttenuationFunction::distance, 1);
  CHECK(attenuation_on_axis(e, 0, 0) == 0);
  CHECK(attenuation_on_axis(e, 0, 1) == 0);
  for (const double x : {0.2, 0.4, 0.6})
    CHECK(attenuation_on_axis(e, 0, x) == 1);
  // Linear between: x/.2 and (1 − x)/.4.
  CHECK(attenuation_on_axis(e, 0, 0.05) == exactly(0.25));
  CHECK(attenuation_on_axis(e, 0, 0.1) == exactly(0.5));
  CHECK(attenuation_on_axis(e, 0, 0.7) == exactly(0.75));
  CHECK(attenuation_on_axis(e, 0, 0.8) == exactly(0.5));
  CHECK(attenuation_on_axis(attenuating(AttenuationFunction::distance, 2), 0, 0.8) == exactly(0.25));
  CHECK(attenuation_on_axis(attenuating(AttenuationFunction::distance, 3), 0, 0.8) == exactly(0.125));
  CHECK(attenuation_on_axis(attenuating(AttenuationFunction::distance, 2.5), 0, 0.8) ==
        exactly(0.17677669529663687));
  for (const double x : {0.0, 0.1, 0.8, 1.0})
    CHECK(attenuation_on_axis(attenuating(AttenuationFunction::distance, 0), 0, x) == 1);
}

TEST_CASE("attenuation of a fisheye: both limits are the focal point") {
  const Warp fisheye = Fisheye{{0.25, 0.5, 0.5}, glm::dvec3(3)};
  const FocusEffects e =
      focus_effects({}, {AttenuationFunction::distance, 1, std::nullopt}, focus_region(fisheye));
  CHECK(e.attenuation_low == glm::dvec3(0.25, 0.5, 0.5));
  CHECK(e.attenuation_high == e.attenuation_low);
  CHECK(attenuation_on_axis(e, 0, 0) == 0);
  CHECK(attenuation_on_axis(e, 0, 0.125) == exactly(0.5));
  CHECK(attenuation_on_axis(e, 0, 0.25) == 1);
  CHECK(attenuation_on_axis(e, 0, 0.625) == exactly(0.5));
  CHECK(attenuation_on_axis(e, 0, 1) == 0);
}

TEST_CASE("the effects' region is what the mapping shows, and a section's own goes before") {
  const AxisRanges other = ranges_of(glm::dvec3(0.3), glm::dvec3(0.5));
  const auto low = [](const Warp& warp) { return focus_region(warp)->at(0).x; };
  CHECK(low(Bifocal{region, other}) == 0.3); // on display, not in the data
  CHECK(low(VolumeLens{{glm::dvec3(0.5), glm::dvec3(0.1), glm::dvec3(0.3), 2}}) == exactly(0.4)); // c − i
  CHECK(low(ConnectedLens{{glm::dvec3(0.5), glm::dvec3(0.1), glm::dvec3(0.3), 2}}) == exactly(0.4));
  CHECK_FALSE(focus_region(Warp(LamarLens{})));
  const FocusEffects from_mapping = focus_effects({HighlightFunction::distance, 1, {0, 1, 0}, std::nullopt},
                                                  {AttenuationFunction::distance, 1, region}, other);
  CHECK(from_mapping.highlight_low == glm::dvec3(0.3));
  CHECK(from_mapping.attenuation_low == low_of(region));
  CHECK(glm::length(gaze_origin(from_mapping) - glm::dvec3(0.4, 0.5, 0.3)) < 1e-15);
}

TEST_CASE("viewpoint attenuation: the six axis views, equation 4") {
  const AttenuationFunction viewpoint = AttenuationFunction::viewpoint;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = region[static_cast<std::size_t>(axis)].x;
    const double high = region[static_cast<std::size_t>(axis)].y;
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec3 gaze(0);
      gaze[axis] = sign;
      const FocusEffects e = attenuating(viewpoint, 1, gaze);
      INFO("axis " << axis << ", sign " << sign);
      // Towards the viewer as in equation 3, away from them nothing.
      CHECK(attenuation_on_axis(e, axis, 0) == (sign < 0 ? 0 : 1));
      CHECK(attenuation_on_axis(e, axis, low / 4) == exactly(sign < 0 ? 0.25 : 1));
      CHECK(attenuation_on_axis(e, axis, low) == 1);
      CHECK(attenuation_on_axis(e, axis, (low + high) / 2) == 1);
      CHECK(attenuation_on_axis(e, axis, high) == 1);
      CHECK(attenuation_on_axis(e, axis, (1 + high) / 2) == exactly(sign > 0 ? 0.5 : 1));
      CHECK(attenuation_on_axis(e, axis, 1) == (sign > 0 ? 0 : 1));
      for (int across = 0; across < 3; ++across) { // seen edge on: not attenuated
        if (across != axis)
          CHECK(attenuation_on_axis(e, across, 0.01) == 1);
      }
    }
  }
}

TEST_CASE("viewpoint attenuation: an oblique view, equation 4") {
  const glm::dvec3 gaze(0.6, -0.8, 0);
  const FocusEffects e = attenuating(AttenuationFunction::viewpoint, 1, gaze);
  CHECK(attenuation_on_axis(e, 0, 0.8) == exactly(0.7)); // 1 − .6·(.8 − .6)/.4
  CHECK(attenuation_on_axis(e, 0, 1) == exactly(0.4));   // 1 − .6
  CHECK(attenuation_on_axis(e, 0, 0.1) == 1);            // behind
  CHECK(attenuation_on_axis(e, 1, 0.1) == exactly(0.4)); // 1 − .8·(.4 − .1)/.4
  CHECK(attenuation_on_axis(e, 1, 0) == exactly(0.2));
  CHECK(attenuation_on_axis(e, 1, 0.9) == 1);
  CHECK(attenuation_on_axis(e, 2, 0.01) == 1);
  CHECK(attenuation_at(e, {0.8, 0.1, 0.01}) == exactly(0.28));
  const FocusEffects squared = attenuating(AttenuationFunction::viewpoint, 2, gaze);
  CHECK(attenuation_at(squared, {0.8, 0.1, 0.01}) == exactly(0.0784));
  // Along the space diagonal every axis counts 1/√3.
  const FocusEffects diagonal =
      attenuating(AttenuationFunction::viewpoint, 1, glm::dvec3(-1 / std::sqrt(3.0)));
  CHECK(attenuation_at(diagonal, {0.1, 0.2, 0.05}) == exactly(std::pow(1 - 0.5 / std::sqrt(3.0), 3)));
}

TEST_CASE("effects that are off do nothing") {
  const FocusEffects e = focus_effects({}, {}, std::nullopt);
  CHECK_FALSE(has_highlight(e));
  CHECK_FALSE(has_attenuation(e));
  CHECK(highlight_at(e, {0.5, 0.5, 0.5}) == 0);
  CHECK(attenuation_at(e, {0, 0.5, 1}) == 1);
}
