#include "volume/jpeg_slice.h"

#include "core/errors.h"
#include "volume/file_checks.h"

#include <cstdio>
// libjpeg's header needs FILE.
#include <jpeglib.h>

#include <array>
#include <csetjmp>
#include <memory>
#include <string>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

/// libjpeg's error manager with a way out: its error_exit must not return.
struct Failure {
  jpeg_error_mgr manager{}; // first, so that libjpeg's pointer to it points to this too
  std::jmp_buf out{};
  std::array<char, JMSG_LENGTH_MAX> text{};
};

extern "C" void slicelens_jpeg_error(j_common_ptr jpeg) {
  auto* const failure = reinterpret_cast<Failure*>(jpeg->err);
  (*jpeg->err->format_message)(jpeg, failure->text.data());
  std::longjmp(failure->out, 1);
}
/// Warnings (level −1) tell of data that are damaged or end early; libjpeg would fill in grey.
extern "C" void slicelens_jpeg_message(j_common_ptr jpeg, int level) {
  if (level < 0)
    slicelens_jpeg_error(jpeg);
}
extern "C" void slicelens_jpeg_silence(j_common_ptr) {}

class JpegFile {
public:
  explicit JpegFile(const fs::path& path) : path_(path), file_(std::fopen(path.c_str(), "rb")) {
    if (!file_)
      throw FileError(path.string(), "cannot be opened");
    jpeg_.err = jpeg_std_error(&failure_.manager);
    failure_.manager.error_exit = slicelens_jpeg_error;
    failure_.manager.emit_message = slicelens_jpeg_message;
    failure_.manager.output_message = slicelens_jpeg_silence;
    if (!start()) {
      jpeg_destroy_decompress(&jpeg_);
      damaged();
    }
  }
  ~JpegFile() { jpeg_destroy_decompress(&jpeg_); }
  JpegFile(const JpegFile&) = delete;
  JpegFile& operator=(const JpegFile&) = delete;

  Volume header() const {
    if (jpeg_.num_components != 1 && jpeg_.num_components != 3)
      throw FileError(path_.string(), "has " + std::to_string(jpeg_.num_components) +
                                          " colour components; grey or RGB are supported");
    Volume image;
    image.dims = {jpeg_.image_width, jpeg_.image_height, 1};
    image.components = jpeg_.num_components;
    return image;
  }

  void read(std::byte* out) {
    if (!read_rows(reinterpret_cast<JSAMPLE*>(out)))
      damaged();
  }

private:
  // The two functions that libjpeg may leave by longjmp hold no objects with destructors.
  bool start() {
    if (setjmp(failure_.out))
      return false;
    jpeg_create_decompress(&jpeg_);
    // A progressive file of a few bytes may ask for as much memory as its size claims; beyond this libjpeg
    // refuses.
    jpeg_.mem->max_memory_to_use = 1L << 30;
    jpeg_stdio_src(&jpeg_, file_.get());
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }
  bool read_rows(JSAMPLE* out) {
    if (setjmp(failure_.out))
      return false;
    jpeg_.out_color_space = jpeg_.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_start_decompress(&jpeg_);
    const std::size_t row_bytes =
        static_cast<std::size_t>(jpeg_.output_width) * static_cast<std::size_t>(jpeg_.num_components);
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = out + static_cast<std::size_t>(jpeg_.output_scanline) * row_bytes;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
    jpeg_finish_decompress(&jpeg_);
    return true;
  }
  [[noreturn]] void damaged() const {
    throw FileError(path_.string(), "is a damaged or truncated JPEG: " + one_line(failure_.text.data()));
  }

  fs::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  Failure failure_;
  jpeg_decompress_struct jpeg_{};
};

} // namespace

Volume jpeg_header(const fs::path& path) { return JpegFile(path).header(); }

void read_jpeg(const fs::path& path, std::byte* out) { JpegFile(path).read(out); }

} // namespace slicelens
