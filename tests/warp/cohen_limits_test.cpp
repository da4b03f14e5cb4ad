// What makes no bifocal, fisheye, lens, highlight or attenuation is refused in one line that says so.
#include "catch.h"
#include "core/errors.h"
#include "refusal.h"
#include "warp/focus_effects.h"
#include "warp/warp.h"

#include <limits>

using namespace slicelens;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

void check_refused(const std::string& message, const std::vector<std::string>& named) {
  INFO(message);
  CHECK_FALSE(message.empty());
  CHECK(message.find('\n') == std::string::npos);
  for (const std::string& text : named) {
    INFO(text);
    CHECK(message.find(text) != std::string::npos);
  }
}

const std::vector<glm::dvec2>& wrong_ranges() {
  static const std::vector<glm::dvec2> list = {
      {0.5, 0.5},       {0.6, 0.4},       {-0.1, 0.5},      {0.5, 1.2},      {0, 0.5},   {0.5, 1}, {0, 1},
      {nan_value, 0.5}, {0.5, nan_value}, {-infinite, 0.5}, {0.5, infinite}, {1.2, 1.5}, {-2, -1}, {1, 0},
  };
  return list;
}

} // namespace

TEST_CASE(
    "regions that are empty, reversed, outside the volume, touch a face or are no numbers are refused") {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const glm::dvec2& range : wrong_ranges()) {
      INFO("axis " << axis << ", [" << range.x << ", " << range.y << "]");
      const std::string on_axis = std::string("axis ") + "xyz"[axis];
      Bifocal bifocal;
      bifocal.focus[axis] = range;
      check_refused(refusal([&] { validate(Warp(bifocal)); }), {"warp 'bifocal'", "focus", on_axis});
      bifocal = {};
      bifocal.shown[axis] = range;
      check_refused(refusal([&] { validate(Warp(bifocal)); }), {"warp 'bifocal'", "shown", on_axis});
      AxisRanges region = ranges_of(glm::dvec3(0.3), glm::dvec3(0.6));
      region[axis] = range;
      check_refused(refusal([&] {
                      validate(Highlight{HighlightFunction::focus, 1, {0, 1, 0}, region});
                    }),
                    {"highlight.focus", on_axis});
      check_refused(refusal([&] {
                      validate(Attenuation{AttenuationFunction::distance, 1, region});
                    }),
                    {"attenuation.focus", on_axis});
    }
  }
  AxisRanges hair = ranges_of(glm::dvec3(1e-6), glm::dvec3(1 - 1e-6));
  CHECK(refusal([&] { validate(Warp(Bifocal{hair, hair})); }).empty());
}

TEST_CASE("fisheyes without a focal point inside or with a wrong distortion are refused") {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double center : {0.0, 1.0, -0.5, 1.5, nan_value, infinite}) {
      Fisheye fisheye;
      fisheye.center[axis] = center;
      check_refused(refusal([&] { validate(Warp(fisheye)); }), {"warp 'fisheye'", "center"});
    }
    for (const double distortion : {-1e-9, -3.0, nan_value, infinite, 1e5}) {
      Fisheye fisheye;
      fisheye.distortion[axis] = distortion;
      check_refused(refusal([&] { validate(Warp(fisheye)); }), {"warp 'fisheye'", "distortion"});
    }
  }
  CHECK(refusal([] { validate(Warp(Fisheye{glm::dvec3(0.5), glm::dvec3(0)})); }).empty());
}

TEST_CASE("box lenses with wrong half-widths, places or magnifications are refused") {
  struct Wrong {
    const char* key;
    std::function<void(LensBox&, int)> spoil;
  };
  const std::vector<Wrong> wrongs = {
      {"inner", [](LensBox& b, int a) { b.inner[a] = 0; }},
      {"inner", [](LensBox& b, int a) { b.inner[a] = -0.1; }},
      {"inner", [](LensBox& b, int a) { b.inner[a] = nan_value; }},
      {"inner", [](LensBox& b, int a) { b.inner[a] = b.outer[a]; }},
      {"inner", [](LensBox& b, int a) { b.inner[a] = 0.4; }},
      {"outer", [](LensBox& b, int a) { b.outer[a] = nan_value; }},
      {"outer", [](LensBox& b, int a) { b.outer[a] = infinite; }},
      {"outer", [](LensBox& b, int a) { b.outer[a] = 0.6; }},    // leaves the volume
      {"center", [](LensBox& b, int a) { b.center[a] = 0.15; }}, // the focus touches a face
      {"center", [](LensBox& b, int a) { b.center[a] = 0.9; }},
      {"center", [](LensBox& b, int a) { b.center[a] = 0.25; }}, // the border leaves the volume
      {"center", [](LensBox& b, int a) { b.center[a] = nan_value; }},
      {"magnification", [](LensBox& b, int) { b.magnification = 0; }},
      {"magnification", [](LensBox& b, int) { b.magnification = -2; }},
      {"magnification", [](LensBox& b, int) { b.magnification = nan_value; }},
      {"magnification", [](LensBox& b, int) { b.magnification = infinite; }},
      // i = .15, o = .3: folds below (i + o)/(2o) = .75.
      {"folds", [](LensBox& b, int) { b.magnification = 0.749; }},
      {"magnification", [](LensBox& b, int) { b.magnification = 0.5; }},
  };
  for (const Wrong& wrong : wrongs) {
    for (int axis = 0; axis < 3; ++axis) {
      LensBox box;
      wrong.spoil(box, axis);
      INFO(wrong.key << ", axis " << axis);
      check_refused(refusal([&] { validate(Warp(VolumeLens{box})); }), {"warp 'volume-lens'", wrong.key});
      check_refused(refusal([&] { validate(Warp(ConnectedLens{box})); }),
                    {"warp 'connected-lens'", wrong.key});
    }
  }
  LensBox box;
  box.magnification = 0.751;
  CHECK(refusal([&] { validate(Warp(VolumeLens{box})); }).empty());
  // With a thin border the connected lens folds where it bends along all three axes before its profile does:
  // i = .25, o = .3, limit of the profile .55/.6 = .917.
  box = {glm::dvec3(0.5), glm::dvec3(0.25), glm::dvec3(0.3), 0.92};
  CHECK(refusal([&] { validate(Warp(VolumeLens{box})); }).empty());
  check_refused(refusal([&] { validate(Warp(ConnectedLens{box})); }), {"warp 'connected-lens'", "corners"});
  box.magnification = 0.99;
  CHECK(refusal([&] { validate(Warp(ConnectedLens{box})); }).empty());
  box = {glm::dvec3(0.7), glm::dvec3(0.1), glm::dvec3(0.3), 2}; // ends on the face: .7 + .3 rounds to 1
  CHECK(refusal([&] { validate(Warp(VolumeLens{box})); }).empty());
}

TEST_CASE("powers and colours that are none are refused") {
  for (const double power : {-1.0, -1e-9, nan_value, infinite}) {
    check_refused(refusal([&] {
                    validate(Highlight{HighlightFunction::distance, power});
                  }),
                  {"highlight.power"});
    check_refused(refusal([&] {
                    validate(Attenuation{AttenuationFunction::distance, power});
                  }),
                  {"attenuation.power"});
  }
  for (const double value : {-0.1, 1.1, nan_value}) {
    check_refused(refusal([&] {
                    validate(Highlight{HighlightFunction::distance, 1, {0, value, 0}});
                  }),
                  {"highlight.color"});
  }
  CHECK(refusal([] { validate(Highlight{HighlightFunction::distance, 0}); }).empty());
}

TEST_CASE("effects without a region to have, and a constant highlight of a point, are refused") {
  check_refused(refusal([] { (void)focus_effects({HighlightFunction::distance}, {}, std::nullopt); }),
                {"highlight", "highlight.focus"});
  check_refused(refusal([] { (void)focus_effects({}, {AttenuationFunction::distance}, std::nullopt); }),
                {"attenuation", "attenuation.focus"});
  check_refused(
      refusal([] { (void)focus_effects({HighlightFunction::focus}, {}, focus_region(Warp(Fisheye{}))); }),
      {"highlight", "fisheye"});
  CHECK(refusal([] { (void)focus_effects({}, {}, std::nullopt); }).empty());
}
