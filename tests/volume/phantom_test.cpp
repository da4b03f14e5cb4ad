#include "catch.h"
#include "core/errors.h"
#include "volume/phantom.h"
#include "volume/transfer.h"

#include <cmath>
#include <set>

using namespace slicelens;

namespace {

constexpr std::array<std::size_t, 3> kSmall{32, 32, 32};

/// Trilinear sample at a texture coordinate, clamped to the edge; written here independently of any renderer.
double sample(const Volume& volume, const glm::dvec3& t) {
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<std::size_t, 3> index{};
    for (int a = 0; a < 3; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      const double n = static_cast<double>(volume.dims[axis]);
      const double u = std::clamp(t[a] * n - 0.5, 0.0, n - 1);
      const double base = std::floor(u);
      const bool upper = (corner >> a & 1) != 0;
      weight *= upper ? u - base : 1 - (u - base);
      index[axis] = std::min(static_cast<std::size_t>(base) + (upper ? 1U : 0U), volume.dims[axis] - 1);
    }
    sum += weight * value_at(volume, index[0], index[1], index[2]);
  }
  return sum;
}

double mean_of(const std::string& name, const std::array<std::size_t, 3>& size) {
  return make_phantom(name, size).mean;
}

} // namespace

TEST_CASE("every phantom is finite, placed as documented and suggests a preset") {
  std::set<std::string> names;
  std::set<std::string> preset_names;
  for (const PresetInfo& info : presets())
    preset_names.insert(info.name);
  for (const PhantomInfo& info : phantoms()) {
    INFO(info.name);
    names.insert(info.name);
    CHECK(preset_names.count(info.preset) == 1);
    CHECK_FALSE(info.formula.empty());
    const Volume volume = make_phantom(info.name, kSmall);
    CHECK(volume.dims == kSmall);
    CHECK(volume.voxels.size() == voxel_bytes(volume));
    CHECK(volume.non_finite == 0);
    CHECK(volume.format == "phantom");
    if (info.name != "box")
      CHECK(volume.min < volume.max);
    CHECK(glm::length(center(box_of(volume))) < 1e-9);
  }
  for (const char* name : {"box", "ball", "blob", "ramp", "slabs", "checkerboard", "brick", "marschner-lobb"})
    CHECK(names.count(name) == 1);
}

TEST_CASE("a phantom fills the same box at any size") {
  for (const PhantomInfo& info : phantoms()) {
    INFO(info.name);
    const Volume flat = make_phantom(info.name, {64, 48, 20});
    const Volume cubic = make_phantom(info.name, {64, 64, 64});
    const glm::dvec3 difference = extent(box_of(flat)) - extent(box_of(cubic));
    CHECK(glm::length(difference) < 1e-9);
    CHECK(make_phantom(info.name, {1, 1, 1}).voxels.size() > 0);
    CHECK(make_phantom(info.name, {7, 1, 3}).non_finite == 0);
    // The mean over the box is the same integral at any size, up to what 20 slices resolve.
    const double range = cubic.max - cubic.min;
    CHECK(std::abs(flat.mean - cubic.mean) <= 0.02 * range);
  }
}

TEST_CASE("phantom values are their formulas") {
  const Volume ball = make_phantom("ball", kSmall);
  // Voxel (16,16,20): t − ½ = (½, ½, 4½)/32.
  CHECK(value_at(ball, 16, 16, 16) == Approx(0.1));
  const double distance = std::sqrt(0.25 + 0.25 + 12.5 * 12.5) / 32;
  CHECK(value_at(ball, 16, 16, 28) == Approx(0.4 - distance).epsilon(1e-6));
  CHECK(value_at(ball, 0, 0, 0) == Approx(-0.1));
  const Volume blob = make_phantom("blob", kSmall);
  CHECK(value_at(blob, 16, 16, 20) == Approx(std::exp(-(0.25 + 0.25 + 20.25) / (2 * 16))).epsilon(1e-6));
  const Volume slabs = make_phantom("slabs", {3, 3, 3});
  CHECK(value_at(slabs, 0, 0, 0) == 1);
  CHECK(value_at(slabs, 0, 1, 0) == 1.5);
  CHECK(value_at(slabs, 0, 2, 0) == 2);
  const Volume checkerboard = make_phantom("checkerboard", kSmall); // cells of four voxels
  CHECK(value_at(checkerboard, 0, 0, 0) == 0);
  CHECK(value_at(checkerboard, 4, 0, 0) == 1);
  CHECK(value_at(checkerboard, 4, 7, 0) == 0);
  CHECK(value_at(checkerboard, 4, 7, 31) == 1);
  CHECK(mean_of("checkerboard", {16, 20, 31}) == Approx(0.5));
  const Volume box = make_phantom("box", {3, 2, 1});
  CHECK(box.min == 1);
  CHECK(box.max == 1);
  // Marschner and Lobb at the axis r = 0: ρ_r = cos(12π) = 1, so ρ = (1 − sin(πz/2) + ½)/2.5. Odd sizes have
  // a voxel there; z = −2/3, 0, 2/3.
  const Volume signal = make_phantom("marschner-lobb", {3, 3, 3});
  CHECK(value_at(signal, 1, 1, 1) == Approx(1.5 / 2.5).epsilon(1e-6));
  CHECK(value_at(signal, 1, 1, 2) == Approx((1.5 - std::sin(M_PI / 3)) / 2.5).epsilon(1e-6));
  CHECK(make_phantom("marschner-lobb", {64, 64, 64}).min >= 0);
  CHECK(make_phantom("marschner-lobb", {64, 64, 64}).max <= 1);
}

TEST_CASE("the brick block has a transparent border, bricks and mortar") {
  const Volume brick = make_phantom("brick", {128, 128, 128});
  CHECK(sample(brick, {0.05, 0.5, 0.5}) == 0);
  CHECK(sample(brick, {0.5, 0.2, 0.5}) == 0);
  CHECK(sample(brick, {0.5, 0.5, 0.95}) == 0);
  // Middle of the first brick, and the mortar above it (courses are 0.095 high, from 0.12).
  CHECK(sample(brick, {0.12 + 0.095, 0.26 + 0.06, 0.12 + 0.0475}) >= 0.6);
  CHECK(sample(brick, {0.12 + 0.095, 0.26 + 0.06, 0.12 + 0.095}) < 0.55);
  // Exactly averaged edges: the block's mean does not depend on the resolution.
  const double outside_of_bricks = mean_of("brick", {50, 50, 50});
  CHECK(outside_of_bricks == Approx(brick.mean).epsilon(0.02));
}

TEST_CASE("sizes and names that cannot be are refused before anything is allocated") {
  CHECK_THROWS_AS(make_phantom("box", {0, 4, 4}), UsageError);
  CHECK_THROWS_AS(make_phantom("box", {100000, 1, 1}), LimitError);
  CHECK_THROWS_AS(make_phantom("box", {10000, 10000, 10000}), LimitError);
  CHECK_THROWS_AS(make_phantom("box", {SIZE_MAX, SIZE_MAX, SIZE_MAX}), LimitError);
  std::string message;
  try {
    make_phantom("bal", kSmall);
  } catch (const UsageError& error) {
    message = error.what();
  }
  CHECK(message.find("did you mean 'ball'") != std::string::npos);
}

TEST_CASE("progress runs from 0 to 1") {
  double last = -1;
  bool rising = true;
  Progress progress;
  progress.advance = [&](const std::string&, double done) {
    rising = rising && done >= last;
    last = done;
  };
  make_phantom("blob", kSmall, progress);
  CHECK(rising);
  CHECK(last == 1);
}
