#include "catch.h"
#include "core/errors.h"
#include "volume/phantom.h"
#include "volume/transfer.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <set>

using namespace slicelens;

namespace {

TransferFunction function_of(std::vector<TransferPoint> points) { return {std::move(points), {}, "test"}; }

void check_rgba(const glm::dvec4& actual, const glm::dvec4& expected, double tolerance = 1e-12) {
  for (int c = 0; c < 4; ++c)
    CHECK(std::abs(actual[c] - expected[c]) <= tolerance);
}

std::string message_of(const TransferFunction& transfer) {
  try {
    validate(transfer);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

template <class T>
Volume volume_of(ScalarType type, const std::vector<T>& values) {
  Volume volume;
  volume.dims = {values.size(), 1, 1};
  volume.type = type;
  volume.voxels.resize(values.size() * sizeof(T));
  std::memcpy(volume.voxels.data(), values.data(), volume.voxels.size());
  update_statistics(volume);
  return volume;
}

} // namespace

TEST_CASE("a transfer function is linear between knots and constant beyond them") {
  const TransferFunction f = function_of({{-100, 1, 0, .5, 0}, {0, 0, 1, .5, .2}, {300, 0, 0, .5, .8}});
  check_rgba(evaluate(f, -1e9), {1, 0, .5, 0});
  check_rgba(evaluate(f, -100), {1, 0, .5, 0});
  check_rgba(evaluate(f, -25), {.25, .75, .5, .15}); // three quarters of the way: colour is not premultiplied
  check_rgba(evaluate(f, 0), {0, 1, .5, .2});
  check_rgba(evaluate(f, 100), {0, 2.0 / 3, .5, .4});
  check_rgba(evaluate(f, 300), {0, 0, .5, .8});
  check_rgba(evaluate(f, std::numeric_limits<double>::infinity()), {0, 0, .5, .8});
  check_rgba(evaluate(f, std::nan("")), {0, 0, 0, 0});
}

TEST_CASE("two knots at one value make a step that owns its right side") {
  const TransferFunction f =
      function_of({{0, 0, 0, 0, 0}, {10, 0, 0, 0, .5}, {10, 1, 1, 1, 1}, {20, 1, 1, 1, 0}});
  CHECK(evaluate(f, std::nextafter(10.0, 0.0)).a == Approx(.5));
  CHECK(evaluate(f, 10).a == 1);
  CHECK(evaluate(f, 15).a == Approx(.5));
  const TransferFunction step = step_transfer(3, {0, 0, 0, 0}, {.1, .2, .3, .4});
  check_rgba(evaluate(step, 2.999999), {0, 0, 0, 0});
  check_rgba(evaluate(step, 3), {.1, .2, .3, .4});
  check_rgba(evaluate(constant_transfer({.1, .2, .3, .4}), -7), {.1, .2, .3, .4});
}

TEST_CASE("an invalid transfer function is refused with index and value") {
  CHECK(message_of(function_of({{0, 0, 0, 0, 0}, {0, 1, 1, 1, 1}, {5, 1, 1, 1, 1}})).empty());
  CHECK(contains(message_of(function_of({})), "at least one point"));
  CHECK(contains(message_of(function_of({{0, 0, 0, 0, 0}, {5, 0, 0, 0, 1.5}})),
                 "point 1 (value 5): opacity is 1.5"));
  CHECK(contains(message_of(function_of({{0, -.1, 0, 0, 0}})), "point 0 (value 0): r is -0.1"));
  CHECK(contains(message_of(function_of({{0, 0, std::nan(""), 0, 0}})), "g is nan"));
  CHECK(contains(message_of(function_of({{7, 0, 0, 0, 0}, {5, 0, 0, 0, 0}})),
                 "point 1 (value 5) comes after value 7"));
  CHECK(contains(message_of(function_of({{5, 0, 0, 0, 0}, {5, 0, 0, 0, 0}, {5, 0, 0, 0, 0}})), "third"));
  CHECK(contains(message_of(function_of({{std::nan(""), 0, 0, 0, 0}})), "point 0"));
  CHECK(contains(message_of(function_of({{HUGE_VAL, 0, 0, 0, 0}})), "point 0"));
  for (const double distance : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    TransferFunction f = function_of({{0, 0, 0, 0, 0}});
    f.unit_distance = distance;
    CHECK(contains(message_of(f), "unit_distance"));
  }
}

TEST_CASE("a table's texels hold the function at their centres") {
  // Five texels over [0, 8]: centres at 0, 2, 4, 6, 8; opacity = value / 8.
  const TransferTable table = make_table(function_of({{0, 0, 0, 1, 0}, {8, 0, 0, 1, 1}}), 5);
  REQUIRE(texel_count(table) == 5);
  CHECK(table.first == 0);
  CHECK(table.last == 8);
  for (int i = 0; i < 5; ++i) {
    CHECK(table.rgba[static_cast<std::size_t>(4 * i + 3)] == Approx(i / 4.0));
    CHECK(table.rgba[static_cast<std::size_t>(4 * i + 2)] == 1);
  }
  CHECK(table.deviation < 1e-7);
  CHECK(table.steps == 0);
  // Three texels miss the knot at 2, where the function is 1 and the table, from (0,0) to (4,0), is 0.
  const TransferTable coarse =
      make_table(function_of({{0, 0, 0, 0, 0}, {2, 0, 0, 0, 1}, {4, 0, 0, 0, 0}, {8, 0, 0, 0, 0}}), 3);
  CHECK(coarse.deviation == Approx(1.0));
}

TEST_CASE("a table follows its function as closely as it says") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 30; ++round) {
    TransferFunction f;
    double value = -1000 * unit(random);
    for (int i = 0; i < 6; ++i) {
      f.points.push_back({value, unit(random), unit(random), unit(random), unit(random)});
      value += 20 + 400 * unit(random);
    }
    const TransferTable table = make_table(f);
    double largest = 0;
    for (int i = 0; i <= 20000; ++i) {
      const double v = table.first + (table.last - table.first) * i / 20000.0;
      const glm::dvec4 difference = glm::abs(evaluate(table, v) - evaluate(f, v));
      largest = std::max({largest, difference.r, difference.g, difference.b, difference.a});
    }
    // The scan cannot find more than the largest deviation, apart from the table's float rounding (6e-8).
    CHECK(largest <= table.deviation + 1e-7);
    CHECK((table.deviation < 1e-4 || texel_count(table) == kMaxTransferTexels));
    CHECK(texel_count(table) >= kMinTransferTexels);
  }
}

TEST_CASE("the automatic size puts knots on texel centres where it can") {
  // Knots at 1/3 of the span: a multiple of three intervals, 255 = 3·85 of them.
  const TransferTable thirds = make_table(function_of({{0, 0, 0, 0, 0}, {1, 0, 0, 0, 1}, {3, 0, 0, 0, 0}}));
  CHECK(texel_count(thirds) == 256);
  CHECK(thirds.deviation < 1e-7);
  // Halves need an even number of intervals.
  const TransferTable halves = make_table(function_of({{0, 0, 0, 0, 0}, {1, 0, 0, 0, 1}, {2, 0, 0, 0, 0}}));
  CHECK(texel_count(halves) == 257);
}

TEST_CASE("steps get the largest table, and lone steps are centred") {
  const TransferTable inner =
      make_table(function_of({{0, 0, 0, 0, 0}, {5, 0, 0, 0, 0}, {5, 0, 0, 0, 1}, {9, 0, 0, 0, 1}}));
  CHECK(texel_count(inner) == kMaxTransferTexels);
  CHECK(inner.steps == 1);
  CHECK(evaluate(inner, 5 - 9.0 / 16383).a == Approx(0).margin(1e-6));
  CHECK(evaluate(inner, 5 + 9.0 / 16383).a == Approx(1));
  // A lone step: the ramp's middle is on the step, its width 1/16384 of the data's range at most.
  const TransferTable lone = make_table(step_transfer(0, glm::dvec4(0), glm::dvec4(1)), 0, -0.1, 0.1);
  CHECK(evaluate(lone, 0).a == Approx(.5));
  CHECK(evaluate(lone, -0.2 / 16384).a == 0);
  CHECK(evaluate(lone, 0.2 / 16384).a == 1);
  // Steps on the span's ends keep their outer sides.
  const TransferTable ends =
      make_table(function_of({{0, 0, 0, 0, .1}, {0, 0, 0, 0, .6}, {64, 0, 0, 0, .6}, {64, 0, 0, 0, .2}}));
  CHECK(evaluate(ends, -1).a == Approx(.1));
  CHECK(evaluate(ends, 32).a == Approx(.6));
  CHECK(evaluate(ends, 65).a == Approx(.2));
}

TEST_CASE("a table covers only what the data can reach") {
  const TransferFunction f = function_of({{-3000, 0, 0, 0, 0}, {0, 0, 0, 0, .5}, {3000, 0, 0, 0, 1}});
  const TransferTable table = make_table(f, 0, 0, 255);
  CHECK(table.first == 0);
  CHECK(table.last == 255);
  CHECK(evaluate(table, 255).a == Approx(.5 + .5 * 255 / 3000));
  // Data beside the knots see a constant.
  const TransferTable beside = make_table(f, 0, 5000, 6000);
  CHECK(evaluate(beside, 5500).a == Approx(1));
  const TransferTable point = make_table(function_of({{40, .1, .2, .3, .4}}));
  CHECK(evaluate(point, -1e5).a == Approx(.4));
  CHECK(point.last > point.first);
  CHECK_THROWS_AS(make_table(f, 1), UsageError);
  CHECK_THROWS_AS(make_table(f, kMaxTransferTexels + 1), UsageError);
  CHECK_THROWS_AS(make_table(function_of({})), UsageError);
}

TEST_CASE("every preset is valid, visible, and has a faithful table") {
  const std::set<std::string> slicer = {"CT-AAA",
                                        "CT-AAA2",
                                        "CT-Bone",
                                        "CT-Bones",
                                        "CT-Cardiac",
                                        "CT-Cardiac2",
                                        "CT-Cardiac3",
                                        "CT-Chest-Contrast-Enhanced",
                                        "CT-Chest-Vessels",
                                        "CT-Coronary-Arteries",
                                        "CT-Coronary-Arteries-2",
                                        "CT-Coronary-Arteries-3",
                                        "CT-Cropped-Volume-Bone",
                                        "CT-Fat",
                                        "CT-Liver-Vasculature",
                                        "CT-Lung",
                                        "CT-MIP",
                                        "CT-Muscle",
                                        "CT-Pulmonary-Arteries",
                                        "CT-Soft-Tissue",
                                        "CT-Air",
                                        "CT-X-ray",
                                        "MR-Angio",
                                        "MR-Default",
                                        "MR-MIP",
                                        "MR-T2-Brain",
                                        "DTI-FA-Brain",
                                        "US-Fetal",
                                        "cast-and-steel",
                                        "halves",
                                        "grey-ramp",
                                        "fog",
                                        "opaque",
                                        "organs",
                                        "organs-labels",
                                        "colon"};
  std::set<std::string> names;
  for (const PresetInfo& info : presets()) {
    INFO(info.name);
    names.insert(info.name);
    CHECK_FALSE(info.description.empty());
    for (const auto& [low, high] : {std::pair{-1024.0, 3071.0}, std::pair{0.0, 255.0}, std::pair{5.0, 5.0}}) {
      const TransferFunction f = preset(info.name, low, high);
      CHECK_NOTHROW(validate(f));
      CHECK(f.name == info.name);
      double largest = 0;
      for (const TransferPoint& point : f.points)
        largest = std::max(largest, point.opacity);
      CHECK(largest > 0);
      CHECK(make_table(f).deviation < 1e-4);
    }
    // Relative ones follow the data, absolute ones do not.
    CHECK((preset(info.name, 0, 1).points.front().value == preset(info.name, 2, 4).points.front().value) !=
          info.relative);
  }
  CHECK(names == slicer);
  CHECK(names.size() == presets().size());
}

TEST_CASE("presets show the tissues they are named for") {
  const auto opacity = [](const char* name, double hu) { return evaluate(preset(name), hu).a; };
  // Air around the patient stays clear; three voxels of cortical bone hide what is behind.
  for (const PresetInfo& info : presets()) {
    if (info.relative || info.name == "CT-X-ray")
      continue;
    INFO(info.name);
    CHECK(opacity(info.name.c_str(), -1000) == 0);
  }
  for (const char* name : {"CT-Bone", "CT-Bones", "CT-Muscle", "CT-Cropped-Volume-Bone"})
    CHECK(1 - std::pow(1 - opacity(name, 1200), 3) > 0.9);
  CHECK(opacity("CT-Bone", 50) == 0);
  CHECK(opacity("CT-Fat", -90) > 5 * opacity("CT-Fat", 40));
  CHECK(opacity("CT-Lung", -700) > 0);
  CHECK(opacity("CT-Lung", 40) == 0);
  CHECK(opacity("CT-AAA", 300) > 5 * opacity("CT-AAA", 50));
  // The published linear attenuation model: opacity of CT-X-ray grows from air over water to bone.
  CHECK(opacity("CT-X-ray", -1000) == 0);
  CHECK(opacity("CT-X-ray", 1000) > 2 * opacity("CT-X-ray", 0));
  const TransferFunction grey = preset("grey-ramp", 100, 300);
  check_rgba(evaluate(grey, 200), {.5, .5, .5, .05});
  CHECK(evaluate(preset("opaque", -.1, .1), 0).a == 1);
  CHECK(evaluate(preset("opaque", -.1, .1), -1e-6).a == 0);
  check_rgba(evaluate(preset("halves", 1, 2), 1), {.9, .25, .15, .03});
  check_rgba(evaluate(preset("halves", 1, 2), 1.5), {.2, .45, .95, .03});
  // A constant volume is at the visible end.
  CHECK(evaluate(preset("fog", 1, 1), 1).a == Approx(.01));
  CHECK(evaluate(preset("opaque", 1, 1), 1).a == 1);
}

TEST_CASE("an unknown preset names the nearest one") {
  std::string message;
  try {
    preset("ct-bon");
  } catch (const UsageError& error) {
    message = error.what();
  }
  CHECK(contains(message, "did you mean 'CT-Bone'"));
}

TEST_CASE("the automatic function drops the background and shows the rest") {
  // Air at −1000, tissue at 40 and a little bone at 1200, with some spread.
  std::vector<std::int16_t> ct;
  for (int i = 0; i < 6000; ++i)
    ct.push_back(static_cast<std::int16_t>(-1000 + i % 40));
  for (int i = 0; i < 3000; ++i)
    ct.push_back(static_cast<std::int16_t>(20 + i % 40));
  for (int i = 0; i < 300; ++i)
    ct.push_back(static_cast<std::int16_t>(1150 + i % 100));
  const TransferFunction f = automatic_transfer(volume_of(ScalarType::i16, ct));
  CHECK_NOTHROW(validate(f));
  CHECK(evaluate(f, -961).a == 0);
  CHECK(evaluate(f, 20).a > 0);
  CHECK(evaluate(f, 1200).a > 3 * evaluate(f, 40).a);

  std::vector<float> mr(9000, 3.0F);
  for (int i = 0; i < 4000; ++i)
    mr.push_back(400.0F + static_cast<float>(i % 200));
  mr.push_back(std::numeric_limits<float>::quiet_NaN());
  mr.push_back(std::numeric_limits<float>::infinity());
  const TransferFunction g = automatic_transfer(volume_of(ScalarType::f32, mr));
  CHECK_NOTHROW(validate(g));
  CHECK(evaluate(g, 3).a == 0);
  CHECK(evaluate(g, 590).a > 0.3);
}

TEST_CASE("the automatic function handles labels, constants and extremes") {
  const TransferFunction labels =
      automatic_transfer(volume_of<std::uint8_t>(ScalarType::u8, {0, 0, 0, 1, 2, 25, 0}));
  CHECK_NOTHROW(validate(labels));
  CHECK(evaluate(labels, 0).a == 0);
  for (const double label : {1.0, 2.0, 25.0})
    CHECK(evaluate(labels, label).a == Approx(.5));
  for (const auto& values : {std::vector<double>{4, 4, 4}, std::vector<double>{std::nan(""), HUGE_VAL},
                             std::vector<double>{-1e308, 1e308, 0}, std::vector<double>{0, 1e-300},
                             std::vector<double>{0, 0, 0, 0, 0, 0, 1}, std::vector<double>{1e38, -1e38, 5}}) {
    const TransferFunction f = automatic_transfer(volume_of(ScalarType::f64, values));
    CHECK_NOTHROW(validate(f));
    CHECK_NOTHROW(make_table(f));
  }
  CHECK(evaluate(automatic_transfer(volume_of<std::uint8_t>(ScalarType::u8, {9, 9})), 9).a > 0);
}

TEST_CASE("window and level map the first point to level - window/2 and the last to level + window/2") {
  const TransferFunction f = function_of({{-100, 1, 0, .5, 0}, {0, 0, 1, .5, .2}, {300, 0, 0, .5, .8}});
  const TransferFunction g = windowed(f, 80, 40);
  CHECK(g.points[0].value == 0);
  CHECK(g.points[1].value == 20); // a quarter of the way: 0 lies 100 of 400 from the first point
  CHECK(g.points[2].value == 80);
  // The same colour at v as the function itself has at first + (v − (level − window/2))·(last −
  // first)/window.
  for (double v = -30; v < 120; v += 7)
    check_rgba(evaluate(g, v), evaluate(f, -100 + v * 400 / 80));
}

TEST_CASE("a window alone keeps the middle, a level alone the width") {
  const TransferFunction f = function_of({{-100, 1, 0, .5, 0}, {300, 0, 0, .5, .8}});
  CHECK(windowed(f, 40, {}).points[0].value == 80);
  CHECK(windowed(f, 40, {}).points[1].value == 120);
  CHECK(windowed(f, {}, -50).points[0].value == -250);
  CHECK(windowed(f, {}, -50).points[1].value == 150);
  CHECK(windowed(f, {}, {}).points[1].value == 300);
}

TEST_CASE("a window keeps steps as steps and the reference length of the opacities") {
  TransferFunction f = function_of({{0, 0, 0, 0, 0}, {.3, 0, 0, 0, 0}, {.3, 1, 1, 1, 1}, {1, 1, 1, 1, 1}});
  f.unit_distance = 2;
  const TransferFunction g = windowed(f, 1e-3, 700.1);
  CHECK(g.points[1].value == g.points[2].value);
  CHECK(g.points[1].value == Approx(700.1 - 0.5e-3 + 0.3e-3).epsilon(1e-12));
  CHECK(g.points[3].value == 700.1 + 0.5e-3);
  CHECK(g.unit_distance == 2);
  CHECK(windowed(step_transfer(5, {0, 0, 0, 0}, {1, 1, 1, 1}), {}, 7).points[1].value == 7);
}

TEST_CASE("windows that leave no room for the points are refused by name") {
  const auto message = [](const TransferFunction& f, double window, double level) -> std::string {
    try {
      (void)windowed(f, window, level);
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  };
  const TransferFunction f = function_of({{0, 0, 0, 0, 0}, {1, 0, 0, 0, 0}, {2, 1, 1, 1, 1}});
  CHECK(contains(message(f, 0, 1), "transfer.window is 0"));
  CHECK(contains(message(f, std::nan(""), 1), "transfer.window is"));
  CHECK(contains(message(f, 1e-20, 1), "fall together"));
  CHECK(contains(message(constant_transfer({1, 1, 1, 1}), 10, 1), "transfer.window: the transfer function"));
  CHECK(contains(message(f, 1e38, 1e38), "at most 1e38"));
}
