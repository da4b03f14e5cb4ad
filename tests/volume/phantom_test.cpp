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

/// Value of a head at millimetres from the box centre.
double at_mm(const Volume& head, const glm::dvec3& p) { return sample(head, p / 256.0 + 0.5); }

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
  for (const char* name : {"box", "ball", "blob", "ramp", "slabs", "checkerboard", "brick", "marschner-lobb",
                           "engine", "head", "head-mr", "head-arteries"})
    CHECK(names.count(name) == 1);
}

TEST_CASE("a phantom fills the same box at any size") {
  for (const PhantomInfo& info : phantoms()) {
    INFO(info.name);
    const Volume flat = make_phantom(info.name, {64, 48, 40});
    const Volume cubic = make_phantom(info.name, {64, 64, 64});
    const glm::dvec3 difference = extent(box_of(flat)) - extent(box_of(cubic));
    CHECK(glm::length(difference) < 1e-9);
    CHECK(make_phantom(info.name, {1, 1, 1}).voxels.size() > 0);
    CHECK(make_phantom(info.name, {7, 1, 3}).non_finite == 0);
    // The mean over the box is the same integral at any size, up to what 40 slices resolve.
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

TEST_CASE("a phantom that is not made yet has its place, type and rows") {
  const std::array<std::size_t, 3> size{7, 5, 6};
  for (const PhantomInfo& info : phantoms()) {
    INFO(info.name);
    const Volume whole = make_phantom(info.name, size);
    const PhantomSource source = phantom_source(info.name, size);
    CHECK(source.volume.voxels.empty());
    CHECK(source.volume.type == whole.type);
    CHECK(source.volume.spacing == whole.spacing);
    CHECK(source.volume.origin == whole.origin);
    const std::size_t row = whole.voxels.size() / (size[1] * size[2]);
    std::vector<std::byte> some(3 * row); // across the border of two planes
    source.rows(4, some);
    CHECK(std::equal(some.begin(), some.end(), whole.voxels.begin() + static_cast<std::ptrdiff_t>(4 * row)));
  }
}

TEST_CASE("the limit of memory does not hold for a phantom that is not made") {
  const std::array<std::size_t, 3> large{2048, 2048, 2048}; // 16 GiB of 16 bits
  CHECK_THROWS_AS(make_phantom("head", large), LimitError);
  CHECK(phantom_source("head", large).volume.dims == large);
  CHECK_THROWS_AS(phantom_source("head", {kMaxPhantomEdge + 1, 1, 1}), LimitError);
  CHECK_THROWS_AS(phantom_source("head", {1, 0, 1}), UsageError);
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

TEST_CASE("a phantom is the same on every call") {
  for (const PhantomInfo& info : phantoms()) {
    INFO(info.name);
    CHECK(make_phantom(info.name, {24, 24, 24}).voxels == make_phantom(info.name, {24, 24, 24}).voxels);
  }
}

TEST_CASE("a solid phantom's tissues do not depend on the size") {
  // Where the fine grid is one material for three voxels around, which is more than the partial volume of the
  // coarse one (1.2 of its voxels), the coarse one must hold the same. Brain tissues, which differ by up to
  // 31 HU, are folded too finely for that and bound the tolerance.
  const Volume fine = make_phantom("head", {128, 128, 128});
  const Volume coarse = make_phantom("head", {64, 64, 64});
  CHECK(fine.spacing.x == Approx(2)); // millimetres: the head does not grow with the size
  CHECK(coarse.spacing.z == Approx(4));
  std::size_t compared = 0;
  std::size_t wrong = 0;
  for (std::size_t k = 2; k < 62; k += 2) {
    for (std::size_t j = 2; j < 62; j += 2) {
      for (std::size_t i = 2; i < 62; ++i) {
        double low = 1e9;
        double high = -1e9;
        for (std::size_t n = 0; n < 512; ++n) {
          const double v = value_at(fine, 2 * i - 3 + n % 8, 2 * j - 3 + n / 8 % 8, 2 * k - 3 + n / 64);
          low = std::min(low, v);
          high = std::max(high, v);
        }
        if (high - low > 31)
          continue;
        ++compared;
        const double v = value_at(coarse, i, j, k);
        wrong += v < low - 31 || v > high + 31 ? 1 : 0;
      }
    }
  }
  CHECK(compared > 15000);
  CHECK(wrong == 0);
}

TEST_CASE("the head's anatomy is where a reader of CT expects it") {
  const Volume head = make_phantom("head", {128, 128, 128});
  CHECK(head.type == ScalarType::i16);
  CHECK(head.min == -1000);
  CHECK(head.max > 2000); // teeth
  CHECK(at_mm(head, {-120, -120, 120}) == -1000);
  CHECK(at_mm(head, {0, 20, 110}) > 500); // the vault: above spongy bone, within 2 mm of the outer table
  CHECK(std::abs(at_mm(head, {25, 10, 50}) - 33) < 12); // brain, grey or white
  CHECK(std::abs(at_mm(head, {10, 5, 41}) - 8) < 10);   // lateral ventricle
  for (const double side : {1.0, -1.0}) {
    CHECK(std::abs(at_mm(head, {33 * side, -71.5, 4}) - 12) < 10); // eyeball
    CHECK(at_mm(head, {26 * side, -57, -22}) < -900);              // maxillary sinus
    CHECK(at_mm(head, {24 * side, -55, 0}) < 200);                 // orbit, no bone in it
    CHECK(at_mm(head, {54 * side, -1, -22}) > 250);                // jaw joint
  }
  CHECK(at_mm(head, {0, -12, -60}) < -800); // throat
  // Looking along +y from the front, the nose comes first, the eyes later; at the back of the head nothing
  // stands out as the nose does. That also fixes which way the face looks.
  const auto first_from_front = [&](double x, double z) {
    double y = -127;
    while (y < 127 && at_mm(head, {x, y, z}) < -500)
      y += 0.5;
    return y;
  };
  CHECK(first_from_front(0, -18) < -112);
  CHECK(first_from_front(33, 4) > -95);
  CHECK(first_from_front(0, -45) > -104);
  // Ears stand off the sides.
  CHECK(at_mm(head, {83, 24, 5}) > -900);
}

TEST_CASE("the aneurysm is on the patient's left, close above the skull base") {
  const Volume head = make_phantom("head", {128, 128, 128});
  const glm::dvec3 center(21, -19, 16);
  CHECK(at_mm(head, center) == Approx(330));
  CHECK(at_mm(head, center + glm::dvec3(0, 5, 0)) == Approx(330).margin(20)); // taps reach the wall
  CHECK(at_mm(head, {-21, -19, 16}) < 100);                                   // no twin on the right
  double nearest_bone = 1e9;
  for (std::size_t k = 0; k < 128; ++k) {
    for (std::size_t j = 0; j < 128; ++j) {
      for (std::size_t i = 0; i < 128; ++i) {
        const glm::dvec3 p = head.origin + head.spacing * glm::dvec3(i, j, k);
        if (p.z < 60 && value_at(head, i, j, k) > 700)
          nearest_bone = std::min(nearest_bone, glm::length(p - center));
      }
    }
  }
  CHECK(nearest_bone > 8); // the aneurysm's radius
  CHECK(nearest_bone < 18);
  // Carotids on both sides of the neck, the basilar artery in the middle.
  CHECK(at_mm(head, {25, 8, -100}) > 200);
  CHECK(at_mm(head, {-25, 8, -100}) > 200);
  CHECK(at_mm(head, {0, 9, -12}) > 120);
}

TEST_CASE("the two heads are exactly aligned") {
  const Volume ct = make_phantom("head", {128, 120, 100});
  const Volume mr = make_phantom("head-mr", {128, 120, 100});
  CHECK(mr.dims == ct.dims);
  CHECK(mr.spacing == ct.spacing);
  CHECK(mr.origin == ct.origin);
  // Pure voxels of a tissue whose value no mixture takes are the same voxels in both.
  std::size_t air = 0;
  std::size_t blood = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < voxel_count(ct); ++i) {
    const double c = scalar_at(ct, i);
    const double m = scalar_at(mr, i);
    wrong += (c == -1000) != (m == 4) && std::abs(m - 4) > 3 ? 1 : 0; // rounding: 1 HU is 1e-3 of the step
    air += c == -1000 ? 1 : 0;
    if (m == 960) {
      ++blood;
      wrong += c != 330 ? 1 : 0;
    }
  }
  CHECK(air > 100000);
  CHECK(blood > 20);
  CHECK(wrong == 0);
}

TEST_CASE("the arteries alone are the blood of the head") {
  const std::array<std::size_t, 3> size{128, 120, 100};
  const Volume mr = make_phantom("head-mr", size);
  const Volume arteries = make_phantom("head-arteries", size);
  CHECK(arteries.spacing == mr.spacing);
  CHECK(arteries.origin == mr.origin);
  std::size_t blood = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < voxel_count(mr); ++i) {
    // Blood is the brightest thing in the MR head and put over all else: 960 nowhere but where it is whole.
    // 8-bit rounding makes 199.5 a whole one, which is 1/400 of the way from 960 to any other tissue.
    const double artery = scalar_at(arteries, i);
    wrong += artery == 200 && scalar_at(mr, i) < 957 ? 1 : 0;
    wrong += scalar_at(mr, i) == 960 && artery < 199 ? 1 : 0;
    blood += artery == 200 ? 1 : 0;
  }
  CHECK(blood > 20);
  CHECK(wrong == 0);
  CHECK(arteries.min == 0);
  CHECK(arteries.max == 200);
}

TEST_CASE("the engine has bores, sleeves and a front inlet") {
  const Volume engine = make_phantom("engine", {128, 128, 64});
  CHECK(engine.type == ScalarType::u8);
  CHECK(engine.spacing == glm::dvec3(1));
  CHECK(extent(box_of(make_phantom("engine", {20, 20, 20}))).z == Approx(10)); // half as high as long
  const auto at = [&](double x, double y, double z) {
    return sample(engine, glm::dvec3(x / 256, y / 256, z / 128) + 0.5);
  };
  CHECK(at(-127, -127, 60) == 8);
  CHECK(at(0, 0, 0) == Approx(120));
  CHECK(at(42, 20, 40) < 15); // cylinder bore
  CHECK(at(-42, 20, 40) < 15);
  CHECK(at(42, 28, 0) > 160);                    // liner, thinner than two voxels here
  CHECK(at(42, 0, 10) == Approx(225).margin(5)); // valve stem
  CHECK(at(0, -85, -8) < 15);                    // inlet, on the side that the default camera sees
  CHECK(at(0, 85, -8) < 15);
  CHECK(at(21, -85, -8) > 60); // the inlet's boss, which the back does not have
  CHECK(at(21, 85, -8) < 15);
}

TEST_CASE("the solid ball is the ball's inside and outside") {
  const Volume ball = make_phantom("ball", {24, 24, 24});
  const Volume solid = make_phantom("solid-ball", {24, 24, 24});
  CHECK(solid.type == ScalarType::u8);
  std::size_t inside = 0;
  for (std::size_t k = 0; k < 24; ++k) {
    for (std::size_t j = 0; j < 24; ++j) {
      for (std::size_t i = 0; i < 24; ++i) {
        CHECK(value_at(solid, i, j, k) == (value_at(ball, i, j, k) > 0 ? 255 : 0));
        inside += value_at(solid, i, j, k) > 0 ? 1 : 0;
      }
    }
  }
  CHECK(static_cast<double>(inside) == Approx(4.0 / 3 * 3.14159 * std::pow(0.4 * 24, 3)).epsilon(0.02));
}
