#include "catch.h"
#include "core/errors.h"
#include "metrics_images.h"
#include "study/metrics.h"

#include <cmath>
#include <functional>
#include <limits>

using namespace slicelens;

namespace {

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// SSIM straight from the definition: for every position of the window two-dimensional weights, means first
/// and then central moments. Slow, and shares nothing with the code under test.
double brute_force_ssim(const Image& a, const Image& b) {
  const auto odd = [](int side) { return std::min(11, side % 2 == 0 ? side - 1 : side); };
  const int rx = odd(a.width) / 2;
  const int ry = odd(a.height) / 2;
  const auto luma = [](const Image& image, int x, int y) {
    return 0.2126 * channel(image, x, y, 0) + 0.7152 * channel(image, x, y, 1) +
           0.0722 * channel(image, x, y, 2);
  };
  double total = 0;
  int windows = 0;
  for (int cy = ry; cy < a.height - ry; ++cy) {
    for (int cx = rx; cx < a.width - rx; ++cx) {
      const auto each = [&](const std::function<double(int, int)>& value) {
        double sum = 0;
        double weights = 0;
        for (int dy = -ry; dy <= ry; ++dy) {
          for (int dx = -rx; dx <= rx; ++dx) {
            const double weight = std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5));
            sum += weight * value(cx + dx, cy + dy);
            weights += weight;
          }
        }
        return sum / weights;
      };
      const double ma = each([&](int x, int y) { return luma(a, x, y); });
      const double mb = each([&](int x, int y) { return luma(b, x, y); });
      const double va = each([&](int x, int y) { return std::pow(luma(a, x, y) - ma, 2); });
      const double vb = each([&](int x, int y) { return std::pow(luma(b, x, y) - mb, 2); });
      const double ab = each([&](int x, int y) { return (luma(a, x, y) - ma) * (luma(b, x, y) - mb); });
      total += (2 * ma * mb + 1e-4) * (2 * ab + 9e-4) / ((ma * ma + mb * mb + 1e-4) * (va + vb + 9e-4));
      ++windows;
    }
  }
  return total / windows;
}

} // namespace

TEST_CASE("a constant offset of 0.1 is exactly 20 dB") {
  const Metrics m = compare_images(grey_image(20, 15, 0.5F), grey_image(20, 15, 0.6F));
  REQUIRE(m.psnr.has_value());
  CHECK(*m.psnr == Approx(20).margin(1e-5)); // .5 and .6 as floats are .1 ± 3e-8 apart: 3e-6 dB
  CHECK(*m.psnr_covered == Approx(20).margin(1e-5));
  CHECK(m.covered_pixels == 300);
  CHECK(m.rmse == Approx(0.1));
  CHECK(m.mean_abs == Approx(0.1));
  CHECK(m.max_abs == Approx(0.1));
  CHECK(m.over_1_255 == 1);
  CHECK(m.width == 20);
  CHECK(m.height == 15);
}

TEST_CASE("equal pictures have no PSNR and SSIM 1") {
  const Image image = textured_image(30, 22, 0, 1);
  const Metrics m = compare_images(image, image);
  CHECK_FALSE(m.psnr.has_value());
  CHECK_FALSE(m.psnr_covered.has_value());
  CHECK(m.ssim == 1);
  CHECK(m.rmse == 0);
  CHECK(m.max_abs == 0);
  CHECK(m.over_1_255 == 0);
}

TEST_CASE("one value of one pixel") {
  const Image a = grey_image(10, 8, 0);
  Image b = a;
  channel(b, 3, 5, 1) = 0.5F;
  const Metrics m = compare_images(a, b);
  // of 240 values one differs by 1/2: mean square 1/960; covered are 3 values: 1/12
  CHECK(*m.psnr == Approx(10 * std::log10(960.0)));
  CHECK(*m.psnr_covered == Approx(10 * std::log10(12.0)));
  CHECK(m.covered_pixels == 1);
  CHECK(m.rmse == Approx(std::sqrt(1.0 / 960)));
  CHECK(m.mean_abs == Approx(1.0 / 480));
  CHECK(m.max_abs == 0.5);
  CHECK(m.over_1_255 == Approx(1.0 / 240));
}

TEST_CASE("exactly one 8-bit step never counts as over 1/255, two steps always do") {
  Image a = grey_image(255, 1, 0);
  Image b = a;
  Image c = a;
  for (int k = 0; k < 255; ++k) {
    for (int i = 0; i < 3; ++i) {
      channel(a, k, 0, i) = static_cast<float>(k) / 255.0F;
      channel(b, k, 0, i) = static_cast<float>(k + 1) / 255.0F;
      channel(c, k, 0, i) = static_cast<float>(std::min(k + 2, 255)) / 255.0F;
    }
  }
  CHECK(compare_images(a, b).over_1_255 == 0);
  CHECK(compare_images(a, c).over_1_255 == Approx(254.0 / 255));
  CHECK(compare_images(grey_image(4, 4, 0.2F), grey_image(4, 4, 0.2F + 1.01F / 255)).over_1_255 == 1);
}

TEST_CASE("coverage follows alpha, or the background in opaque pictures") {
  // transparent pictures: alpha above 0, or light without opacity
  Image a = make_image(4, 1);
  Image b = make_image(4, 1);
  channel(a, 1, 0, 3) = 0.5F;
  channel(b, 2, 0, 0) = 0.25F;
  Metrics m = compare_images(a, b);
  CHECK(m.covered_pixels == 2);
  CHECK(*m.psnr_covered == Approx(-10 * std::log10(0.0625 / 6))); // one value of six differs, by 1/4
  CHECK(*m.psnr == Approx(-10 * std::log10(0.0625 / 12)));
  // opaque pictures over white: what is white within half a step is background
  a = grey_image(4, 1, 1);
  b = grey_image(4, 1, 1);
  channel(a, 0, 0, 2) = 1 - 0.4F / 255;
  channel(a, 1, 0, 2) = 1 - 0.6F / 255;
  m = compare_images(a, b, glm::dvec3(1), glm::dvec3(1));
  CHECK(m.covered_pixels == 1);
  CHECK(compare_images(a, b).covered_pixels == 4); // over black all of it is covered
  // nothing covered: no value, though the backgrounds differ
  m = compare_images(grey_image(3, 3, 0), grey_image(3, 3, 1), glm::dvec3(0), glm::dvec3(1));
  CHECK(m.covered_pixels == 0);
  CHECK_FALSE(m.psnr_covered.has_value());
  CHECK(*m.psnr == Approx(0).margin(1e-12));
}

TEST_CASE("transparent pictures are put over their backgrounds") {
  Image a = make_image(2, 2); // half transparent .2 over white is .2 + .5 = .7
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    a.pixels[i] = i % 4 == 3 ? 0.5F : 0.2F;
  const Metrics m = compare_images(a, grey_image(2, 2, 0.7F), glm::dvec3(1), glm::dvec3(0));
  CHECK(m.max_abs < 1e-7); // .2 and .7 are rounded to floats
  CHECK(compare_images(a, grey_image(2, 2, 0.7F)).max_abs == Approx(0.5));
}

TEST_CASE("SSIM of two constant pictures is the luminance term") {
  const double a = 0.25;
  const double b = 0.75;
  const double expected = (2 * a * b + 1e-4) / (a * a + b * b + 1e-4);
  CHECK(compare_images(grey_image(16, 16, 0.25F), grey_image(16, 16, 0.75F)).ssim ==
        Approx(expected).epsilon(1e-9));
  CHECK(compare_images(grey_image(1, 1, 0.25F), grey_image(1, 1, 0.75F)).ssim ==
        Approx(expected).epsilon(1e-9));
}

TEST_CASE("SSIM equals the definition computed directly") {
  for (const auto& [width, height] :
       {std::pair{40, 31}, {11, 11}, {12, 11}, {9, 30}, {25, 4}, {2, 2}, {1, 20}}) {
    const Image a = textured_image(width, height, 0, 1);
    const Image b = textured_image(width, height, 0.2, 2);
    INFO(width << "×" << height);
    const double ssim = compare_images(a, b).ssim;
    CHECK(ssim == Approx(brute_force_ssim(a, b)).margin(1e-10)); // doubles: only the order of sums differs
    CHECK(ssim < 0.999); // the pictures differ enough for the comparison to mean something
  }
}

TEST_CASE("values above 1 are compared as they are") {
  const Metrics m = compare_images(grey_image(12, 12, 3), grey_image(12, 12, 5));
  CHECK(m.max_abs == 2);
  CHECK(*m.psnr == Approx(-10 * std::log10(4.0)));
}

TEST_CASE("pictures that cannot be compared are refused") {
  const std::string sizes = message_of([] { compare_images(make_image(4, 3), make_image(3, 4)); });
  CHECK(sizes.find("4×3") != std::string::npos);
  CHECK(sizes.find("3×4") != std::string::npos);
  Image bad = grey_image(8, 8, 0);
  channel(bad, 5, 6, 2) = std::numeric_limits<float>::quiet_NaN();
  const std::string nan = message_of([&] { compare_images(grey_image(8, 8, 0), bad); });
  CHECK(nan.find("second") != std::string::npos);
  CHECK(nan.find("(5, 6)") != std::string::npos);
  CHECK(nan.find("channel B") != std::string::npos);
  channel(bad, 5, 6, 2) = std::numeric_limits<float>::infinity();
  CHECK_THROWS_AS(compare_images(bad, grey_image(8, 8, 0)), UsageError);
  CHECK_THROWS_AS(compare_images(Image{}, Image{}), UsageError);
}

TEST_CASE("the pairs have the contract's names in order") {
  Metrics m = compare_images(grey_image(20, 15, 0), grey_image(20, 15, 0));
  m.rmse = 7;
  std::string names;
  for (const auto& [name, value] : as_pairs(m)) {
    names += name + " ";
    CHECK(value.has_value() == (name != "psnr" && name != "psnr_covered" && name != "ms_ssim"));
    if (name == "rmse")
      CHECK(*value == 7);
    if (name == "height")
      CHECK(*value == 15);
  }
  CHECK(names == "psnr psnr_covered ssim ms_ssim flip rmse mean_abs max_abs over_1_255 width height ");
}

TEST_CASE("multi-scale SSIM of even pictures is the last scale's luminance term") {
  // Without structure contrast and structure are 1 at every scale; the fifth has luminance to the power
  // .1333.
  const double luminance = (2 * 0.25 * 0.75 + 1e-4) / (0.0625 + 0.5625 + 1e-4);
  const Metrics m = compare_images(grey_image(176, 180, 0.25F), grey_image(176, 180, 0.75F));
  REQUIRE(m.ms_ssim);
  CHECK(*m.ms_ssim == Approx(std::pow(luminance, 0.1333)).epsilon(1e-9));
  const Image image = textured_image(176, 176, 0, 1);
  CHECK(*compare_images(image, image).ms_ssim == 1);
  // A side too short for five scales has none.
  CHECK_FALSE(compare_images(grey_image(175, 300, 0.25F), grey_image(175, 300, 0.75F)).ms_ssim);
}

TEST_CASE("multi-scale SSIM looks at coarser scales than SSIM") {
  // A fine checkerboard of ±1/8 about 1/2 against its negative: at scale 1 they are opposed (contrast times
  // structure (C₂ − 2v)/(C₂ + 2v), negative, counts as 0), so the product is 0. Against even grey it is
  // C₂/(C₂ + v) with v the variance under the window, 1/64 but for the window's own imbalance of 1e-6; from
  // the second scale on both pictures are even grey, and so 1.
  Image board = grey_image(176, 176, 0.5F);
  Image negative = board;
  for (int y = 0; y < 176; ++y) {
    for (int x = 0; x < 176; ++x) {
      for (int c = 0; c < 3; ++c) {
        channel(board, x, y, c) = (x + y) % 2 == 0 ? 0.625F : 0.375F;
        channel(negative, x, y, c) = (x + y) % 2 == 0 ? 0.375F : 0.625F;
      }
    }
  }
  CHECK(*compare_images(board, negative).ms_ssim == 0);
  CHECK(compare_images(board, negative).ssim < 0);
  const double contrast = 9e-4 / (9e-4 + 1.0 / 64);
  CHECK(*compare_images(board, grey_image(176, 176, 0.5F)).ms_ssim ==
        Approx(std::pow(contrast, 0.0448)).epsilon(1e-5));
}

TEST_CASE("the fraction over k steps, for any k") {
  Image a = grey_image(256, 1, 0);
  Image b = a;
  for (int k = 0; k < 256; ++k) // pixel k differs by k steps in red
    channel(b, k, 0, 0) = static_cast<float>(k) / 255;
  CHECK(fraction_over(a, b, 0) == Approx(255.0 / 768));
  CHECK(fraction_over(a, b, 1) == Approx(254.0 / 768));
  CHECK(fraction_over(a, b, 8) == Approx(247.0 / 768));
  CHECK(fraction_over(a, b, 254) == Approx(1.0 / 768));
  CHECK(fraction_over(a, b, 255) == 0);
  CHECK(fraction_over(a, b, 1) == compare_images(a, b).over_1_255);
  CHECK_THROWS_AS(fraction_over(a, grey_image(3, 3, 0), 1), UsageError);
}

TEST_CASE("metrics are measured by name, in the order asked for") {
  const Image a = textured_image(180, 176, 0, 1);
  const Image b = textured_image(180, 176, 0.1, 2);
  std::vector<std::string> names = metric_names();
  names.push_back("over_8_255");
  names.insert(names.begin(), "ssim");
  const auto measured = measure(names, a, b);
  REQUIRE(measured.size() == names.size());
  const auto all = as_pairs(compare_images(a, b));
  for (std::size_t i = 0; i < names.size(); ++i) {
    CAPTURE(names[i]);
    CHECK(measured[i].first == names[i]);
    for (const auto& [name, value] : all) {
      if (name == names[i])
        CHECK(measured[i].second == value);
    }
  }
  CHECK(*measured.back().second == fraction_over(a, b, 8));
  CHECK(measure({}, a, b).empty());
  CHECK_FALSE(measure({"psnr"}, a, a)[0].second);
  const std::string unknown = message_of([] { validate_metric("psrn"); });
  CHECK(unknown.find("'psrn'") != std::string::npos);
  CHECK(unknown.find("psnr?") != std::string::npos);
  for (const char* name : {"over_0_255", "over_255_255", "over_01_255", "over_x_255", "", "width"})
    CHECK_THROWS_AS(validate_metric(name), UsageError);
  CHECK_THROWS_AS(measure({"ssim", "nothing"}, a, b), UsageError);
}
