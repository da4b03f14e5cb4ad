#include "catch.h"
#include "core/errors.h"
#include "image/colormap.h"
#include "image/lettering.h"
#include "image/pictures.h"

#include <cmath>
#include <limits>

using namespace slicelens;

namespace {

Image constant_image(int width, int height, const glm::vec4& value) {
  Image image = make_image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = value[static_cast<int>(i % 4)];
  return image;
}

glm::vec3 rgb_at(const Image& image, int x, int y) {
  return {channel(image, x, y, 0), channel(image, x, y, 1), channel(image, x, y, 2)};
}

/// CIE luminance of a display-space sRGB colour (IEC 61966-2-1).
double luminance(const glm::vec3& rgb) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  return 0.2126 * linear(rgb.r) + 0.7152 * linear(rgb.g) + 0.0722 * linear(rgb.b);
}

} // namespace

TEST_CASE("over a background: C + (1 − A)·B") {
  Image image = constant_image(2, 1, {0.2F, 0.1F, 0, 0.25F});
  image.metadata["slicelens:scene"] = "{}";
  const Image over = over_background(image, {1, 0.5F, 0.2F});
  CHECK(channel(over, 1, 0, 0) == Approx(0.95));
  CHECK(channel(over, 1, 0, 1) == Approx(0.475));
  CHECK(channel(over, 1, 0, 2) == Approx(0.15));
  CHECK(channel(over, 1, 0, 3) == 1);
  CHECK(over.metadata == image.metadata);
}

TEST_CASE("the difference is amplified and opaque") {
  const Image a = constant_image(3, 2, {0.5F, 0.25F, 1, 0});
  const Image b = constant_image(3, 2, {0.25F, 0.5F, 1, 0.5F});
  const Image d = difference_image(a, b, 8);
  CHECK(rgb_at(d, 2, 1) == glm::vec3(2, 2, 0));
  CHECK(channel(d, 2, 1, 3) == 1);
  CHECK_THROWS_AS(difference_image(a, make_image(2, 3), 8), UsageError);
}

TEST_CASE("the colour map gets brighter all the way and ends where it says") {
  CHECK(heat_color(0) == glm::vec3(0));
  CHECK(heat_color(-1) == heat_color(0));
  CHECK(heat_color(7) == heat_color(1));
  CHECK(heat_color(std::numeric_limits<double>::quiet_NaN()) == glm::vec3(1));
  // OKLab's lightness of a grey is the cube root of its luminance; of a colour it is near that, so the map's
  // luminance must be near (.97 t)³ and rise. .06 is room for chromatic colours,
  // whose luminance at one OKLab lightness varies by that much along these hues.
  double last = -1;
  for (int i = 0; i <= 100; ++i) {
    const glm::vec3 color = heat_color(i / 100.0);
    for (int c = 0; c < 3; ++c) {
      CHECK(color[c] >= 0);
      CHECK(color[c] <= 1);
    }
    const double y = luminance(color);
    CHECK(y > last);
    CHECK(std::abs(y - std::pow(0.97 * i / 100, 3)) < 0.06);
    last = y;
  }
  // hues: violet (blue above red above green), red (red far above both), yellow (red and green above blue)
  const glm::vec3 low = heat_color(0.2);
  CHECK((low.b > low.r && low.r > low.g));
  const glm::vec3 middle = heat_color(0.6);
  CHECK((middle.r > 2 * middle.g && middle.r > 2 * middle.b));
  const glm::vec3 high = heat_color(0.97);
  CHECK((high.r > high.b && high.g > high.b));
}

TEST_CASE("the heat map shows the largest channel's error on the stated scale") {
  const Image a = constant_image(80, 3, {0, 0, 0, 1});
  Image b = a;
  channel(b, 4, 1, 1) = 0.05F;
  channel(b, 4, 1, 2) = 0.02F;
  channel(b, 5, 1, 0) = 3;
  channel(b, 6, 1, 0) = std::numeric_limits<float>::quiet_NaN();
  channel(b, 6, 1, 1) = 0.01F; // a number after the NaN must not hide it
  const Image map = heat_map(a, b, 0.1);
  REQUIRE(map.width == 80);
  REQUIRE(map.height == 3 + heat_map_bar_height);
  CHECK(rgb_at(map, 0, 0) == glm::vec3(0));
  CHECK(glm::length(rgb_at(map, 4, 1) - heat_color(0.5)) < 1e-6F); // .05 as a float is not quite half of .1
  CHECK(rgb_at(map, 5, 1) == heat_color(1));
  CHECK(rgb_at(map, 6, 1) == glm::vec3(1));
  // the bar runs from one end to the other
  CHECK(rgb_at(map, 0, 3 + 5) == heat_color(0.5 / 80));
  CHECK(rgb_at(map, 79, 3 + 5) == heat_color(79.5 / 80));
  CHECK_THROWS_AS(heat_map(a, b, 0), UsageError);
  CHECK_THROWS_AS(heat_map(a, make_image(1, 1), 1), UsageError);
  CHECK(heat_map(make_image(1, 1), make_image(1, 1), 1).width == 1); // no room for letters: they are cut off
}

TEST_CASE("resizing averages the covered area") {
  Image image = make_image(3, 2);
  for (int x = 0; x < 3; ++x) {
    channel(image, x, 0, 0) = static_cast<float>(x); // 0 1 2
    channel(image, x, 1, 0) = 6;
  }
  const Image half = resize(image, 2, 1);
  // the left new pixel covers column 0 and half of column 1: (0 + .5)/1.5 = 1/3 in row 0, 6 in row 1
  CHECK(channel(half, 0, 0, 0) == Approx((1.0 / 3 + 6) / 2));
  CHECK(channel(half, 1, 0, 0) == Approx((0.5 + 2) / 1.5 / 2 + 3));
  const Image same = resize(image, 3, 2);
  CHECK((same.pixels == image.pixels));
  const Image large = resize(image, 6, 4);
  CHECK(channel(large, 3, 1, 0) == 1);
  CHECK(channel(large, 4, 0, 0) == 2);
  // the mean is kept for every size
  for (const auto& [w, h] : {std::pair{1, 1}, {2, 2}, {5, 7}, {64, 33}}) {
    const Image other = resize(image, w, h);
    double sum = 0;
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x)
        sum += channel(other, x, y, 0);
    }
    CHECK(sum / (w * h) == Approx(3.5));
  }
  CHECK_THROWS_AS(resize(image, 0, 4), UsageError);
}

TEST_CASE("a contact sheet places its pictures") {
  const std::vector<Image> images{constant_image(4, 4, {1, 0, 0, 1}), constant_image(2, 4, {0, 1, 0, 1}),
                                  constant_image(4, 2, {0, 0, 0.5F, 0.5F})};
  const glm::vec3 white(1);
  const Image sheet = contact_sheet(images, {}, 2, 3, white);
  REQUIRE(sheet.width == 3 + 4 + 3 + 4 + 3);
  REQUIRE(sheet.height == 3 + 4 + 3 + 4 + 3);
  CHECK(rgb_at(sheet, 2, 3) == white);
  CHECK(rgb_at(sheet, 3, 3) == glm::vec3(1, 0, 0));
  CHECK(rgb_at(sheet, 6, 6) == glm::vec3(1, 0, 0));
  CHECK(rgb_at(sheet, 10, 3) == white); // the narrow one is centred in columns 11 and 12
  CHECK(rgb_at(sheet, 11, 3) == glm::vec3(0, 1, 0));
  CHECK(rgb_at(sheet, 13, 3) == white);
  CHECK(rgb_at(sheet, 3, 10) == white); // the flat one in rows 11 and 12, half over white
  CHECK(rgb_at(sheet, 3, 11) == glm::vec3(0.5F, 0.5F, 1));
  const Image lettered = contact_sheet(images, {"a", "a caption too long for its cell", ""}, 3, 1, white);
  CHECK(lettered.height == 1 + 4 + 1 + letter_height + 3);
  CHECK_THROWS_AS(contact_sheet(images, {"a"}, 2, 3, white), UsageError);
  CHECK_THROWS_AS(contact_sheet({}, {}, 2, 3, white), UsageError);
}

TEST_CASE("letters are drawn where they belong and cut at the border") {
  CHECK(text_width("") == 0);
  CHECK(text_width("ab") == 11);
  CHECK(text_width("\xc3\xa4") == 5); // one letter of two bytes
  Image image = make_image(14, 9);
  draw_text(image, 1, 1, "l", {1, 1, 0}); // shows as L: a stroke on the left and one at the foot
  for (int y = 1; y <= 7; ++y)
    CHECK(rgb_at(image, 1, y) == glm::vec3(1, 1, 0));
  for (int x = 1; x <= 5; ++x)
    CHECK(rgb_at(image, x, 7) == glm::vec3(1, 1, 0));
  double sum = 0;
  for (const float value : image.pixels)
    sum += value;
  CHECK(sum == 3 * 11); // 11 pixels of red, green and alpha, and nothing else
  Image border = make_image(3, 3);
  draw_text(border, -4, -4, "#8M", {1, 1, 1});
  draw_text(border, 2, 2, "#8M", {1, 1, 1});
}
