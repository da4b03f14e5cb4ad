// A picture as every renderer gives it and every metric takes it.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace slicelens {

/// RGBA floats with associated (premultiplied) colour in display space; row 0 is the top of the picture
/// (docs/spaces.md). Values may exceed 1 (an X-ray's line integral).
struct Image {
  int width = 0;
  int height = 0;
  std::vector<float> pixels;                   ///< 4·width·height values: R G B A of pixel (0,0), (1,0) …
  std::map<std::string, std::string> metadata; ///< texts stored in the file (scene, version, driver …)
};

/// A transparent black picture. Throws LimitError when it is too large to address; sizes must be positive.
Image make_image(int width, int height);

/// Value of channel `c` (0 R, 1 G, 2 B, 3 A) at column x, row y.
inline float& channel(Image& image, int x, int y, int c) {
  return image.pixels[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x)) +
                      static_cast<std::size_t>(c)];
}
inline float channel(const Image& image, int x, int y, int c) {
  return channel(const_cast<Image&>(image), x, y, c);
}

} // namespace slicelens
