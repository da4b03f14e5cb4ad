#include "catch.h"
#include "core/errors.h"
#include "lens_cases.h"
#include "refusal.h"
#include "warp/warp.h"

#include <limits>

using namespace slicelens;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

using ::refusal;

std::string refusal(const LamarLens& lens) {
  return refusal([&] { validate(Warp(lens)); });
}

LamarLens minifying(LensBorder border, double zoom) {
  LamarLens lens;
  lens.border = border;
  lens.inner = 0.1;
  lens.outer = 0.2;
  lens.zoom = zoom;
  return lens;
}

} // namespace

TEST_CASE("the default lens is valid, and so are a square, segments at the limits and adaptive ones") {
  LamarLens lens;
  CHECK(refusal(lens).empty());
  lens.shape = LensShape::square;
  lens.angular_segments = 3;
  lens.radial_segments = max_radial_segments;
  CHECK(refusal(lens).empty());
  lens.radial_segments = std::nullopt;
  lens.angular_segments = max_angular_segments;
  CHECK(refusal(lens).empty());
  CHECK(kind_of(Warp(lens)) == "lamar");
  CHECK(warp_infos().front().pipelines.front() == "tessellated");
}

TEST_CASE("every refusal is one line that names the warp and the key") {
  struct Wrong {
    const char* key;
    std::function<void(LamarLens&)> spoil;
  };
  const std::vector<Wrong> wrongs = {
      {"zoom", [](LamarLens& l) { l.zoom = 0; }},
      {"zoom", [](LamarLens& l) { l.zoom = -2; }},
      {"zoom", [](LamarLens& l) { l.zoom = nan_value; }},
      {"zoom", [](LamarLens& l) { l.zoom = infinite; }},
      {"inner", [](LamarLens& l) { l.inner = 0; }},
      {"inner", [](LamarLens& l) { l.inner = -0.1; }},
      {"inner", [](LamarLens& l) { l.inner = nan_value; }},
      {"outer", [](LamarLens& l) { l.outer = nan_value; }},
      {"outer", [](LamarLens& l) { l.outer = infinite; }},
      {"outer", [](LamarLens& l) { l.outer = 0; }},
      {"inner", [](LamarLens& l) { l.inner = l.outer; }},
      {"inner", [](LamarLens& l) { l.inner = 2 * l.outer; }},
      {"depth_inner", [](LamarLens& l) { l.depth_inner = -0.1; }},
      {"depth_inner", [](LamarLens& l) { l.depth_inner = nan_value; }},
      {"depth_inner", [](LamarLens& l) { l.depth_inner = l.depth_outer = 0.1; }},
      {"depth_inner",
       [](LamarLens& l) { l.depth_inner = 0.5; }}, // beyond outer, which depth_outer defaults to
      {"depth_outer", [](LamarLens& l) { l.depth_outer = 0.01; }},
      {"depth_outer", [](LamarLens& l) { l.depth_outer = 0; }},
      {"depth_outer", [](LamarLens& l) { l.depth_outer = nan_value; }},
      {"depth_outer", [](LamarLens& l) { l.depth_outer = infinite; }},
      {"center", [](LamarLens& l) { l.center.y = nan_value; }},
      {"center", [](LamarLens& l) { l.center.z = infinite; }},
      {"angular_segments", [](LamarLens& l) { l.angular_segments = 0; }},
      {"angular_segments", [](LamarLens& l) { l.angular_segments = 2; }},
      {"angular_segments", [](LamarLens& l) { l.angular_segments = 1'000'000; }},
      {"radial_segments", [](LamarLens& l) { l.radial_segments = 0; }},
      {"radial_segments", [](LamarLens& l) { l.radial_segments = 1'000'000; }},
  };
  for (const Wrong& wrong : wrongs) {
    LamarLens lens;
    wrong.spoil(lens);
    const std::string message = refusal(lens);
    INFO(wrong.key << ": " << message);
    CHECK(message.find("warp 'lamar'") != std::string::npos);
    CHECK(message.find(wrong.key) != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("a centre so far outside that the lens touches nothing is refused, one that reaches in is not") {
  const BoxSpace space = box_space(make_box({400, 400, 128}, {1, 1, 1}, {0, 0, 0}, glm::dmat3(1)));
  LamarLens lens;
  for (const glm::dvec3& inside :
       {glm::dvec3(0.5), glm::dvec3(0), glm::dvec3(1), glm::dvec3(1.1, 0.5, 0.5)}) {
    lens.center = inside;
    CHECK(refusal([&] { validate_place(lens, space); }).empty());
  }
  for (const glm::dvec3& far : {glm::dvec3(9, 0.5, 0.5), glm::dvec3(0.5, -4, 0.5), glm::dvec3(1.3, 1.3, 3),
                                glm::dvec3(1e300, 0, 0)}) {
    lens.center = far;
    CHECK(refusal([&] { validate_place(lens, space); }).find("center") != std::string::npos);
  }
}

TEST_CASE("a lens behind the eye is refused under perspective") {
  View view = lens_cases::front_view();
  view.projection = Projection::perspective;
  view.eye = {0.5, 2, 0.5};
  const std::string message = refusal([&] { lens_cases::make_case(LamarLens{}, Box{}, view); });
  CHECK(message.find("center") != std::string::npos);
}

TEST_CASE("minifying lenses: valid ones are taken, folds refused") {
  // With inner = outer/2 and m = 1/Q the cubic's slope over x ∈ [0,1] is 9(m−1)x² − 10(m−1)x + m; it has a
  // double root where 64m = 100, so the limit is Q = .64. The others fold where inner/Q reaches outer: Q =
  // .5.
  CHECK(refusal(minifying(LensBorder::cubic, 0.9)).empty());
  CHECK(refusal(minifying(LensBorder::cubic, 0.641)).empty());
  CHECK(refusal(minifying(LensBorder::cubic, 0.639)).find("zoom") != std::string::npos);
  CHECK(refusal(minifying(LensBorder::cubic, 0.639)).find("cubic") != std::string::npos);
  for (const LensBorder border : {LensBorder::simple, LensBorder::linear}) {
    CHECK(refusal(minifying(border, 0.51)).empty());
    CHECK(refusal(minifying(border, 0.49)).find("zoom") != std::string::npos);
  }
}
