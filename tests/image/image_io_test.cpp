#include "catch.h"
#include "core/files.h"
#include "image_files.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

using namespace slicelens;

TEST_CASE("every 8-bit step of an opaque PNG survives unchanged") {
  const Scratch scratch("steps");
  Image image = make_image(256, 3);
  for (int x = 0; x < 256; ++x) {
    for (int y = 0; y < 3; ++y) {
      channel(image, x, y, y) = static_cast<float>(x) / 255.0F;
      channel(image, x, y, 3) = 1;
    }
  }
  write_image(image, scratch / "a.png", PixelDepth::png8);
  const Image back = read_image(scratch / "a.png");
  REQUIRE(back.width == 256);
  REQUIRE(back.height == 3);
  CHECK((back.pixels == image.pixels)); // bit for bit: k/255 as float in, k stored, k/255 as float out
}

TEST_CASE("PNG stores unassociated colour, rounded once") {
  const Scratch scratch("unassociated");
  Image image = make_image(4, 1);
  // Associated .1 at alpha .2 is colour .5; stored 128 (127.5 up) at alpha 51. Read back: 128/255·51/255.
  const float values[4][4] = {
      {0.1F, 0.05F, 0, 0.2F},
      {0.7F, 0.7F, 0.7F, 0},                                       // nothing to divide by
      {std::numeric_limits<float>::quiet_NaN(), 2, -1, 1},         // NaN → 0, clamped
      {0.5F, 0.5F, 0.5F, std::numeric_limits<float>::infinity()}}; // alpha clamped first
  std::copy(&values[0][0], &values[0][0] + 16, image.pixels.begin());
  write_image(image, scratch / "a.png", PixelDepth::png8);
  const Image back = read_image(scratch / "a.png");
  const double half_step = 0.5 / 255;
  CHECK(channel(back, 0, 0, 3) == Approx(51.0 / 255));
  CHECK(std::abs(channel(back, 0, 0, 0) - 0.1) <= 0.2 * half_step + 1e-7);
  CHECK(std::abs(channel(back, 0, 0, 1) - 0.05) <= 0.2 * half_step + 1e-7);
  CHECK(channel(back, 0, 0, 2) == 0);
  for (int c = 0; c < 4; ++c)
    CHECK(channel(back, 1, 0, c) == 0);
  CHECK(channel(back, 2, 0, 0) == 0);
  CHECK(channel(back, 2, 0, 1) == 1);
  CHECK(channel(back, 2, 0, 2) == 0);
  CHECK(channel(back, 3, 0, 3) == 1);
  CHECK(channel(back, 3, 0, 0) == Approx(128.0 / 255)); // 127.5 rounds away from zero
}

TEST_CASE("writing what was read from a PNG gives the same picture again") {
  const Scratch scratch("again");
  for (const PixelDepth depth : {PixelDepth::png8, PixelDepth::png16}) {
    write_image(random_image(61, 47, 3), scratch / "a.png", depth);
    const Image once = read_image(scratch / "a.png");
    write_image(once, scratch / "b.png", depth);
    CHECK((read_text(scratch / "a.png") == read_text(scratch / "b.png")));
  }
}

TEST_CASE("a 16-bit PNG is within half of its step") {
  const Scratch scratch("png16");
  const Image image = random_image(50, 40, 4);
  write_image(image, scratch / "a.png", PixelDepth::png16);
  const Image back = read_image(scratch / "a.png");
  double worst = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    worst = std::max(worst, static_cast<double>(std::abs(image.pixels[i] - back.pixels[i])));
  // colour·alpha with both rounded to half a step: at most half a step each, plus float rounding
  CHECK(worst <= 1.0 / 65535 + 1e-7);
  CHECK(worst > 0.1 / 65535); // really rounded to 16 bits, not stored as something finer
}

TEST_CASE("EXR keeps the values") {
  const Scratch scratch("exr");
  Image image = random_image(33, 21, 5);
  channel(image, 0, 0, 0) = 12345.678F;
  channel(image, 1, 0, 0) = -3.5F;
  channel(image, 2, 0, 0) = 0.25F; // colour without alpha: emission
  channel(image, 2, 0, 3) = 0;
  channel(image, 3, 0, 0) = std::numeric_limits<float>::infinity();
  write_image(image, scratch / "a.exr", PixelDepth::exr_float);
  CHECK((read_image(scratch / "a.exr").pixels == image.pixels));
  write_image(image, scratch / "b.exr", PixelDepth::exr_half);
  const Image half = read_image(scratch / "b.exr");
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    // binary16 has 11 significant bits: relative error at most 2⁻¹¹, absolute 2⁻²⁵ where subnormal
    const double value = image.pixels[i];
    if (std::isfinite(value))
      REQUIRE(std::abs(half.pixels[i] - value) <= std::max(std::abs(value) / 2048, std::ldexp(1.0, -25)));
    else
      REQUIRE(half.pixels[i] == image.pixels[i]);
  }
  channel(image, 4, 7, 1) = 70000;
  const std::string message =
      message_of([&] { write_image(image, scratch / "c.exr", PixelDepth::exr_half); });
  CHECK(contains(message, "(4, 7)"));
  CHECK(contains(message, "65504"));
  CHECK_FALSE(fs::exists(scratch / "c.exr"));
}

TEST_CASE("metadata come back exactly") {
  const Scratch scratch("metadata");
  Image image = random_image(8, 8, 6);
  std::string scene = "{ \"title\": \"50 % \\\"K\xc3\xb6pfe\\\"\",\r\n\t\"x\": [1, 2] }\n";
  while (scene.size() < 100000)
    scene += scene;
  image.metadata = {{"slicelens:scene", scene},
                    {"slicelens:version", "0.1.0"},
                    {"slicelens:driver", " leading and trailing blanks \n"},
                    {"slicelens:number", "1"}};
  for (const PixelDepth depth : all_depths) {
    const fs::path file = scratch / name_for(depth);
    write_image(image, file, depth);
    CHECK((read_image(file).metadata == image.metadata));
    CHECK((read_metadata(file) == image.metadata));
  }
  Image bad = image;
  bad.metadata = {{"Title", "x"}};
  CHECK_THROWS_AS(write_image(bad, scratch / "b.png", PixelDepth::png8), UsageError);
  bad.metadata = {{"slicelens:x", std::string("a\0b", 3)}};
  CHECK_THROWS_AS(write_image(bad, scratch / "b.png", PixelDepth::png8), UsageError);
  bad.metadata = {{"slicelens:" + std::string(80, 'k'), "x"}};
  CHECK_THROWS_AS(write_image(bad, scratch / "b.png", PixelDepth::png8), UsageError);
  bad.metadata = {{"slicelens:empty", ""}};
  for (const PixelDepth depth : all_depths) {
    write_image(bad, scratch / name_for(depth), depth);
    CHECK(read_metadata(scratch / name_for(depth)).empty());
  }
}

TEST_CASE("the same image gives the same bytes") {
  const Scratch scratch("bytes");
  Image image = random_image(40, 30, 7);
  image.metadata["slicelens:scene"] = "{}";
  std::vector<std::string> first;
  for (const PixelDepth depth : all_depths) {
    write_image(image, scratch / name_for(depth), depth);
    first.push_back(read_text(scratch / name_for(depth)));
  }
  ::usleep(1100000); // time stamps count seconds
  for (std::size_t i = 0; i < std::size(all_depths); ++i) {
    write_image(image, scratch / name_for(all_depths[i]), all_depths[i]);
    CHECK((read_text(scratch / name_for(all_depths[i])) == first[i]));
  }
}

TEST_CASE("extension and depth must fit") {
  const Scratch scratch("depth");
  CHECK(pixel_depth("a.png") == PixelDepth::png8);
  CHECK(pixel_depth("a.PNG", "16") == PixelDepth::png16);
  CHECK(pixel_depth("a.exr") == PixelDepth::exr_float);
  CHECK(pixel_depth("a.exr", "half") == PixelDepth::exr_half);
  CHECK(pixel_depth("a.exr", "float") == PixelDepth::exr_float);
  CHECK_THROWS_AS(pixel_depth("a.exr", "8"), UsageError);
  CHECK_THROWS_AS(pixel_depth("a.png", "half"), UsageError);
  const Image image = random_image(4, 4, 8);
  const std::string message = message_of([&] { write_image(image, scratch / "a.bmp", PixelDepth::png8); });
  CHECK(contains(message, ".png"));
  CHECK(contains(message, ".exr"));
  CHECK_THROWS_AS(write_image(image, scratch / "a.png", PixelDepth::exr_half), UsageError);
  CHECK_THROWS_AS(write_image(image, scratch / "a.exr", PixelDepth::png16), UsageError);
  CHECK_THROWS_AS(write_image(Image{}, scratch / "a.png", PixelDepth::png8), UsageError);
  CHECK(fs::is_empty(scratch.folder));
}

TEST_CASE("grey, palette and opaque files become RGBA") {
  const Scratch scratch("kinds");
  const auto pixel_of = [&](const std::string& bytes) {
    write_bytes(scratch / "a.png", bytes);
    const Image image = read_image(scratch / "a.png");
    const int x = image.width - 1;
    return std::vector<double>{255.0 * channel(image, x, 0, 0), 255.0 * channel(image, x, 0, 1),
                               255.0 * channel(image, x, 0, 2), 255.0 * channel(image, x, 0, 3)};
  };
  const auto near = [](const std::vector<double>& a, const std::vector<double>& b) {
    for (std::size_t c = 0; c < 4; ++c)
      CHECK(a[c] == Approx(b[c]).margin(1e-4)); // float rounding of values up to 255
  };
  using namespace std::string_literals;
  near(pixel_of(png_of(2, 1, 8, 0, "", "\0\x10\x40"s)), {64, 64, 64, 255});
  near(pixel_of(png_of(1, 1, 16, 0, "", "\0\x80\x80"s)), {128, 128, 128, 255}); // 0x8080/65535 = 128/255
  near(pixel_of(png_of(1, 1, 8, 2, "", "\0\x10\x20\x30"s)), {16, 32, 48, 255});
  // grey 64 at alpha 51 = 1/5 is 12.8 associated
  near(pixel_of(png_of(1, 1, 8, 4, "", "\0\x40\x33"s)), {12.8, 12.8, 12.8, 51});
  near(pixel_of(png_of(1, 1, 8, 6, "", "\0\x80\x40\xff\x33"s)), {25.6, 12.8, 51, 51});
  near(pixel_of(png_of(2, 1, 8, 3, chunk("PLTE", "\1\2\3\x0a\x14\x1e"s), "\0\0\1"s)), {10, 20, 30, 255});
  near(pixel_of(png_of(2, 1, 1, 0, "", "\0\x40"s)), {255, 255, 255, 255}); // bits 01
  // another format: a PPM of one pixel
  write_bytes(scratch / "a.ppm", "P6\n1 1\n255\n\x01\x02\xff");
  const Image ppm = read_image(scratch / "a.ppm");
  CHECK(channel(ppm, 0, 0, 1) == Approx(2.0 / 255));
  CHECK(channel(ppm, 0, 0, 2) == 1);
  CHECK(channel(ppm, 0, 0, 3) == 1);
}

TEST_CASE("the codec may be loaded ahead, often and from several threads") {
  const Scratch scratch("preload");
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&, i] {
      preload_codec();
      write_image(random_image(16, 16, 12), scratch / (std::to_string(i) + ".png"), PixelDepth::png8);
    });
  }
  for (std::thread& thread : threads)
    thread.join();
  const std::string first = read_text(scratch / "0.png");
  for (int i = 1; i < 4; ++i)
    CHECK((read_text(scratch / (std::to_string(i) + ".png")) == first));
}

TEST_CASE("an EXR's data window is put in its place in the display window") {
  const Scratch scratch("window");
  // stored: columns 12 and 13 of row 21; shown: columns 10 to 13 of rows 20 to 22
  write_bytes(scratch / "a.exr", exr_of("Y", {12, 21, 13, 21}, {10, 20, 13, 22}, 1.5F));
  const Image image = read_image(scratch / "a.exr");
  REQUIRE(image.width == 4);
  REQUIRE(image.height == 3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x) {
      const bool stored = y == 1 && x >= 2;
      CHECK(channel(image, x, y, 0) == (stored ? 1.5F : 0));
      CHECK(channel(image, x, y, 2) == (stored ? 1.5F : 0)); // grey
      CHECK(channel(image, x, y, 3) == (stored ? 1.0F : 0));
    }
  }
  // the stored window reaches out on all sides: what lies outside is cut off
  write_bytes(scratch / "b.exr", exr_of("R", {-2, -2, 5, 5}, {0, 0, 1, 2}, 0.25F));
  const Image cropped = read_image(scratch / "b.exr");
  REQUIRE(cropped.width == 2);
  REQUIRE(cropped.height == 3);
  CHECK(channel(cropped, 1, 2, 0) == 0.25F);
}
