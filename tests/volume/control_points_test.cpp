// Curves with midpoints, sharpness and colour spaces against VTK's own, and as straight pieces.
//
// Expected numbers: VTK 9.1 (Debian's python3-vtk9), for instance
//   from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
//   f = vtkPiecewiseFunction(); f.AddPoint(0, 0.1, 0.3, 0.4); f.AddPoint(10, 0.9); f.GetValue(2.5)
//   from vtkmodules.vtkRenderingCore import vtkColorTransferFunction
//   c = vtkColorTransferFunction(); c.SetColorSpaceToLab(); c.SetHSVWrap(0)
//   c.AddRGBPoint(0, .2, .3, .8, 0.3, 0.4); c.AddRGBPoint(10, .9, .6, .1); c.GetColor(2.5)
#include "catch.h"
#include "core/errors.h"
#include "refusal.h"
#include "volume/control_points.h"

#include <array>
#include <limits>

using namespace slicelens;
using glm::dvec3;

namespace {

/// The numbers above are printed to nine digits.
constexpr double kPrinted = 1e-9;

ColorCurve between(ColorSpace space, const PieceShape& shape) {
  return {space, {{0, {.2, .3, .8}, shape}, {10, {.9, .6, .1}}}};
}

double largest(const dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

} // namespace

TEST_CASE("opacity curves are VTK's") {
  struct Row {
    PieceShape shape;
    std::array<double, 8> expected;
  };
  const std::vector<Row> rows = {
      {{0.5, 0}, {0.18, 0.3, 0.34, 0.42, 0.5, 0.58, 0.7, 0.82}},
      {{0.3, 0},
       {0.233333333, 0.433333333, 0.5, 0.557142857, 0.614285714, 0.671428571, 0.757142857, 0.842857143}},
      {{0.5, 0.5},
       {0.100012801, 0.103197861, 0.109974079, 0.171243203, 0.5, 0.828756797, 0.896802139, 0.899987199}},
      {{0.3, 0.4},
       {0.100991713, 0.230019519, 0.5, 0.745509529, 0.847592793, 0.884504711, 0.898597405, 0.899985719}},
      {{0.7, 0.9},
       {0.1, 0.100001351, 0.100008385, 0.100155916, 0.102020833, 0.131540148, 0.880212678, 0.899999322}},
      {{0.4, 1.0}, {0.1, 0.1, 0.1, 0.9, 0.9, 0.9, 0.9, 0.9}},
      {{0.5, 0.005}, {0.18, 0.3, 0.34, 0.42, 0.5, 0.58, 0.7, 0.82}},
  };
  const double at[] = {1, 2.5, 3, 4, 5, 6, 7.5, 9};
  for (const Row& row : rows) {
    const OpacityCurve curve{{{0, .1, row.shape}, {10, .9}}};
    for (std::size_t i = 0; i < row.expected.size(); ++i) {
      INFO("midpoint " << row.shape.midpoint << ", sharpness " << row.shape.sharpness << ", at " << at[i]);
      CHECK(std::abs(evaluate(curve, at[i]) - row.expected[i]) <= kPrinted);
    }
  }
}

TEST_CASE("colour curves in every space are VTK's") {
  struct Row {
    ColorSpace space;
    PieceShape shape;
    std::vector<dvec3> expected;
  };
  const std::vector<Row> rows = {
      {ColorSpace::rgb,
       {0.5, 0},
       {{0.27, 0.33, 0.73},
        {0.375, 0.375, 0.625},
        {0.55, 0.45, 0.45},
        {0.725, 0.525, 0.275},
        {0.83, 0.57, 0.17}}},
      {ColorSpace::hsv,
       {0.5, 0},
       {{0.19125, 0.492890625, 0.81},
        {0.177604167, 0.80476888, 0.825},
        {0.153472222, 0.85, 0.313093171},
        {0.555799696, 0.875, 0.127604167},
        {0.89, 0.847817708, 0.11125}}},
      {ColorSpace::lab,
       {0.5, 0},
       {{0.371705673, 0.322122722, 0.74135935},
        {0.518264026, 0.360313742, 0.653387157},
        {0.679834664, 0.433484293, 0.504380355},
        {0.799809105, 0.514340432, 0.342697188},
        {0.861573146, 0.565291518, 0.223065152}}},
      {ColorSpace::diverging,
       {0.5, 0},
       {{0.307839766, 0.504172229, 0.977583975},
        {0.488966618, 0.689611607, 1.0},
        {0.999982792, 1.0, 0.99998321},
        {1.0, 0.806681215, 0.578914268},
        {1.0, 0.721942364, 0.342294112}}},
      {ColorSpace::step,
       {0.5, 0},
       {{0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}}},
      {ColorSpace::hsv_wrapped,
       {0.5, 0},
       {{0.260859375, 0.19125, 0.81},
        {0.521533203, 0.177604167, 0.825},
        {0.85, 0.153472222, 0.690379051},
        {0.875, 0.127604167, 0.18210178},
        {0.89, 0.380567708, 0.11125}}},
      {ColorSpace::rgb,
       {0.3, 0.4},
       {{0.200867749, 0.300371892, 0.799132251},
        {0.31376708, 0.34875732, 0.68623292},
        {0.854143694, 0.580347298, 0.145856306},
        {0.898772729, 0.599474027, 0.101227271},
        {0.899987504, 0.599994645, 0.100012496}}},
      {ColorSpace::hsv,
       {0.3, 0.4},
       {{0.199893232, 0.302318915, 0.800123964},
        {0.18563798, 0.619563231, 0.81625244},
        {0.893449099, 0.763888537, 0.107401145},
        {0.899824676, 0.604463168, 0.100199632},
        {0.899998215, 0.600045463, 0.100002033}}},
      {ColorSpace::lab,
       {0.3, 0.4},
       {{0.203272519, 0.300252818, 0.799274011},
        {0.440881867, 0.337390758, 0.704719873},
        {0.875038656, 0.577208622, 0.188484412},
        {0.899338584, 0.599411921, 0.103199977},
        {0.899990131, 0.600019306, 0.100059347}}},
      {ColorSpace::diverging,
       {0.3, 0.4},
       {{0.201812765, 0.30428858, 0.804155991},
        {0.42263566, 0.63409671, 1.0},
        {0.996192373, 0.71536821, 0.328534365},
        {0.903447059, 0.603813179, 0.110079494},
        {0.900032298, 0.600064392, 0.100132648}}},
      {ColorSpace::step,
       {0.3, 0.4},
       {{0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}}},
      {ColorSpace::rgb,
       {0.3, 1.0},
       {{0.2, 0.3, 0.8}, {0.2, 0.3, 0.8}, {0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}, {0.9, 0.6, 0.1}}},
  };
  const double at[] = {1, 2.5, 5, 7.5, 9};
  for (const Row& row : rows) {
    const ColorCurve curve = between(row.space, row.shape);
    for (std::size_t i = 0; i < row.expected.size(); ++i) {
      INFO("space " << static_cast<int>(row.space) << ", midpoint " << row.shape.midpoint << ", at "
                    << at[i]);
      CHECK(largest(evaluate(curve, at[i]) - row.expected[i]) <= kPrinted);
    }
  }
  // One unsaturated end: half of ParaView's "Cool to Warm".
  const ColorCurve half{ColorSpace::diverging,
                        {{0, {0.23137254902, 0.298039215686, 0.752941176471}}, {10, {.865, .865, .865}}}};
  CHECK(largest(evaluate(half, 5) - dvec3(0.553524281, 0.688407392, 0.994915114)) <= kPrinted);
  // SetScaleToLog10(), black at 1 and white at 100.
  const ColorCurve logarithmic{ColorSpace::rgb, {{1, dvec3(0)}, {100, dvec3(1)}}, true};
  CHECK(std::abs(evaluate(logarithmic, 10).r - 0.5) <= kPrinted);
  CHECK(std::abs(evaluate(logarithmic, 50).r - 0.849485002) <= kPrinted);
}

TEST_CASE("straight and stepped pieces join exactly") {
  // Knots of both curves, the mean at a moved midpoint, and two points where there is a step.
  const ColorCurve color{ColorSpace::rgb, {{0, {0, 0, 0}, {.25, 0}}, {4, {1, 0, 0}}, {8, {1, 1, 0}}}};
  const OpacityCurve opacity{{{2, 0, {.5, 1}}, {6, .5}, {6, .75}, {7, 1}}};
  const JoinedCurves joined = join(color, opacity);
  CHECK_FALSE(joined.resampled);
  CHECK(joined.deviation < 1e-15);
  const std::vector<std::array<double, 5>> expected = {
      {0, 0, 0, 0, 0},   {1, .5, 0, 0, 0},   {2, .5 + .5 / 3, 0, 0, 0}, {4, 1, 0, 0, 0}, {4, 1, 0, 0, .5},
      {6, 1, .5, 0, .5}, {6, 1, .5, 0, .75}, {7, 1, .75, 0, 1},         {8, 1, 1, 0, 1}};
  REQUIRE(joined.transfer.points.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const TransferPoint& p = joined.transfer.points[i];
    INFO("point " << i);
    CHECK(p.value == Approx(expected[i][0]));
    CHECK(p.r == Approx(expected[i][1]));
    CHECK(p.g == Approx(expected[i][2]));
    CHECK(p.b == Approx(expected[i][3]));
    CHECK(p.opacity == Approx(expected[i][4]));
  }
}

TEST_CASE("a transfer function split into curves joins to itself") {
  for (const PresetInfo& info : presets()) {
    INFO(info.name);
    const TransferFunction original = preset(info.name, -3, 11);
    ColorCurve color;
    OpacityCurve opacity;
    for (const TransferPoint& p : original.points) {
      color.points.push_back({p.value, {p.r, p.g, p.b}});
      opacity.points.push_back({p.value, p.opacity});
    }
    const JoinedCurves joined = join(color, opacity);
    CHECK_FALSE(joined.resampled);
    CHECK(joined.deviation < 1e-15);
    REQUIRE(joined.transfer.points.size() == original.points.size());
    for (std::size_t i = 0; i < original.points.size(); ++i) {
      CHECK(joined.transfer.points[i].value == original.points[i].value);
      CHECK(joined.transfer.points[i].g == original.points[i].g);
      CHECK(joined.transfer.points[i].opacity == original.points[i].opacity);
    }
  }
}

TEST_CASE("bent pieces become straight ones within the tolerance, and say how far they are off") {
  for (const ColorSpace space :
       {ColorSpace::hsv, ColorSpace::hsv_wrapped, ColorSpace::lab, ColorSpace::diverging}) {
    for (const PieceShape& shape : {PieceShape{.5, 0}, PieceShape{.2, .3}, PieceShape{.5, .98}}) {
      INFO("space " << static_cast<int>(space) << ", sharpness " << shape.sharpness);
      const ColorCurve color = between(space, shape);
      const OpacityCurve opacity{{{0, 0, shape}, {10, 1}}};
      const JoinedCurves joined = join(color, opacity);
      CHECK(joined.resampled);
      CHECK(joined.deviation > 0);
      // Twice: the probes that steer are not those that measure.
      CHECK(joined.deviation < 2 * kResamplingTolerance);
      CHECK(joined.transfer.points.size() < 400);
      double worst = 0;
      for (int i = 0; i <= 5000; ++i) {
        const double value = 10 * i / 5000.0;
        const glm::dvec4 is = evaluate(joined.transfer, value);
        worst = std::max(
            {worst, largest(dvec3(is) - evaluate(color, value)), std::abs(is.a - evaluate(opacity, value))});
      }
      CHECK(worst < 2 * kResamplingTolerance);
    }
  }
}

TEST_CASE("curves that are none are refused with the point's number") {
  const OpacityCurve flat{{{0, .5}}};
  const auto color = [](std::vector<ColorPoint> points, bool logarithmic = false) {
    return ColorCurve{ColorSpace::rgb, std::move(points), logarithmic};
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto problem = [&](const ColorCurve& curve) { return refusal([&] { (void)join(curve, flat); }); };
  CHECK(problem(color({})) == "there is no colour point; at least one is needed");
  CHECK(problem(color({{0, dvec3(0)}, {nan, dvec3(0)}})).find("colour point 2 (value nan)") == 0);
  CHECK(problem(color({{3, dvec3(0)}, {2, dvec3(0)}})) ==
        "colour point 2 (value 2): values must not decrease, and the one before is 3");
  CHECK(problem(color({{3, dvec3(0, 1.5, 0)}})).find("green is 1.5; it must be in [0,1]") !=
        std::string::npos);
  CHECK(problem(color({{3, dvec3(0), {.5, nan}}})).find("sharpness is nan") != std::string::npos);
  CHECK(problem(color({{0, dvec3(0)}}, true)).find("a logarithmic scale needs values above 0") !=
        std::string::npos);
  CHECK(problem(color(std::vector<ColorPoint>(kMaxControlPoints + 1))).find("at most 16384 are taken") !=
        std::string::npos);
  CHECK(refusal([&] {
          (void)join(color({{0, dvec3(0)}}), {{{0, -1}}});
        }).find("opacity is -1") != std::string::npos);
}
