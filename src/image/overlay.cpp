#include "image/overlay.h"

#include "core/errors.h"
#include "image/colormap.h"
#include "image/lettering.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 edge = b - a;
  const double length2 = glm::dot(edge, edge);
  const double x = length2 > 0 ? std::clamp(glm::dot(p - a, edge) / length2, 0.0, 1.0) : 0;
  return glm::length(p - (a + x * edge));
}

/// Cuts the segment to the picture grown by `margin` (Liang-Barsky), so that a far end costs nothing.
bool cut_to_picture(glm::dvec2& a, glm::dvec2& b, const glm::dvec2& size, double margin) {
  double begin = 0;
  double end = 1;
  const glm::dvec2 edge = b - a;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = -margin - a[axis];
    const double high = size[axis] + margin - a[axis];
    if (edge[axis] == 0) {
      if (low > 0 || high < 0)
        return false;
      continue;
    }
    const double first = (edge[axis] > 0 ? low : high) / edge[axis];
    const double last = (edge[axis] > 0 ? high : low) / edge[axis];
    begin = std::max(begin, first);
    end = std::min(end, last);
  }
  if (!(begin <= end))
    return false;
  b = a + end * edge;
  a += begin * edge;
  return true;
}

void cover(std::vector<float>& shares, const Image& image, glm::dvec2 a, glm::dvec2 b, double width) {
  const double reach = 0.5 * width + 0.5;
  const glm::dvec2 size(image.width, image.height);
  const bool finite = std::isfinite(a.x + a.y) && std::isfinite(b.x + b.y);
  if (!finite || !cut_to_picture(a, b, size, reach + 1))
    return;
  const glm::dvec2 low = glm::clamp(glm::floor(glm::min(a, b) - reach), glm::dvec2(0), size);
  const glm::dvec2 high = glm::clamp(glm::ceil(glm::max(a, b) + reach), glm::dvec2(0), size);
  const glm::dvec2 edge = b - a;
  for (int y = static_cast<int>(low.y); y < static_cast<int>(high.y); ++y) {
    // Columns near the segment in this row only: a long diagonal's bounds are mostly empty.
    double first = low.x;
    double last = high.x;
    if (std::abs(edge.y) > 1e-9) {
      const double at = a.x + (y + 0.5 - a.y) * edge.x / edge.y;
      const double spread = reach * (1 + std::abs(edge.x / edge.y)) + 1;
      first = std::max(first, std::floor(at - spread));
      last = std::min(last, std::ceil(at + spread));
    }
    for (int x = static_cast<int>(first); x < static_cast<int>(last); ++x) {
      const double share =
          std::clamp(reach - distance_to_segment({x + 0.5, y + 0.5}, a, b), 0.0, std::min(1.0, width));
      float& best = shares[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                           static_cast<std::size_t>(x)];
      best = std::max(best, static_cast<float>(share));
    }
  }
}

/// Opaque colour over pixel i by `share`.
void mix_pixel(Image& image, std::size_t i, const glm::vec3& color, float share) {
  for (int c = 0; c < 4; ++c) {
    float& value = image.pixels[4 * i + static_cast<std::size_t>(c)];
    value += share * ((c < 3 ? color[c] : 1.0F) - value);
  }
}

} // namespace

void draw_lines(Image& image, const std::vector<PixelLine>& lines, double width, const glm::vec3& color) {
  std::vector<float> shares(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  for (const PixelLine& line : lines) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      cover(shares, image, line[i], line[i + 1], width);
  }
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] > 0)
      mix_pixel(image, i, color, shares[i]);
  }
}

void draw_false_color(Image& image, const std::vector<double>& values, double opacity) {
  if (4 * values.size() != image.pixels.size()) {
    throw UsageError("false colours: " + std::to_string(values.size()) + " values for " +
                     std::to_string(image.pixels.size() / 4) + " pixels; give one for each");
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i]))
      mix_pixel(image, i, heat_color(values[i]), static_cast<float>(opacity));
  }
}

Image with_color_bar(const Image& image, const std::string& low, const std::string& high,
                     const std::string& mark, std::optional<double> mark_at) {
  Image result = make_image(image.width, image.height + color_bar_height);
  result.metadata = image.metadata;
  std::copy(image.pixels.begin(), image.pixels.end(), result.pixels.begin());
  const int top = image.height;
  constexpr int bar_top = 2;
  constexpr int bar_bottom = 12;
  const int tick = mark_at ? static_cast<int>(*mark_at * image.width) : -1;
  for (int y = top; y < result.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool in_bar = y >= top + bar_top && y < top + bar_bottom && x != tick;
      const glm::vec3 color = in_bar ? heat_color((x + 0.5) / image.width) : glm::vec3(x == tick ? 1 : 0);
      for (int c = 0; c < 3; ++c)
        channel(result, x, y, c) = color[c];
      channel(result, x, y, 3) = 1;
    }
  }
  const int row = top + bar_bottom + 2;
  const int high_left = image.width - text_width(high) - 1;
  for (int y = row; y < result.height; ++y) { // the tick ends above the lettering
    for (int c = 0; c < 3; ++c) {
      if (tick >= 0 && tick < image.width)
        channel(result, tick, y, c) = 0;
    }
  }
  draw_text(result, 1, row, low, glm::vec3(1));
  draw_text(result, high_left, row, high, glm::vec3(1));
  const int left = tick - text_width(mark) / 2;
  if (mark_at && left > 1 + text_width(low) + letter_advance &&
      left + text_width(mark) + letter_advance < high_left)
    draw_text(result, left, row, mark, glm::vec3(1));
  return result;
}

} // namespace slicelens
