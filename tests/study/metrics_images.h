// Pictures for the tests of the metrics.
#pragma once

#include "image/image.h"

#include <cmath>
#include <random>

namespace slicelens {

inline Image grey_image(int width, int height, float value) {
  Image image = make_image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = i % 4 == 3 ? 1.0F : value;
  return image;
}

/// Waves plus noise of the given strength, opaque, on 8-bit steps.
inline Image textured_image(int width, int height, double noise, unsigned seed) {
  Image image = grey_image(width, height, 0);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-noise, noise);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double value = 0.5 + 0.3 * std::sin(0.4 * x + c) * std::cos(0.3 * y) + uniform(random);
        channel(image, x, y, c) = static_cast<float>(std::round(255 * value) / 255);
      }
    }
  }
  return image;
}

} // namespace slicelens
