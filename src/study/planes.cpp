#include "study/planes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace slicelens {

PixelPlane make_plane(int width, int height) {
  return {width, height,
          std::vector<double>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
}

glm::dvec3 color_over(const Image& image, int x, int y, const glm::dvec3& background) {
  const glm::dvec3 color(channel(image, x, y, 0), channel(image, x, y, 1), channel(image, x, y, 2));
  return color + (1.0 - channel(image, x, y, 3)) * background;
}

PixelPlane luma_plane(const Image& image, const glm::dvec3& background) {
  PixelPlane plane = make_plane(image.width, image.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x)
      plane.at(x, y) = glm::dot(color_over(image, x, y, background), glm::dvec3(0.2126, 0.7152, 0.0722));
  }
  return plane;
}

PixelPlane filtered(const PixelPlane& plane, const std::vector<double>& across,
                    const std::vector<double>& down) {
  PixelPlane rows = make_plane(plane.width, plane.height);
  PixelPlane result = rows;
  const int n = static_cast<int>(across.size() / 2);
  const int m = static_cast<int>(down.size() / 2);
  const tbb::blocked_range<int> lines(0, plane.height, 8);
  tbb::parallel_for(lines, [&](const auto& range) {
    std::vector<double> line(static_cast<std::size_t>(plane.width + 2 * n));
    for (int y = range.begin(); y != range.end(); ++y) {
      for (int x = -n; x < plane.width + n; ++x)
        line[static_cast<std::size_t>(x + n)] = plane.at(std::clamp(x, 0, plane.width - 1), y);
      for (std::size_t i = 0; i < across.size(); ++i) {
        for (int x = 0; x < plane.width; ++x)
          rows.at(x, y) += across[i] * line[static_cast<std::size_t>(x) + i];
      }
    }
  });
  tbb::parallel_for(lines, [&](const auto& range) {
    for (int y = range.begin(); y != range.end(); ++y) {
      for (int j = -m; j <= m; ++j) {
        const int from = std::clamp(y + j, 0, plane.height - 1);
        for (int x = 0; x < plane.width; ++x)
          result.at(x, y) += down[static_cast<std::size_t>(j + m)] * rows.at(x, from);
      }
    }
  });
  return result;
}

} // namespace slicelens
