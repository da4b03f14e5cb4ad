#include "image/codec/limits.h"

#include "core/errors.h"

namespace slicelens {

namespace {

constexpr std::int64_t largest_side = 65536;
constexpr std::int64_t largest_floats = (std::int64_t{1} << 30) / 4;

} // namespace

void check_size(const std::string& path, std::int64_t width, std::int64_t height, std::int64_t channels) {
  const std::string size = std::to_string(width) + "×" + std::to_string(height);
  if (width < 1 || height < 1)
    throw FileError(path, "claims a picture of " + size + " pixels; it needs at least one");
  if (width > largest_side || height > largest_side || width * height > largest_floats / channels) {
    throw FileError(path, "claims a picture of " + size + " pixels; at most " + std::to_string(largest_side) +
                              " on a side and 1 GiB as floats are read");
  }
}

} // namespace slicelens
