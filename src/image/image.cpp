#include "image/image.h"

#include "core/errors.h"

namespace slicelens {

Image make_image(int width, int height) {
  if (width < 1 || height < 1)
    throw UsageError("an image needs at least one pixel on each side");
  Image image;
  image.width = width;
  image.height = height;
  image.pixels.assign(checked_product(checked_product(static_cast<std::size_t>(width),
                                                      static_cast<std::size_t>(height), "image"),
                                      4, "image"),
                      0.0F);
  return image;
}

} // namespace slicelens
