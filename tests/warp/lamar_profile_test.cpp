#include "catch.h"
#include "lens_cases.h"

using namespace slicelens;
using lens_cases::random_in;

namespace {

constexpr LensBorder borders[] = {LensBorder::simple, LensBorder::linear, LensBorder::cubic};

RadialProfile f(LensBorder border, double zoom, double inner, double outer, double r) {
  return radial_profile(border, 1 / zoom, inner, outer, r);
}

} // namespace

TEST_CASE("the points worked by hand beside the shader: Q = 4, radii 1/2 and 1") {
  CHECK(f(LensBorder::linear, 4, 0.5, 1, 0.25).value == 1.0 / 16);
  CHECK(f(LensBorder::linear, 4, 0.5, 1, 0.5).value == 1.0 / 8);
  CHECK(f(LensBorder::linear, 4, 0.5, 1, 0.75).value == Approx(9.0 / 16).epsilon(1e-15));
  CHECK(f(LensBorder::linear, 4, 0.5, 1, 1).value == 1);
  CHECK(f(LensBorder::linear, 4, 0.5, 1, 2).value == 2);
  CHECK(f(LensBorder::cubic, 4, 0.5, 1, 0.75).value == Approx(33.0 / 64).epsilon(1e-15));
  CHECK(f(LensBorder::simple, 4, 0.5, 1, 0.75).value == Approx(0.75 / 2.5).epsilon(1e-15)); // q half way: 2.5
}

TEST_CASE("the same points through the map, in a box of edge 4") {
  LamarLens lens;
  lens.border = LensBorder::linear;
  lens.inner = 0.125; // a quarter of the points above: the lens fits in the box
  lens.outer = 0.25;
  lens.depth_inner = 0.1;
  lens.depth_outer = 0.2;
  const Box box = make_box({4, 4, 4}, {1, 1, 1}, {0.5, 0.5, 0.5}, glm::dmat3(1));
  const auto c = lens_cases::make_case(lens, box, lens_cases::front_view());
  const auto moved = [&](double r) {
    return texture_from_object(c.map, {0.5 + r / 4, 0.5, 0.5}).x * 4 - 2; // back in quarters from the axis
  };
  CHECK(moved(0.25) == Approx(1.0 / 16).epsilon(1e-14));
  CHECK(moved(0.5) == Approx(1.0 / 8).epsilon(1e-14));
  CHECK(moved(0.75) == Approx(9.0 / 16).epsilon(1e-14));
  CHECK(moved(1) == Approx(1));
  CHECK(moved(2) == Approx(2));
}

TEST_CASE("values and slopes at both ends of the border") {
  for (const double zoom : {1.0, 2.0, 4.0, 8.0}) {
    const double inner = 0.12;
    const double outer = 0.2;
    // One-sided slopes: 1e-10 inside the border, where the largest curvature (some 1/width² of the values)
    // moves a slope by less than 1e-6.
    const double after = inner + 1e-10;
    const double before = outer - 1e-10;
    for (const LensBorder border : borders) {
      CHECK(f(border, zoom, inner, outer, inner).value == Approx(inner / zoom).epsilon(1e-14));
      CHECK(f(border, zoom, inner, outer, after).value == Approx(inner / zoom).epsilon(1e-6));
      CHECK(f(border, zoom, inner, outer, before).value == Approx(outer).epsilon(1e-6));
      CHECK(f(border, zoom, inner, outer, outer).value == outer);
      CHECK(f(border, zoom, inner, outer, 0.5 * inner).slope == Approx(1 / zoom).epsilon(1e-14));
      CHECK(f(border, zoom, inner, outer, 2 * outer).slope == 1);
    }
    const double compression = (outer - inner / zoom) / (outer - inner);
    CHECK(f(LensBorder::linear, zoom, inner, outer, after).slope == Approx(compression).epsilon(1e-12));
    CHECK(f(LensBorder::linear, zoom, inner, outer, before).slope == Approx(compression).epsilon(1e-12));
    CHECK(f(LensBorder::cubic, zoom, inner, outer, after).slope == Approx(1 / zoom).margin(1e-6));
    CHECK(f(LensBorder::cubic, zoom, inner, outer, before).slope == Approx(1).margin(1e-6));
    // f = r/q: f' = 1/q − r·q'/q² with q' = (1 − Q)/width.
    const double fall = (1 - zoom) / (outer - inner);
    CHECK(f(LensBorder::simple, zoom, inner, outer, after).slope ==
          Approx(1 / zoom - inner * fall / (zoom * zoom)).epsilon(1e-6));
    CHECK(f(LensBorder::simple, zoom, inner, outer, before).slope == Approx(1 - outer * fall).epsilon(1e-6));
  }
}

TEST_CASE("any profile: the formulas of its page, its slope their derivative, rising for every zoom from 1") {
  CHECK(rc::check([] {
    LamarLens lens;
    lens.outer = random_in(0.1, 1);
    lens.inner = random_in(0.01, 0.95) * lens.outer;
    lens.zoom = random_in(1, 50);
    for (const LensBorder border : borders) {
      lens.border = border;
      double last = 0;
      for (int i = 1; i <= 300; ++i) {
        const double r = 1.2 * lens.outer * i / 300;
        const RadialProfile at = f(border, lens.zoom, lens.inner, lens.outer, r);
        RC_ASSERT(std::abs(at.value - lens_cases::profile(lens, lens.zoom, r)) < 1e-13);
        RC_ASSERT(at.value > last);
        RC_ASSERT(at.slope > 0);
        last = at.value;
        const double width = lens.outer - lens.inner;
        const double h = 1e-6 * width;
        if (std::min(std::abs(r - lens.inner), std::abs(r - lens.outer)) < 2 * h)
          continue;
        const double difference =
            (lens_cases::profile(lens, lens.zoom, r + h) - lens_cases::profile(lens, lens.zoom, r - h)) /
            (2 * h);
        // Differences lose 1e-16·value/h; their own error, h²f''', is smaller still.
        RC_ASSERT(std::abs(at.slope - difference) < 1e-6 * std::max(1.0, at.slope) + 1e-15 / h);
      }
    }
  }));
}

TEST_CASE("zoom 1 is the identity for every border, without a special case") {
  for (const LensBorder border : borders) {
    for (int i = 0; i <= 100; ++i) {
      const double r = 0.003 * i;
      CHECK(f(border, 1, 0.12, 0.2, r).value == Approx(r).margin(1e-15));
      CHECK(f(border, 1, 0.12, 0.2, r).slope == Approx(1).margin(1e-12));
    }
  }
}

TEST_CASE("the zoom of a plane falls from Q at depth_inner to 1 at depth_outer") {
  LamarLens lens;
  lens.zoom = 4;
  lens.depth_inner = 0.1;
  lens.depth_outer = 0.3;
  for (const LensBorder border : borders) {
    lens.border = border;
    const auto c = lens_cases::make_case(lens, Box{}, lens_cases::front_view());
    CHECK(minification_at(c.map, 0) == 0.25);
    CHECK(minification_at(c.map, 0.1) == 0.25);
    CHECK(minification_at(c.map, 0.3) == 1);
    CHECK(minification_at(c.map, 0.9) == 1);
    // Half way w is 1/2 for both; a quarter of the way it is 1/4, or 3/16 − 2/64 = 5/32 for the cubic.
    CHECK(minification_at(c.map, 0.2) == Approx(0.25 + 0.75 / 2).epsilon(1e-12));
    const double quarter = border == LensBorder::cubic ? 5.0 / 32 : 1.0 / 4;
    CHECK(minification_at(c.map, 0.15) == Approx(0.25 + 0.75 * quarter).epsilon(1e-12));
  }
}
