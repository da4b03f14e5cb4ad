// Round numbers, lettering and places of what is drawn over pictures.
#include "catch.h"
#include "image/annotations.h"
#include "image/lettering.h"

#include <cmath>

using namespace slicelens;

namespace {

Image plain(int width, int height, float grey) {
  Image image = make_image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % 4 == 3 ? 1 : grey;
  return image;
}

/// A ramp: red rises, blue falls, opacity rises from 0 to 1 with the value's square.
Legend ramp(double low, double high) {
  return {low, high,
          [=](double v) {
            const double f = (v - low) / (high - low);
            return glm::dvec4(f, 0.5, 1 - f, f * f);
          },
          "opacity"};
}

} // namespace

TEST_CASE("a round length is the largest of 1, 2 and 5 times a power of ten") {
  CHECK(round_length(1) == 1);
  CHECK(round_length(1.99) == 1);
  CHECK(round_length(4.9) == 2);
  CHECK(round_length(5) == 5);
  CHECK(round_length(9.99) == 5);
  CHECK(round_length(10) == 10);
  CHECK(round_length(0.034) == Approx(0.02));
  CHECK(round_length(7.3e-12) == Approx(5e-12));
  CHECK(round_length(2.1e15) == Approx(2e15));
  for (int n = -12; n <= 12; ++n)
    CHECK(round_length(std::pow(10.0, n)) == Approx(std::pow(10.0, n)));
}

TEST_CASE("ticks lie on round values inside the range, as many as fit") {
  const Ticks hu = round_ticks(-1024, 3071, 7);
  CHECK(hu.step == 1000);
  CHECK(hu.values == std::vector<double>{-1000, 0, 1000, 2000, 3000});
  CHECK(round_ticks(0, 1, 7).values.size() == 6); // steps of .2
  CHECK(round_ticks(0, 1, 5).step == 0.5);
  for (double low = -37; low < 40; low += 0.913) {
    for (double width = 1e-3; width < 1e5; width *= 3.7) {
      const Ticks ticks = round_ticks(low, low + width, 6);
      CHECK(ticks.values.size() <= 6);
      CHECK(!ticks.values.empty());
      for (const double value : ticks.values) {
        CHECK(value >= low - 1e-6 * width);
        CHECK(value <= low + width * (1 + 1e-6));
      }
    }
  }
}

TEST_CASE("numbers beside ticks have the digits that tell them apart") {
  CHECK(tick_text(-1000, 500) == "-1000");
  CHECK(tick_text(0, 500) == "0");
  CHECK(tick_text(0.25, 0.05) == "0.25");
  CHECK(tick_text(0.2, 0.2) == "0.2");
  CHECK(tick_text(50, 50) == "50");
  CHECK(tick_text(2e7, 2e7) == "2e+07");
  CHECK(tick_text(2.2e7, 2e6) == "2.2e+07");
  CHECK(tick_text(5e-6, 5e-6) == "5e-06");
}

TEST_CASE("letters have white dots in a black outline, as large as the scale says") {
  for (const int scale : {1, 2, 3}) {
    Image image = plain(60, 60, 0.5F);
    draw_outlined_text(image, 10, 10, "I", scale); // its foot: three dots in the seventh row
    CHECK(channel(image, 10 + scale, 10 + 7 * scale - 1, 0) == 1);
    CHECK(channel(image, 10 + 4 * scale - 1, 10 + 7 * scale - 1, 0) == 1);
    CHECK(channel(image, 10 + 4 * scale, 10 + 7 * scale - 1, 0) == 0); // beside it
    CHECK(channel(image, 10 + scale, 10 + 7 * scale, 0) == 0);         // below it
    CHECK(channel(image, 10 + 6 * scale, 10 + 9 * scale, 0) == 0.5F);
  }
  Image light = plain(60, 60, 0.9F);
  draw_outlined_text(light, 10, 10, "I", 1);
  CHECK(channel(light, 11, 16, 0) == 0);
  CHECK(channel(light, 11, 17, 0) == 1);
  Image image = plain(8, 8, 0.5F);
  draw_outlined_text(image, -3, 4, "WW", 2); // cut off at the edges
  CHECK(channel(image, 7, 0, 0) == 0.5F);
}

TEST_CASE("a legend shows the colours and the opacities of its rows' values") {
  for (const int size : {64, 128, 256, 512, 700}) {
    Image image = plain(size, size, 0.3F);
    const Legend legend = ramp(-200, 600);
    const LegendPlace place = draw_legends(image, {legend}).at(0);
    CHECK(place.colors.height >= size / 3);
    CHECK(place.colors.left >= size - legends_width(image, {legend}));
    CHECK(place.colors.left + place.colors.width < size);
    const int middle = place.colors.left + place.colors.width / 2;
    int wrong = 0;
    for (int row = 0; row < place.colors.height; ++row) {
      const double f = 1 - (row + 0.5) / place.colors.height;
      const int y = place.colors.top + row;
      wrong += std::abs(channel(image, middle, y, 0) - f) > 1e-6 ||
               std::abs(channel(image, middle, y, 2) - (1 - f)) > 1e-6;
      int lit = 0;
      for (int x = 0; x < place.opacities.width; ++x)
        lit += channel(image, place.opacities.left + x, y, 0) > 0.5F ? 1 : 0;
      wrong += std::abs(lit - f * f * place.opacities.width) > 0.5 + 1e-9;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("the ticks of a legend stand at the rows of their values") {
  Image image = plain(256, 256, 0.3F);
  const LegendPlace place = draw_legends(image, {ramp(0, 100)}).at(0);
  const int column = place.colors.left + place.colors.width + 2; // beyond the frame
  int ticks = 0;
  for (int row = 0; row < place.colors.height; ++row)
    ticks += channel(image, column, place.colors.top + row, 0) == 1 ? 1 : 0;
  CHECK(ticks == 6); // 0, 20 … 100
  for (const int value : {20, 40, 60, 80}) {
    const int row = static_cast<int>((1 - value / 100.0) * place.colors.height);
    CHECK(channel(image, column, place.colors.top + row, 0) == 1);
  }
}

TEST_CASE("legends of several volumes lie one below the other") {
  Image image = plain(256, 256, 0.3F);
  const auto places = draw_legends(image, {ramp(0, 1), ramp(0, 1), ramp(0, 1), ramp(0, 1)});
  for (std::size_t i = 0; i < places.size(); ++i) {
    const PixelBox& box = places[i].colors;
    CHECK(box.height >= 16);
    CHECK(box.top + box.height <= image.height);
    if (i > 0)
      CHECK(box.top >= places[i - 1].colors.top + places[i - 1].colors.height + 2 * letter_height);
  }
}

TEST_CASE("a scale bar is as long as it should be, to the pixel") {
  for (const double pixels : {20.0, 33.4, 57.6}) {
    Image image = plain(256, 256, 0.3F);
    const PixelBox bar = draw_scale_bar(image, pixels, {"10 mm"});
    int run = 0;
    for (int x = 0; x < image.width; ++x)
      run += channel(image, x, bar.top, 0) == 1 ? 1 : 0;
    CHECK(run == std::lround(pixels));
    CHECK(bar.width == run);
  }
}
