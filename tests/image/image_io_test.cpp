#include "catch.h"
#include "core/errors.h"
#include "core/files.h"
#include "image/image_io.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

/// A folder of its own for one test case, removed at its end.
struct Scratch {
  fs::path folder;
  explicit Scratch(const std::string& name)
      : folder(fs::temp_directory_path() / ("slicelens_image_" + name + "_" + std::to_string(::getpid()))) {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Scratch() {
    std::error_code error;
    fs::remove_all(folder, error);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  fs::path operator/(const std::string& name) const { return folder / name; }
};

/// Associated colour of random size and alpha.
Image random_image(int width, int height, unsigned seed) {
  Image image = make_image(width, height);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  for (std::size_t i = 0; i < image.pixels.size(); i += 4) {
    const float alpha = uniform(random);
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i + c] = alpha * uniform(random);
    image.pixels[i + 3] = alpha;
  }
  return image;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

constexpr PixelDepth all_depths[] = {PixelDepth::png8, PixelDepth::png16, PixelDepth::exr_half,
                                     PixelDepth::exr_float};

std::string name_for(PixelDepth depth) {
  return depth == PixelDepth::png8 || depth == PixelDepth::png16 ? "a.png" : "a.exr";
}

} // namespace

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
  CHECK(pixel_depth("a.exr") == PixelDepth::exr_half);
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

TEST_CASE("what is no image is refused in one line") {
  const Scratch scratch("refused");
  const auto refused = [](const fs::path& path) {
    const std::string message = message_of([&] { read_image(path); });
    INFO(message);
    CHECK(contains(message, path.filename().string()));
    CHECK_FALSE(contains(message, "\n"));
    CHECK_THROWS_AS(read_image(path), FileError);
    CHECK_THROWS_AS(read_metadata(path), FileError);
  };
  refused(scratch / "missing.png");
  refused(scratch.folder);
  REQUIRE(::mkfifo((scratch / "fifo.png").c_str(), 0600) == 0);
  refused(scratch / "fifo.png");
  for (const std::string name : {"empty.png", "empty.exr", "empty.jpg", "empty.tif", "empty.null", "empty"}) {
    write_bytes(scratch / name, "");
    refused(scratch / name);
    write_bytes(scratch / ("text" + name), "not an image\nat all\n");
    refused(scratch / ("text" + name));
  }
}

TEST_CASE("a file cut short anywhere is refused, never read in part") {
  const Scratch scratch("cut");
  Image image = random_image(32, 32, 9);
  image.metadata["slicelens:scene"] = "{}";
  for (const PixelDepth depth : {PixelDepth::png8, PixelDepth::exr_half}) {
    const fs::path file = scratch / name_for(depth);
    write_image(image, file, depth);
    const std::string bytes = read_text(file);
    for (std::size_t length = 0; length < bytes.size(); length += 37) {
      write_bytes(file, bytes.substr(0, length));
      const std::string message = message_of([&] { read_image(file); });
      INFO(length << " of " << bytes.size() << " bytes: " << message);
      CHECK(contains(message, file.filename().string() + ": "));
      CHECK_FALSE(contains(message, "\n"));
    }
  }
}

TEST_CASE("a header that claims an absurd size is refused") {
  const Scratch scratch("absurd");
  // A PNG of 1×1 whose IHDR says otherwise; the CRCs are of these chunks.
  const std::string signature("\x89PNG\r\n\x1a\n", 8);
  const auto chunk = [](const std::string& type, const std::string& data) {
    std::uint32_t crc = 0xFFFFFFFFU; // ISO 15948 §5.5
    for (const char c : type + data) {
      crc ^= static_cast<unsigned char>(c);
      for (int bit = 0; bit < 8; ++bit)
        crc = crc & 1U ? 0xEDB88320U ^ (crc >> 1U) : crc >> 1U;
    }
    crc = ~crc;
    const auto number = [](std::size_t n) {
      return std::string{static_cast<char>(n >> 24U), static_cast<char>(n >> 16U), static_cast<char>(n >> 8U),
                         static_cast<char>(n)};
    };
    return number(data.size()) + type + data + number(crc);
  };
  const auto png = [&](std::uint32_t width, std::uint32_t height) {
    std::string header;
    for (const std::uint32_t side : {width, height}) {
      for (int shift = 24; shift >= 0; shift -= 8)
        header += static_cast<char>(side >> static_cast<unsigned>(shift));
    }
    header += std::string("\x08\x06\0\0\0", 5); // 8-bit RGBA
    // zlib stream of the five bytes 0 (filter) and one transparent pixel, stored without compression
    const std::string data("\x78\x01\x01\x05\x00\xfa\xff\0\0\0\0\0\x00\x05\x00\x01", 16);
    return signature + chunk("IHDR", header) + chunk("IDAT", data) + chunk("IEND", "");
  };
  write_bytes(scratch / "one.png", png(1, 1));
  CHECK(read_image(scratch / "one.png").width == 1); // the frame around is right
  for (const auto& [width, height] :
       {std::pair{70000U, 1U}, {1U, 900000U}, {65536U, 65536U}, {8193U, 8192U}}) {
    write_bytes(scratch / "big.png", png(width, height));
    const std::string message = message_of([&] { read_image(scratch / "big.png"); });
    INFO(message);
    // 8193·8192 pixels are just above 1 GiB of RGBA floats
    CHECK(contains(message, "65536 on a side"));
  }
  write_bytes(scratch / "big.png", png(8000, 8000));
  CHECK(contains(message_of([&] { read_image(scratch / "big.png"); }), "too short"));
}

TEST_CASE("every damaged byte of a PNG is noticed") {
  const Scratch scratch("damaged");
  const fs::path file = scratch / "a.png";
  write_image(random_image(6, 5, 10), file, PixelDepth::png8);
  const std::string bytes = read_text(file);
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    write_bytes(file, damaged);
    INFO(at);
    CHECK_THROWS_AS(read_image(file), FileError);
  }
}
