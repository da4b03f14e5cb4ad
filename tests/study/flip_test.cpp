#include "catch.h"
#include "core/errors.h"
#include "metrics_images.h"
#include "study/flip.h"

#include <cmath>

using namespace slicelens;
using glm::dvec3;

namespace {

Image color_image(int width, int height, const dvec3& rgb) {
  Image image = grey_image(width, height, 1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c)
        channel(image, x, y, c) = static_cast<float>(rgb[c]);
    }
  }
  return image;
}

/// The colour error of a HyAB distance, from the paper's constants: q_c = .7, p_c = .4, p_t = .95.
double color_error(double hyab) {
  // Green against blue in L*a*b* under D65: (87.735, −86.183, 83.180) and (32.297, 79.188, −107.860)
  // (published in many tables), a* and b* times L*/100.
  const double dl = 87.735 - 32.297;
  const double da = -86.183 * 0.87735 - 79.188 * 0.32297;
  const double db = 83.180 * 0.87735 + 107.860 * 0.32297;
  const double largest = std::pow(dl + std::hypot(da, db), 0.7);
  const double error = std::pow(hyab, 0.7);
  const double knee = 0.4 * largest;
  return error < knee ? 0.95 * error / knee : 0.95 + 0.05 * (error - knee) / (largest - knee);
}

double flip_of(const Image& a, const Image& b, double ppd = default_pixels_per_degree) {
  return mean_of(flip_errors(a, b, dvec3(0), dvec3(0), ppd));
}

} // namespace

TEST_CASE("pixels per degree of the paper's display") {
  CHECK(default_pixels_per_degree == Approx(67.0206).margin(1e-4));
  CHECK(pixels_per_degree(0.7, 3840, 0.7) == Approx(default_pixels_per_degree));
  CHECK(pixels_per_degree(1.4, 3840, 0.7) == Approx(2 * default_pixels_per_degree));
}

TEST_CASE("FLIP of equal pictures is 0, of green against blue 1") {
  const Image image = textured_image(40, 30, 0.1, 3);
  CHECK(flip_of(image, image) == 0);
  const Image green = color_image(24, 24, dvec3(0, 1, 0));
  const Image blue = color_image(24, 24, dvec3(0, 0, 1));
  CHECK(flip_of(green, blue) == Approx(1).epsilon(1e-9));
  CHECK(flip_of(blue, green) == flip_of(green, blue));
}

TEST_CASE("no colours of the cube are farther apart than green and blue") {
  // 41.2760 = 203.2^.7 is the largest error before it is spread over [0,1], from the L*a*b* of color_error
  const double largest = hunt_hyab(dvec3(0, 1, 0), dvec3(0, 0, 1));
  CHECK(std::pow(largest, 0.7) == Approx(41.276).margin(0.002));
  std::vector<dvec3> cube;
  for (int i = 0; i < 6 * 6 * 6; ++i)
    cube.push_back(dvec3(i % 6, i / 6 % 6, i / 36) / 5.0);
  double found = 0;
  for (const dvec3& a : cube) {
    for (const dvec3& b : cube)
      found = std::max(found, hunt_hyab(a, b));
  }
  CHECK(found == largest);
}

TEST_CASE("FLIP of even pictures is the colour error alone") {
  // Black against white: L* 0 and 100, no chroma.
  const Image black = grey_image(20, 20, 0);
  CHECK(flip_of(black, grey_image(20, 20, 1)) == Approx(color_error(100)).margin(2e-6));
  CHECK(color_error(100) == Approx(0.9674).margin(1e-4));
  // Greys: L* = 116·Y^(1/3) − 16 of Y = ((v + .055)/1.055)^2.4. The tolerance is that of rounded L*a*b*
  // tables.
  const auto lightness = [](double v) { return 116 * std::cbrt(std::pow((v + 0.055) / 1.055, 2.4)) - 16; };
  const double difference = lightness(0.6) - lightness(0.5);
  CHECK(flip_of(grey_image(20, 20, 0.5F), grey_image(20, 20, 0.6F)) ==
        Approx(color_error(difference)).margin(1e-5));
  // Values beyond [0,1] are cut off, and transparent pictures put over their backgrounds.
  CHECK(flip_of(grey_image(8, 8, 1), grey_image(8, 8, 3)) == 0);
  CHECK(mean_of(flip_errors(make_image(8, 8), grey_image(8, 8, 0.5F), dvec3(0.5), dvec3(0))) == 0);
}

TEST_CASE("FLIP beside an edge") {
  // Black against a picture with white from column 32 on. Left of the edge, column 31, the white share of the
  // achromatic filter is half of what its middle column leaves: s = (1 − w₀)/2. The edge detector's positive
  // half, from the next column on, is all white: response 1, so the feature error is √(1/√2), and the point
  // detector's response, half of what its middle leaves, is smaller.
  const double ppd = 67.0206;
  const Image black = grey_image(64, 64, 0);
  Image half = black;
  for (int y = 0; y < 64; ++y) {
    for (int x = 32; x < 64; ++x) {
      for (int c = 0; c < 3; ++c)
        channel(half, x, y, c) = 1;
    }
  }
  double sum = 0;
  for (int i = -10; i <= 10; ++i) // radius ⌈3·√(.04/2π²)·67⌉ = 10
    sum += std::exp(-std::pow(3.14159265358979 * i / ppd, 2) / 0.0047);
  const double share = (1 - 1 / sum) / 2;
  const double color = color_error(116 * std::cbrt(share) - 16);
  const PixelPlane errors = flip_errors(black, half, dvec3(0), dvec3(0), ppd);
  CHECK(errors.at(31, 32) == Approx(std::pow(color, 1 - std::sqrt(1 / std::sqrt(2.0)))).margin(1e-5));
  CHECK(errors.at(0, 32) == 0);                                      // far from the edge both are black
  CHECK(errors.at(63, 32) == Approx(color_error(100)).margin(2e-6)); // and here even
}

TEST_CASE("from farther away the same noise shows less") {
  const Image a = textured_image(48, 48, 0, 1);
  const Image b = textured_image(48, 48, 0.1, 2);
  const double near = flip_of(a, b, 30);
  const double middle = flip_of(a, b);
  const double far = flip_of(a, b, 200);
  CHECK(near > middle);
  CHECK(middle > far);
  CHECK(far > 0);
}

TEST_CASE("FLIP's picture has the map's colours, and what FLIP cannot take is refused") {
  PixelPlane plane = make_plane(2, 1);
  plane.at(1, 0) = 1;
  const Image picture = flip_picture(plane);
  CHECK(picture.width == 2);
  CHECK(channel(picture, 0, 0, 1) == Approx(0).margin(1e-6)); // black
  CHECK(channel(picture, 1, 0, 0) > 0.9F);                    // pale yellow
  CHECK(channel(picture, 1, 0, 3) == 1);
  const Image image = grey_image(4, 4, 0);
  CHECK_THROWS_AS(flip_of(image, grey_image(4, 5, 0)), UsageError);
  CHECK_THROWS_AS(flip_of(image, image, 0), UsageError);
  CHECK_THROWS_AS(flip_of(image, image, std::nan("")), UsageError);
}
