// Cohen's three tables by hand: eight texels, so that x = (2j + 1)/16 and everything below is a short binary
// fraction, exact in floats.
#include "axis_table_bytes.h"
#include "catch.h"
#include "core/errors.h"

using namespace slicelens;
using namespace axis_table_bytes;

namespace {

FocusEffects effects_of(const Warp& warp, double attenuation_power = 1) {
  return focus_effects({HighlightFunction::distance, 1, {0, 1, 0}, std::nullopt},
                       {AttenuationFunction::distance, attenuation_power, std::nullopt}, focus_region(warp));
}

} // namespace

TEST_CASE("table of an 8-texel axis, bifocal, bit by bit") {
  const AxisTables tables = make_axis_tables({bifocal_example()}, effects_of(bifocal_example()), {8, 8, 8});
  CHECK(tables.mask == AxisMask::test);
  for (const auto& axis : tables.texels)
    check_bits(axis, bifocal_bits());
}

TEST_CASE("table of an 8-texel axis, volume lens, bit by bit") {
  const AxisTables tables = make_axis_tables({lens_example()}, effects_of(lens_example()), {8, 8, 8});
  CHECK(tables.mask == AxisMask::test);
  for (const auto& axis : tables.texels)
    check_bits(axis, lens_bits());
}

TEST_CASE("table of an 8-texel axis, connected lens: the box lens' offsets, weights for masks") {
  const LensBox box = std::get<VolumeLens>(lens_example()).box;
  const Warp connected = ConnectedLens{box};
  const AxisTables tables = make_axis_tables({connected}, effects_of(connected), {8, 8, 8});
  CHECK(tables.mask == AxisMask::weight);
  std::vector<TexelBits> expected = lens_bits();
  // s = (δ − i)/(o − i) = 3/4 and 1/4: 1 − s²(3 − 2s) = .15625 and .84375.
  expected[1].mask = expected[6].mask = 0x3E200000;
  expected[2].mask = expected[5].mask = 0x3F580000;
  check_bits(tables.texels[0], expected);
}

TEST_CASE("table of an 8-texel axis, fisheye") {
  const Warp fisheye = Fisheye{};
  const AxisTables tables = make_axis_tables({fisheye}, effects_of(fisheye), {8, 8, 8});
  // d = 3, g = 7/8, 5/8, 3/8, 1/8: fractions 7/11, 5/17, 3/23, 1/29 of one half.
  const double fractions[4] = {7.0 / 11, 5.0 / 17, 3.0 / 23, 1.0 / 29};
  for (std::size_t j = 0; j < 8; ++j) {
    const double side = j < 4 ? -1 : 1;
    const double x = (2.0 * static_cast<double>(j) + 1) / 16;
    const glm::vec4& texel = tables.texels[0][j];
    INFO("texel " << j);
    CHECK(static_cast<double>(texel.r) ==
          Approx(0.5 + side * 0.5 * fractions[std::min(j, 7 - j)] - x).epsilon(1e-7)); // one float
    CHECK(texel.g == 1);
    const float inwards = 1 - std::abs(static_cast<float>(2 * x - 1)); // x/.5 and 1 − 2|.5 − x| alike
    CHECK(texel.b == inwards);
    CHECK(texel.a == inwards);
  }
}

TEST_CASE("tables follow the axes' own counts and parameters") {
  Fisheye fisheye;
  fisheye.distortion = {0, 1, 3};
  const AxisTables tables = make_axis_tables({fisheye}, effects_of(fisheye, 2), {4, 16, 2});
  REQUIRE(tables.texels[0].size() == 4);
  REQUIRE(tables.texels[1].size() == 16);
  REQUIRE(tables.texels[2].size() == 2);
  for (const glm::vec4& texel : tables.texels[0])
    CHECK(texel.r == 0);
  CHECK(static_cast<double>(tables.texels[1][3].r) ==
        Approx(0.5 - 0.5 * (9.0 / 16) / (2 - 9.0 / 16) - 7.0 / 32).epsilon(1e-6)); // x = 7/32, g = 9/16
  CHECK(static_cast<double>(tables.texels[2][0].r) ==
        Approx(0.5 - 0.5 * 0.2 - 0.25).epsilon(1e-6)); // g = 1/2
  CHECK(tables.texels[2][0].b == 0.25F);               // (1/4 / 1/2)²
}

TEST_CASE("without a warp the tables hold the effects alone") {
  const AxisRanges region = ranges_of(glm::dvec3(0.25), glm::dvec3(0.75));
  const FocusEffects effects =
      focus_effects({HighlightFunction::focus, 1, {0, 1, 0}, region}, {}, std::nullopt);
  const AxisTables tables = make_axis_tables({}, effects, {8, 8, 8});
  for (std::size_t j = 0; j < 8; ++j)
    CHECK(tables.texels[1][j] == glm::vec4(0, 1, 1, j < 2 || j > 5 ? 0 : 1));
}

TEST_CASE("several warps without masks are chained into one table") {
  Fisheye fisheye;
  const std::vector<Warp> warps = {bifocal_example(), fisheye};
  const AxisTables tables = make_axis_tables(warps, effects_of(fisheye), {8, 8, 8});
  // u = bifocal(fisheye(x)) (docs/pipeline.md: the last warp of the list is applied first from the display).
  // x = 1/16: fisheye 2/11 < 1/4, so 3/2 · 2/11.
  CHECK(static_cast<double>(tables.texels[0][0].r) == Approx(3.0 / 11 - 1.0 / 16).epsilon(1e-7));
  // x = 7/16: fisheye 1/2 − 1/58, in the middle of the bifocal: 1/2 − 1/116.
  CHECK(static_cast<double>(tables.texels[0][3].r) == Approx(0.5 - 1.0 / 116 - 7.0 / 16).epsilon(1e-6));
}

TEST_CASE("tables refuse what they cannot hold") {
  const auto refusal = [](const std::vector<Warp>& warps) {
    try {
      (void)make_axis_tables(warps, focus_effects({}, {}, std::nullopt), {8, 8, 8});
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(refusal({Bifocal{}, Fisheye{}}).empty());
  CHECK(refusal({LamarLens{}}).find("'lamar'") != std::string::npos);
  CHECK(refusal({LamarLens{}}).find("separable") != std::string::npos);
  for (const std::vector<Warp>& warps : std::vector<std::vector<Warp>>{
           {VolumeLens{}, Fisheye{}}, {Fisheye{}, VolumeLens{}}, {VolumeLens{}, VolumeLens{}}}) {
    CHECK(refusal(warps).find("'volume-lens'") != std::string::npos);
  }
  CHECK(refusal({ConnectedLens{}, Bifocal{}}).find("'connected-lens'") != std::string::npos);
}

TEST_CASE("masks of a volume lens' tables are exactly 0 or 1, as many ones as texels within") {
  VolumeLens lens;
  lens.box = {glm::dvec3(0.5), glm::dvec3(0.1), {0.25, 0.3, 0.26}, 2};
  const AxisTables tables = make_axis_tables({lens}, focus_effects({}, {}, std::nullopt), {16, 100, 33});
  const auto ones = [&](std::size_t axis) {
    std::size_t count = 0;
    for (const glm::vec4& texel : tables.texels[axis]) {
      CHECK((texel.g == 0 || texel.g == 1));
      count += texel.g == 1 ? 1 : 0;
      if (texel.g == 0)
        CHECK(texel.r == 0);
    }
    return count;
  };
  CHECK(ones(0) == 8);  // 16 · 2 · .25
  CHECK(ones(1) == 60); // 100 · 2 · .3
  CHECK(ones(2) == 17); // (2j + 1)/66 within (.24, .76): j = 8 … 24
}
