#include "volume/png_slice.h"

#include "core/errors.h"
#include "volume/file_checks.h"

#include <png.h>

#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// The message of libpng's error; its handler must not return and leaves by longjmp.
struct Failure {
  std::array<char, 128> text{};
};

extern "C" void slicelens_png_error(png_structp png, png_const_charp message) {
  auto* const failure = static_cast<Failure*>(png_get_error_ptr(png));
  std::strncpy(failure->text.data(), message, failure->text.size() - 1);
  png_longjmp(png, 1);
}
extern "C" void slicelens_png_warning(png_structp, png_const_charp) {}

/// libpng's state for one file, set up to give 8 or 16 bit samples in the machine's byte order.
class PngFile {
public:
  explicit PngFile(const fs::path& path) : path_(path), file_(std::fopen(path.c_str(), "rb")) {
    if (!file_)
      throw FileError(path.string(), "cannot be opened");
    png_ =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure_, slicelens_png_error, slicelens_png_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw FileError(path.string(), "cannot be read: libpng does not start");
    }
    if (!start()) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      damaged();
    }
  }
  ~PngFile() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  Volume header() const {
    Volume image;
    image.dims = {png_get_image_width(png_, info_), png_get_image_height(png_, info_), 1};
    image.type = png_get_bit_depth(png_, info_) == 16 ? ScalarType::u16 : ScalarType::u8;
    image.components = png_get_channels(png_, info_);
    return image;
  }

  void read(std::byte* out) {
    std::vector<png_bytep> rows(png_get_image_height(png_, info_));
    const std::size_t row_bytes = png_get_rowbytes(png_, info_);
    for (std::size_t row = 0; row < rows.size(); ++row)
      rows[row] = reinterpret_cast<png_bytep>(out + row * row_bytes);
    if (!read_rows(rows.data()))
      damaged();
  }

private:
  // The two functions that libpng may leave by longjmp hold no objects with destructors.
  bool start() {
    if (setjmp(png_jmpbuf(png_)))
      return false;
    png_init_io(png_, file_.get());
    png_read_info(png_, info_);
    png_set_expand(png_); // palettes to RGB, fewer than 8 bits to 8, transparency to alpha
    if (std::endian::native == std::endian::little)
      png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }
  bool read_rows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)))
      return false;
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }
  [[noreturn]] void damaged() const {
    throw FileError(path_.string(), "is a damaged or truncated PNG: " + one_line(failure_.text.data()));
  }

  fs::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  Failure failure_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

} // namespace

Volume png_header(const fs::path& path) { return PngFile(path).header(); }

void read_png(const fs::path& path, std::byte* out) { PngFile(path).read(out); }

} // namespace slicelens
