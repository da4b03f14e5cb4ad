// The frog and the colon: their tables, places and volumes.
#include "catch.h"
#include "volume/phantom.h"
#include "volume/phantom_colon.h"
#include "volume/phantom_organs.h"
#include "volume/transfer.h"

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

using namespace slicelens;

namespace {

constexpr double pi = std::numbers::pi;

double ball(double r) { return 4.0 / 3 * pi * r * r * r; }
double ellipsoid(const glm::dvec3& r) { return 4.0 / 3 * pi * r.x * r.y * r.z; }

/// Value of the voxel that holds a position in millimetres from the box centre.
double at_mm(const Volume& volume, const glm::dvec3& p) {
  const glm::dvec3 index = glm::round((p - volume.origin) / volume.spacing);
  return value_at(volume, static_cast<std::size_t>(index.x), static_cast<std::size_t>(index.y),
                  static_cast<std::size_t>(index.z));
}

const Volume& labels() {
  static const Volume volume = make_phantom("organs-labels", {256, 256, 128});
  return volume;
}

} // namespace

TEST_CASE("the table of organs has each label once and a value of its own") {
  std::set<double> values;
  std::set<std::string> names;
  for (std::size_t i = 0; i < organs().size(); ++i) {
    CHECK(organs()[i].label == static_cast<int>(i));
    values.insert(organs()[i].value);
    names.insert(organs()[i].name);
  }
  CHECK(organs().size() == 20);
  CHECK(values.size() == 20);
  CHECK(names.size() == 20);
}

TEST_CASE("organs have the volumes of their shapes") {
  const Volume& volume = labels();
  std::vector<std::size_t> counts(organs().size());
  std::size_t others = 0;
  for (std::size_t i = 0; i < voxel_count(volume); ++i) {
    const double label = scalar_at(volume, i);
    if (label == std::floor(label) && label < static_cast<double>(counts.size()))
      ++counts[static_cast<std::size_t>(label)];
    else
      ++others;
  }
  CHECK(others == 0);
  for (std::size_t label = 0; label < counts.size(); ++label) {
    INFO(organs()[label].name);
    CHECK(counts[label] > 0);
  }
  const double voxel = volume.spacing.x * volume.spacing.y * volume.spacing.z;
  const auto check = [&](frog::Organ organ, double expected, double tolerance) {
    INFO(organs()[organ].name);
    CHECK(static_cast<double>(counts[organ]) * voxel == Approx(expected).epsilon(tolerance));
  };
  using namespace frog;
  // Voxels of 0.625 mm counted by their centres: the error of a ball of radius r goes with its surface's
  // discrepancy, below 3 % for radii of three voxels and more.
  check(spleen, ball(kSpleenRadius), .03);
  check(gall_bladder, ball(kGallRadius), .03);
  check(lens, 2 * ball(kLensRadius), .03);
  check(kidney, 2 * ellipsoid(kKidneyRadii), .03);
  // The lens' volume inside the eyeball, two balls of radii R and r at distance d:
  // π (R + r − d)² (d² + 2d(r + R) − 3(r − R)²) / (12 d).
  const double d = glm::length(kLensCenter - kEyeCenter);
  const double R = kEyeRadius;
  const double r = kLensRadius;
  const double common =
      pi * std::pow(R + r - d, 2) * (d * d + 2 * d * (r + R) - 3 * (r - R) * (r - R)) / (12 * d);
  check(eye, 2 * (ball(R) - common), .03);
}

TEST_CASE("the frog's values and labels are of one animal") {
  const Volume values = make_phantom("organs", {256, 256, 128});
  CHECK(values.spacing == labels().spacing);
  CHECK(values.origin == labels().origin);
  std::size_t whole = 0;
  std::size_t wrong = 0;
  for (std::size_t k = 2; k < 126; ++k) {
    for (std::size_t j = 2; j < 254; ++j) {
      for (std::size_t i = 2; i < 254; ++i) {
        const double label = value_at(labels(), i, j, k);
        if (label == 0)
          continue;
        // Where two voxels around have the same label, twice what partial volume reaches, the value is the
        // table's. Surfaces of thin pieces bend too much for less.
        bool inside = true;
        for (std::size_t n = 0; n < 125 && inside; ++n)
          inside = value_at(labels(), i - 2 + n % 5, j - 2 + n / 5 % 5, k - 2 + n / 25) == label;
        if (!inside)
          continue;
        ++whole;
        wrong += value_at(values, i, j, k) != organs()[static_cast<std::size_t>(label)].value ? 1 : 0;
      }
    }
  }
  CHECK(whole > 80000);
  CHECK(static_cast<double>(wrong) < 0.002 * static_cast<double>(whole));
}

TEST_CASE("the frog lies as documented") {
  using namespace frog;
  const auto label = [](const glm::dvec3& p) { return static_cast<int>(at_mm(labels(), p)); };
  CHECK(label(kEyeCenter - glm::dvec3(1, -1, 1)) == eye); // in front, above
  CHECK(label(kKidneyCenter) == kidney);
  CHECK(label(kKidneyCenter * glm::dvec3(-1, 1, 1)) == kidney);
  CHECK(label(kSpleenCenter) == spleen);
  CHECK(label({13, 8, -3}) == stomach); // on the left only
  CHECK(label({-13, 8, -3}) != stomach);
  CHECK(label({-9.5, 1, -8.5}) == liver);
  CHECK(label({0, -8, -10}) == heart);
  CHECK(label({-13, 0, 0}) == lung);
  CHECK(label({25, 25.5, -3.5}) == skeleton); // thigh bone, half-way from hip to knee
  CHECK(label({0, 0, 30}) == 0);              // nothing above its back
}

TEST_CASE("the preset of labels is constant between the half numbers") {
  const TransferFunction transfer = preset("organs-labels");
  for (const OrganInfo& organ : organs()) {
    INFO(organ.name);
    const glm::dvec4 color = evaluate(transfer, organ.label);
    CHECK(evaluate(transfer, organ.label - 0.49) == color);
    CHECK(evaluate(transfer, organ.label + 0.49) == color);
    CHECK((color.a > 0) == (organ.label > 0));
  }
}

TEST_CASE("the colon holds as much air as its cross-sections say") {
  const Volume volume = make_phantom("colon", {256, 128, 256});
  CHECK(volume.type == ScalarType::i16);
  CHECK(volume.min == -1000);
  CHECK(volume.max == 90);
  // Half of a voxel on the wall's inner side is air: half-way from 40 to −1000.
  double air = 0;
  for (std::size_t i = 0; i < voxel_count(volume); ++i)
    air += scalar_at(volume, i) < -480 ? 1 : 0;
  air *= volume.spacing.x * volume.spacing.y * volume.spacing.z;
  // ∫ ½ ∮ r² dφ ds (Pappus: the sections' centres lie close to the path), inside the box.
  const std::vector<colon::PathNode> path = colon::path();
  double expected = 2.0 / 3 * pi * std::pow(path[0].radius, 3); // the caecum's round end
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    if (path[i].position.z < -160)
      break;
    constexpr int steps = 90;
    double area = 0;
    for (int k = 0; k < steps; ++k) {
      const double r = colon::inner_radius(path[i].length, 2 * pi * k / steps, path[i].radius);
      area += pi * r * r / steps;
    }
    expected += area * (path[i + 1].length - path[i].length);
  }
  // Small bowel (100 mm) and appendix (75 mm) add 1 %, polyps take 0.6 %; bends sharper than the sections'
  // radius count the inner side twice.
  CHECK(air == Approx(expected).epsilon(0.04));
}

TEST_CASE("each polyp is where the table says") {
  const Volume volume = make_phantom("colon", {256, 128, 256});
  const std::vector<colon::PathNode> path = colon::path();
  CHECK(colon::polyps().size() == 9);
  for (const colon::Polyp& polyp : colon::polyps()) {
    INFO("at " << polyp.fraction);
    CHECK(at_mm(volume, colon::head_of(polyp, path)) == 90);
  }
  // On the path itself there is air, but where a polyp hangs into it.
  const auto near_polyp = [&](const glm::dvec3& p) {
    for (const colon::Polyp& polyp : colon::polyps()) {
      if (glm::length(p - colon::head_of(polyp, path)) < polyp.radius + 3)
        return true;
    }
    return false;
  };
  std::size_t not_air = 0;
  for (const colon::PathNode& node : path)
    not_air +=
        std::abs(node.position.z) < 158 && !near_polyp(node.position) && at_mm(volume, node.position) != -1000
            ? 1
            : 0;
  CHECK(not_air == 0);
}
