// Tables of pre-integrated segments against formulas.
#include "catch.h"
#include "core/errors.h"
#include "volume/segment_table.h"

#include <cmath>

using namespace slicelens;

namespace {

/// ∫ −ln(1 − α) dα from 0 to a, over a: the mean extinction of a ramp of opacity.
double mean_of_ramp(double a) { return (a + (1 - a) * std::log(1 - a)) / a; }

double value_of(const SegmentTable& table, std::size_t i) {
  return table.first +
         (table.last - table.first) * static_cast<double>(i) / static_cast<double>(table.texels - 1);
}

} // namespace

TEST_CASE("segments of a constant function have its colour and the corrected opacity") {
  const SegmentTable table = make_segment_table(constant_transfer({0.8, 0.4, 0.2, 0.3}), -5, 20, 2.5, 64);
  const double opacity = 1 - std::pow(0.7, 2.5);
  for (const double front : {-5.0, 0.0, 7.3, 20.0}) {
    for (const double back : {-5.0, 0.1, 20.0}) {
      const glm::dvec4 segment = evaluate(table, front, back);
      CHECK(segment.a == Approx(opacity).epsilon(1e-6)); // floats
      CHECK(segment.r == Approx(0.8 * opacity).epsilon(1e-6));
      CHECK(segment.b == Approx(0.2 * opacity).epsilon(1e-6));
    }
  }
}

TEST_CASE("a ramp of opacity is integrated in closed form") {
  const TransferFunction ramp{{{0, 1, 1, 1, 0}, {1, 1, 1, 1, 0.9}}, std::nullopt, ""};
  const SegmentTable table = make_segment_table(ramp, 0, 1, 3, 101);
  CHECK(evaluate(table, 0, 1).a == Approx(1 - std::exp(-3 * mean_of_ramp(0.9))).epsilon(1e-6));
  CHECK(evaluate(table, 1, 0).a == Approx(1 - std::exp(-3 * mean_of_ramp(0.9))).epsilon(1e-6));
  CHECK(evaluate(table, 0, 0.5).a == Approx(1 - std::exp(-3 * mean_of_ramp(0.45))).epsilon(1e-6));
  CHECK(evaluate(table, 0.4, 0.4).a == Approx(1 - std::pow(1 - 0.36, 3)).epsilon(1e-6));
}

TEST_CASE("a peak thinner than a texel is not missed") {
  // Opaque up to .95 within 1/1000 of the range, off every texel of 64: the segment over the whole range sees
  // it.
  const double middle = 0.5037;
  const double half = 5e-4;
  const TransferFunction peak{
      {{middle - half, 1, 0, 0, 0}, {middle, 1, 0, 0, 0.95}, {middle + half, 1, 0, 0, 0}}, std::nullopt, ""};
  const SegmentTable table = make_segment_table(peak, 0, 1, 100, 64);
  const double depth = 100 * 2 * half * mean_of_ramp(0.95);
  CHECK(evaluate(table, 0, 1).a == Approx(1 - std::exp(-depth)).epsilon(1e-6));
  CHECK(evaluate(table, 1, 0).r == Approx(1 - std::exp(-depth)).epsilon(1e-6));
  CHECK(evaluate(table, 0, 32.0 / 63).a == Approx(1 - std::exp(-depth * 63 / 32)).epsilon(1e-6));
  CHECK(evaluate(table, 0, 0.4).a == 0);
}

TEST_CASE("what lies in front hides what lies behind") {
  // Red below ½, green above: from 0 to 1 half the segment is red and hides the green by its transmittance.
  const TransferFunction halves{
      {{0, 1, 0, 0, 0.6}, {0.5, 1, 0, 0, 0.6}, {0.5, 0, 1, 0, 0.6}, {1, 0, 1, 0, 0.6}}, std::nullopt, ""};
  const SegmentTable table = make_segment_table(halves, 0, 1, 2, 65); // a texel on the step
  const double half = 0.6;                                            // opacity of one reference length
  CHECK(evaluate(table, 0, 1).r == Approx(half).epsilon(1e-6));
  CHECK(evaluate(table, 0, 1).g == Approx((1 - half) * half).epsilon(1e-6));
  CHECK(evaluate(table, 1, 0).g == Approx(half).epsilon(1e-6));
  CHECK(evaluate(table, 1, 0).r == Approx((1 - half) * half).epsilon(1e-6));
}

TEST_CASE("segments join: two halves composited are the whole") {
  // Where both are texels. A segment from 0 to ¾ of length L is one from 0 to ½ of ⅔ L and one from ½ to ¾ of
  // ⅓ L.
  const TransferFunction transfer{
      {{0, 1, 0, 0.2, 0.1}, {0.3, 0.2, 0.9, 0, 0.999}, {0.35, 0, 0.3, 1, 0.02}, {1, 1, 1, 1, 1}},
      std::nullopt,
      ""};
  const auto at = [&](double ratio, double front, double back) {
    return evaluate(make_segment_table(transfer, 0, 1, ratio, 257), front, back);
  };
  for (const bool forward : {true, false}) {
    const glm::dvec4 low = forward ? at(2, 0, 0.5) : at(2, 0.5, 0);
    const glm::dvec4 high = forward ? at(1, 0.5, 0.75) : at(1, 0.75, 0.5);
    const glm::dvec4 front = forward ? low : high;
    const glm::dvec4 back = forward ? high : low;
    const glm::dvec4 whole = forward ? at(3, 0, 0.75) : at(3, 0.75, 0);
    for (int c = 0; c < 4; ++c)
      CHECK(whole[c] ==
            Approx(front[c] + (1 - front.a) * back[c]).margin(2e-4)); // colours mix within an eighth
    CHECK(whole.a == Approx(front.a + (1 - front.a) * back.a).epsilon(1e-6));
  }
}

TEST_CASE("opaque and constant data have tables; wrong requests are refused") {
  const SegmentTable opaque = make_segment_table(constant_transfer({1, 1, 1, 1}), 0, 1, 0.5, 16);
  CHECK(evaluate(opaque, 0, 1).a == Approx(1));
  const SegmentTable constant = make_segment_table(constant_transfer({1, 1, 1, 0.5}), 7, 7, 1, 16);
  CHECK(constant.first < 7);
  CHECK(constant.last > 7);
  CHECK(evaluate(constant, 7, 7).a == Approx(0.5));
  const SegmentTable any = make_segment_table(preset("grey-ramp", 0, 1), 0, 1, 1);
  CHECK(any.texels == kSegmentTexels);
  CHECK(value_of(any, any.texels - 1) == Approx(1));
  CHECK_THROWS_AS(make_segment_table(preset("grey-ramp", 0, 1), 0, 1, 0), UsageError);
  CHECK_THROWS_AS(make_segment_table(preset("grey-ramp", 0, 1), 0, 1, 1, 1), UsageError);
  CHECK_THROWS_AS(make_segment_table({}, 0, 1, 1), UsageError);
}
