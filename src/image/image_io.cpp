#include "image/image_io.h"

#include "core/errors.h"
#include "core/files.h"
#include "core/text.h"
#include "image/codec/codec.h"

#include <dlfcn.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <future>
#include <system_error>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

const CodecFunctions* load_codec() {
  const fs::path file = find_module("slicelens_codec");
  // Lazy, because binding every function of 261 libraries takes a seventh more of their loading time.
  // Never closed: the libraries behind it leave threads and exit handlers that need their code.
  void* module = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (module == nullptr)
    throw FileError(file.string(), std::string("cannot be loaded: ") + ::dlerror());
  const auto entry = reinterpret_cast<CodecEntry>(::dlsym(module, codec_entry_name));
  if (entry == nullptr || entry()->version != codec_version)
    throw FileError(file.string(), "belongs to another version of Slicelens; install Slicelens again");
  return entry();
}

/// The one loading of the codec in this process, started by the first call. Its end joins the thread.
const std::shared_future<const CodecFunctions*>& codec_loading() {
  static const std::shared_future<const CodecFunctions*> loading =
      std::async(std::launch::async, load_codec).share();
  return loading;
}

const CodecFunctions& codec() { return *codec_loading().get(); }

void check_regular(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found)
    throw FileError(path.string(), "does not exist");
  if (error)
    throw FileError(path.string(), "cannot be opened: " + error.message());
  if (fs::is_directory(status))
    throw FileError(path.string(), "is a folder; an image file is needed here");
  if (!fs::is_regular_file(status)) // a FIFO would block for ever
    throw FileError(path.string(), "is not a regular file; an image file is needed here");
  if (!std::ifstream(path, std::ios::binary))
    throw FileError(path.string(), std::string("cannot be opened: ") + std::strerror(errno));
}

void check_metadata(const std::map<std::string, std::string>& metadata) {
  std::size_t total = 0;
  for (const auto& [key, value] : metadata) {
    const bool printable = std::all_of(key.begin(), key.end(), [](char c) { return c > 32 && c < 127; });
    if (key.rfind("slicelens:", 0) != 0 || key.size() > 79 || !printable) {
      throw UsageError("image metadata key '" + key +
                       "': it must start with slicelens: and have at most 79 printable ASCII characters");
    }
    if (value.find('\0') != std::string::npos)
      throw UsageError("image metadata " + key + ": a NUL character cannot be stored");
    total += value.size();
  }
  if (total > std::size_t{4} << 20)
    throw UsageError("image metadata has " + std::to_string(total) + " bytes; at most 4 MiB are stored");
}

bool is_png(PixelDepth depth) { return depth == PixelDepth::png8 || depth == PixelDepth::png16; }

} // namespace

PixelDepth pixel_depth(const fs::path& path, const std::string& name) {
  const std::string extension = lower(path.extension().string());
  if (extension != ".png" && extension != ".exr")
    throw UsageError(path.string() + ": pictures are written as .png or .exr");
  if (extension == ".png") {
    if (name.empty() || name == "8")
      return PixelDepth::png8;
    if (name == "16")
      return PixelDepth::png16;
    throw UsageError(path.string() + ": depth '" + name + "' does not fit PNG; use 8 or 16, or write .exr");
  }
  // The composited values unchanged are floats.
  if (name.empty() || name == "float")
    return PixelDepth::exr_float;
  if (name == "half")
    return PixelDepth::exr_half;
  throw UsageError(path.string() + ": depth '" + name +
                   "' does not fit EXR; use half or float, or write .png");
}

void write_image(const Image& image, const fs::path& path, PixelDepth depth) {
  if (is_png(pixel_depth(path)) != is_png(depth)) {
    throw UsageError(path.string() + ": " +
                     (is_png(depth) ? "8 and 16 bit integers are written as .png"
                                    : "half and float values are written as .exr"));
  }
  if (image.width < 1 || image.height < 1 ||
      image.pixels.size() !=
          std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    throw UsageError(path.string() + ": the image has no pixels or not as many as its size says");
  check_metadata(image.metadata);
  const std::vector<unsigned char> bytes = codec().encode(image, depth, path.string());
  write_atomically(path, [&](const fs::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out)
      throw FileError(path.string(), std::string("cannot be written: ") + std::strerror(errno));
  });
}

Image read_image(const fs::path& path) {
  check_regular(path);
  return codec().decode(path.string(), true);
}

std::map<std::string, std::string> read_metadata(const fs::path& path) {
  check_regular(path);
  return codec().decode(path.string(), false).metadata;
}

void preload_codec() { codec_loading(); }

void await_codec() { codec_loading().wait(); }

} // namespace slicelens
