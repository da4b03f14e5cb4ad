#include "core/errors.h"

namespace slicelens {

namespace {

std::string without_controls(std::string text) {
  for (char& c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 32 || byte == 127)
      c = '?';
  }
  return text;
}

} // namespace

Error::Error(const std::string& message) : std::runtime_error(without_controls(message)) {}

std::size_t checked_product(std::size_t a, std::size_t b, const std::string& what) {
  std::size_t product = 0;
  if (__builtin_mul_overflow(a, b, &product)) {
    throw LimitError(what + ": " + std::to_string(a) + " x " + std::to_string(b) +
                     " is more than this machine can address");
  }
  return product;
}

} // namespace slicelens
