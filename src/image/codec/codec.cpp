// The codec module: everything that touches OpenImageIO.
#include "image/codec/codec.h"

#include "core/errors.h"
#include "image/codec/limits.h"
#include "image/codec/png_check.h"
#include "image/codec/quantize.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace slicelens {

namespace {

constexpr const char* metadata_prefix = "slicelens:";
/// OpenImageIO's messages may have several lines and name the file again.
std::string one_line(std::string message) {
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back())))
    message.pop_back();
  std::replace_if(
      message.begin(), message.end(), [](unsigned char c) { return c < 32; }, ' ');
  return message.empty() ? std::string("unknown reason") : message;
}

void check_half_range(const Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    // 65520 is where rounding to half precision reaches infinity; a value that was infinite may stay so.
    if (std::isfinite(image.pixels[i]) && std::abs(image.pixels[i]) >= 65520.0F) {
      const std::size_t pixel = i / 4;
      const auto width = static_cast<std::size_t>(image.width);
      throw UsageError("the value " + std::to_string(image.pixels[i]) + " at pixel (" +
                       std::to_string(pixel % width) + ", " + std::to_string(pixel / width) +
                       ") does not fit half floats, which end at 65504; write it as float");
    }
  }
}

OIIO::ImageSpec spec_of(const Image& image, PixelDepth depth) {
  const bool png = depth == PixelDepth::png8 || depth == PixelDepth::png16;
  const OIIO::TypeDesc format = depth == PixelDepth::png8       ? OIIO::TypeDesc::UINT8
                                : depth == PixelDepth::png16    ? OIIO::TypeDesc::UINT16
                                : depth == PixelDepth::exr_half ? OIIO::TypeDesc::HALF
                                                                : OIIO::TypeDesc::FLOAT;
  OIIO::ImageSpec spec(image.width, image.height, 4, format);
  spec.channelnames = {"R", "G", "B", "A"};
  spec.alpha_channel = 3;
  if (png) {
    // The division by alpha is ours, in doubles: the library would do it on values already rounded.
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("oiio:ColorSpace", "sRGB");
  } else {
    spec.attribute("compression", "zip");
    // Without a date the library stores the present one and the bytes differ from run to run. This is the
    // "unknown" of EXIF 2.3 §4.6.4 D.
    spec.attribute("DateTime", "    :  :     :  :  ");
  }
  for (const auto& [key, value] : image.metadata) {
    if (!value.empty()) // the EXR reader loses empty texts; so neither format stores them
      spec.attribute(key, value);
  }
  return spec;
}

std::vector<unsigned char> encode(const Image& image, PixelDepth depth, const std::string& path) {
  const bool png = depth == PixelDepth::png8 || depth == PixelDepth::png16;
  if (depth == PixelDepth::exr_half)
    check_half_range(image);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(png ? "png" : "openexr");
  if (!output)
    throw FileError(path, "OpenImageIO cannot write this format: " + one_line(OIIO::geterror()));
  output->set_ioproxy(&memory);
  if (!output->open(png ? "memory.png" : "memory.exr", spec_of(image, depth)))
    throw FileError(path, "cannot be encoded: " + one_line(output->geterror()));
  bool good = false;
  if (depth == PixelDepth::png8)
    good = output->write_image(OIIO::TypeDesc::UINT8, unassociated<std::uint8_t>(image).data());
  else if (depth == PixelDepth::png16)
    good = output->write_image(OIIO::TypeDesc::UINT16, unassociated<std::uint16_t>(image).data());
  else
    good = output->write_image(OIIO::TypeDesc::FLOAT, image.pixels.data());
  good = output->close() && good;
  if (!good || output->has_error())
    throw FileError(path, "cannot be encoded: " + one_line(output->geterror()));
  return bytes;
}

/// Which channels of a file hold R, G, B and A; alpha is -1 where there is none.
std::array<int, 4> channels_of(const OIIO::ImageSpec& spec) {
  std::array<int, 4> found{-1, -1, -1, spec.alpha_channel};
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c)
    found[c] = spec.channelindex(names[c]);
  if (found[0] >= 0 && found[1] >= 0 && found[2] >= 0)
    return found;
  std::vector<int> colours;
  for (int c = 0; c < spec.nchannels; ++c) {
    if (c != spec.alpha_channel && c != spec.z_channel)
      colours.push_back(c);
  }
  if (colours.empty())
    colours.push_back(0);
  const bool grey = colours.size() < 3;
  for (std::size_t c = 0; c < 3; ++c)
    found[c] = colours[grey ? 0 : c];
  return found;
}

std::map<std::string, std::string> metadata_of(const OIIO::ImageSpec& spec) {
  std::map<std::string, std::string> texts;
  for (const OIIO::ParamValue& attribute : spec.extra_attribs) {
    if (attribute.name().string().rfind(metadata_prefix, 0) == 0 &&
        attribute.type() == OIIO::TypeDesc::STRING)
      texts[attribute.name().string()] = attribute.get_ustring().string();
  }
  return texts;
}

/// The window of the file that the picture shows: for EXR the display window, else the pixels themselves
/// (the offset of a PNG or TIFF places a print on a page).
struct Window {
  int width;
  int height;
  std::int64_t x; ///< column of the first stored pixel, which may lie far outside
  std::int64_t y;
};

Window window_of(const OIIO::ImageSpec& spec, bool exr) {
  if (!exr || spec.full_width < 1 || spec.full_height < 1)
    return {spec.width, spec.height, 0, 0};
  return {spec.full_width, spec.full_height, std::int64_t{spec.x} - spec.full_x,
          std::int64_t{spec.y} - spec.full_y};
}

/// Channels [first, last] of all pixels as floats. Integers of 8 and 16 bit are divided by their largest
/// value here, correctly rounded (the library multiplies by a rounded reciprocal), so k/255 is the float
/// nearest to it.
template <class T>
std::vector<float> stored_values(OIIO::ImageInput& input, int first, int last, const std::string& path) {
  const OIIO::ImageSpec& spec = input.spec();
  const std::size_t count = static_cast<std::size_t>(last - first + 1) *
                            static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height);
  std::vector<T> values(count);
  if (!input.read_image(0, 0, first, last + 1, OIIO::BaseTypeFromC<T>::value, values.data()) ||
      input.has_error())
    throw FileError(path, "is damaged or cut short: " + one_line(input.geterror()));
  if constexpr (std::is_same_v<T, float>) {
    return values;
  } else {
    std::vector<float> floats(count);
    std::transform(values.begin(), values.end(), floats.begin(), [](T value) {
      return static_cast<float>(static_cast<double>(value) / std::numeric_limits<T>::max());
    });
    return floats;
  }
}

/// Puts the stored channels into RGBA, in their place in the window.
void place_pixels(Image& image, const std::vector<float>& stored, const OIIO::ImageSpec& spec,
                  const Window& window, std::array<int, 4> from, std::size_t channels) {
  const bool associate = from[3] >= 0 && spec.get_int_attribute("oiio:UnassociatedAlpha") != 0;
  const float* pixel = stored.data();
  for (int y = 0; y < spec.height; ++y) {
    for (int x = 0; x < spec.width; ++x, pixel += channels) {
      const std::int64_t left = x + window.x;
      const std::int64_t top = y + window.y;
      if (left < 0 || left >= window.width || top < 0 || top >= window.height)
        continue;
      const int column = static_cast<int>(left);
      const int row = static_cast<int>(top);
      const float alpha = from[3] < 0 ? 1.0F : pixel[from[3]];
      for (int c = 0; c < 3; ++c) {
        const float value = pixel[from[static_cast<std::size_t>(c)]];
        channel(image, column, row, c) = associate ? value * alpha : value;
      }
      channel(image, column, row, 3) = alpha;
    }
  }
}

Image decode(const std::string& path, bool pixels) {
  check_png(path);
  OIIO::ImageSpec hint;
  hint.attribute("oiio:UnassociatedAlpha", 1); // association is ours, in floats
  const auto input = OIIO::ImageInput::open(path, &hint);
  if (!input)
    throw FileError(path, "cannot be read as an image: " + one_line(OIIO::geterror()));
  const OIIO::ImageSpec spec = input->spec();
  const std::string format = input->format_name();
  if (format == "null") // a reader for tests that makes up a picture for any file of this name
    throw FileError(path, "is not an image; PNG, EXR, TIFF and JPEG are read");
  std::array<int, 4> from = channels_of(spec);
  const int first = *std::min_element(from.begin(), from.end() - (from[3] < 0 ? 1 : 0));
  const int last = *std::max_element(from.begin(), from.end());
  const Window window = window_of(spec, format == "openexr");
  check_size(path, spec.width, spec.height, std::max(4, last - first + 1));
  check_size(path, window.width, window.height, 4);
  if (spec.depth > 1 || spec.deep)
    throw FileError(path, "holds volume or deep pixels; a flat picture is needed here");
  Image image;
  if (pixels) {
    const bool mixed = !spec.channelformats.empty();
    const std::vector<float> stored = !mixed && spec.format == OIIO::TypeDesc::UINT8
                                          ? stored_values<std::uint8_t>(*input, first, last, path)
                                      : !mixed && spec.format == OIIO::TypeDesc::UINT16
                                          ? stored_values<std::uint16_t>(*input, first, last, path)
                                          : stored_values<float>(*input, first, last, path);
    for (int& c : from)
      c -= c < 0 ? 0 : first;
    image = make_image(window.width, window.height);
    place_pixels(image, stored, spec, window, from, static_cast<std::size_t>(last - first + 1));
  }
  image.metadata = metadata_of(spec);
  return image;
}

} // namespace

} // namespace slicelens

extern "C" __attribute__((visibility("default"))) const slicelens::CodecFunctions*
slicelens_codec_functions() {
  static const slicelens::CodecFunctions functions{slicelens::codec_version, slicelens::encode,
                                                   slicelens::decode};
  return &functions;
}
