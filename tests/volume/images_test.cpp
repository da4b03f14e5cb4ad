#include "volume_files.h"

#include <cstdio>
// libjpeg's header needs FILE.
#include <jpeglib.h>

#include <cmath>
#include <random>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

std::string chunk(const std::string& name, const std::string& data) {
  const std::string body = name + data;
  const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(data.size())}, true) + body +
         bytes_of(std::vector<std::uint32_t>{static_cast<std::uint32_t>(crc)}, true);
}

/// A PNG by hand (W3C PNG specification); `rows` hold a filter byte and the samples of each row.
std::string png(std::uint32_t width, std::uint32_t height, char depth, char colour, const std::string& rows) {
  const std::string header = bytes_of(std::vector<std::uint32_t>{width, height}, true) +
                             std::string{depth, colour, '\0', '\0', '\0'};
  return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", deflated(rows, false)) +
         chunk("IEND", "");
}

/// A JPEG of one grey, made by libjpeg.
std::string flat_jpeg(unsigned width, unsigned height, unsigned char value) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &bytes, &size);
  jpeg.image_width = width;
  jpeg.image_height = height;
  jpeg.input_components = 1;
  jpeg.in_color_space = JCS_GRAYSCALE;
  jpeg_set_defaults(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  std::vector<unsigned char> row(width, value);
  while (jpeg.next_scanline < height) {
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&jpeg, &pointer, 1);
  }
  jpeg_finish_compress(&jpeg);
  std::string result(reinterpret_cast<char*>(bytes), size);
  jpeg_destroy_compress(&jpeg);
  std::free(bytes);
  return result;
}

} // namespace

TEST_CASE("PNG slices of 8, 16 and 1 bit, with palettes and colours keep their values") {
  const TemporaryFolder folder;
  write_bytes(folder / "8.png", png(2, 2, 8, 0, std::string("\0\1\2\0\3\4", 6)));
  CHECK(scalars_of(read_file(folder / "8.png")) == std::vector<double>{1, 2, 3, 4});
  write_bytes(folder / "16.png", png(2, 1, 16, 0, std::string("\0\x12\x34\xff\xfe", 5)));
  const Volume deep = read_file(folder / "16.png");
  CHECK(deep.type == ScalarType::u16);
  CHECK(scalars_of(deep) == std::vector<double>{0x1234, 0xfffe});
  CHECK(deep.format == "PNG stack");
  write_bytes(folder / "1.png", png(2, 1, 1, 0, std::string("\0\x40", 2)));
  CHECK(scalars_of(read_file(folder / "1.png")) == std::vector<double>{0, 255}); // bits 0 and 1, in 8 bits
  write_bytes(folder / "rgb.png", png(1, 1, 8, 2, std::string("\0\1\2\3", 4)));
  CHECK(read_file(folder / "rgb.png").components == 3);
  CHECK(scalars_of(read_file(folder / "rgb.png")) == std::vector<double>{1, 2, 3});
}

TEST_CASE("PNG slices of different size, type or kind are refused by the odd one's name") {
  const TemporaryFolder folder;
  write_bytes(folder / "a1.png", png(2, 1, 8, 0, std::string("\0\1\2", 3)));
  write_bytes(folder / "a2.png", png(1, 1, 8, 0, std::string("\0\1", 2)));
  CHECK(contains(refusal(folder.path()), "a2.png"));
  write_bytes(folder / "a2.png", flat_jpeg(2, 1, 9));
  CHECK(contains(refusal(folder.path()), "several kinds"));
  CHECK(contains(refusal(folder / "*.png"), "several kinds"));
}

TEST_CASE("a JPEG slice is read; damaged images of every kind are refused or read, never worse") {
  const TemporaryFolder folder;
  const std::string jpeg = flat_jpeg(24, 16, 130);
  write_bytes(folder / "a.jpg", jpeg);
  const Volume v = read_file(folder / "a.jpg");
  CHECK(v.dims == std::array<std::size_t, 3>{24, 16, 1});
  CHECK(v.format == "JPEG stack");
  // A flat block has only a DC term: 8·(130 − 128) = 16, a multiple of the quality-75 quantiser 8.
  CHECK(v.min == 130);
  CHECK(v.max == 130);
  write_bytes(folder / "a.jpg", jpeg.substr(0, jpeg.size() - 6));
  CHECK(contains(refusal(folder / "a.jpg"), "JPEG"));
  const std::string good = png(20, 20, 8, 0, std::string(420, '\0'));
  std::mt19937 random(3);
  for (int variant = 0; variant < 300; ++variant) {
    for (const bool is_png : {true, false}) {
      std::string bytes = is_png ? good : jpeg;
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
      if (variant % 3 == 0)
        bytes.resize(1 + random() % bytes.size());
      const fs::path file = folder / (is_png ? "r.png" : "r.jpg");
      write_bytes(file, bytes);
      REQUIRE_FALSE(contains(refusal(file), "\n"));
    }
  }
}
