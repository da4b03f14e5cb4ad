// Scenes and pictures for the tests of the renderers.
#pragma once

#include "gl_fixture.h"
#include "render/render.h"
#include "scene/scene_json.h"
#include "volume/phantom.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace slicelens {

/// A scene from JSON text, its phantom's volume, and a transfer function.
inline PreparedScene prepare_phantom(const std::string& json, TransferFunction transfer) {
  Scene scene = scene_from_json(json, "test");
  Volume volume =
      make_phantom(*scene.volume.phantom, scene.volume.size.value_or(std::array<std::size_t, 3>{64, 64, 64}));
  return prepare(std::move(scene), std::move(volume), std::move(transfer));
}

/// The prepared scene with other keys.
inline PreparedScene changed(const PreparedScene& prepared, const std::vector<std::string>& assignments) {
  std::vector<KeyValue> changes;
  for (const std::string& text : assignments)
    changes.push_back(parse_assignment(text));
  PreparedScene result = prepared;
  result.scene = scene_from_json(scene_to_json(prepared.scene), "test", changes);
  prepare_again(result);
  return result;
}

inline Image picture(const PreparedScene& prepared, gl::Context& context) {
  return render(prepared, &context, {}).image;
}

/// The world ray through pixel (x, y), for closed forms.
inline Ray pixel_ray(const PreparedScene& prepared, int x, int y) {
  return ray_from_pixel(prepared.view, x + 0.5, y + 0.5);
}

/// Mean of |value − expected(x, y)| in channel c over the pixels for which `take` holds.
inline double mean_error(
    const Image& image, int c, const std::function<double(int, int)>& expected,
    const std::function<bool(int, int)>& take = [](int, int) { return true; }) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!take(x, y))
        continue;
      sum += std::abs(static_cast<double>(channel(image, x, y, c)) - expected(x, y));
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

/// Largest difference of any value.
inline double max_difference(const Image& a, const Image& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    largest =
        std::max(largest, std::abs(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i])));
  }
  return largest;
}

/// Share of the values that differ by more than `limit`.
inline double share_over(const Image& a, const Image& b, double limit) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    if (std::abs(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i])) > limit)
      ++count;
  }
  return static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

/// PSNR in dB over all four channels, peak 1; +infinity when equal.
inline double psnr(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double d = static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]);
    sum += d * d;
  }
  return 10 * std::log10(static_cast<double>(a.pixels.size()) / sum);
}

inline TransferFunction grey(double opacity) { return constant_transfer({1, 1, 1, opacity}); }

/// Opacity rising linearly from 0 at value `low` to `top` at `high`, warm colours.
inline TransferFunction rising(double low, double high, double top) {
  return {{{low, 0.2, 0.1, 0.0, 0.0}, {high, 1.0, 0.9, 0.7, top}}, std::nullopt, "rising"};
}

} // namespace slicelens
