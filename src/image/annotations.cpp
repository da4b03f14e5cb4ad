#include "image/annotations.h"

#include "image/lettering.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace slicelens {

namespace {

// Sizes in dots of the lettering (annotation_scale).
constexpr int margin = 4;
constexpr int color_columns = 8;
constexpr int opacity_columns = 17;
constexpr int tick_columns = 2;
constexpr int line_height = letter_height + 3;
constexpr int bar_rows = 2;
constexpr int most_ticks = 7;

/// Share of the picture's height that legends fill with the lettering of all but the first.
double legend_share(int count) { return count > 1 ? 0.8 : 0.7; }

/// Lines of lettering above a legend.
constexpr int header_lines = 2;

/// Opaque colour over a pixel by `share`; pixels outside the picture are left out.
void mix(Image& image, int x, int y, const glm::vec3& color, float share = 1) {
  if (x < 0 || x >= image.width || y < 0 || y >= image.height)
    return;
  for (int c = 0; c < 4; ++c) {
    float& value = channel(image, x, y, c);
    value += share * ((c < 3 ? color[c] : 1.0F) - value);
  }
}

void fill(Image& image, const PixelBox& box, const glm::vec3& color, float share = 1) {
  for (int y = box.top; y < box.top + box.height; ++y) {
    for (int x = box.left; x < box.left + box.width; ++x)
      mix(image, x, y, color, share);
  }
}

PixelBox grown(const PixelBox& box, int by) {
  return {box.left - by, box.top - by, box.width + 2 * by, box.height + 2 * by};
}

/// The pixels of `outer` that are not in `inner`.
void fill_frame(Image& image, const PixelBox& outer, const PixelBox& inner, const glm::vec3& color) {
  for (int y = outer.top; y < outer.top + outer.height; ++y) {
    for (int x = outer.left; x < outer.left + outer.width; ++x) {
      const bool inside =
          x >= inner.left && x < inner.left + inner.width && y >= inner.top && y < inner.top + inner.height;
      if (!inside)
        mix(image, x, y, color);
    }
  }
}

/// Rows of one of `count` legends, without its header.
int legend_rows(const Image& image, int count, int scale) {
  const int all = static_cast<int>(legend_share(count) * image.height);
  const int header = header_lines * line_height + letter_height;
  return std::max(4, count > 1 ? all / count - header * scale
                               : std::min(all, image.height - (header + margin) * scale));
}

Ticks ticks_of(const Legend& legend, int rows, int scale) {
  return round_ticks(legend.low, legend.high, std::clamp(rows / (line_height * scale), 2, most_ticks));
}

/// Pixels of the widest number beside the legends.
int numbers_width(const std::vector<Legend>& legends, int rows, int scale) {
  int width = 0;
  for (const Legend& legend : legends) {
    const Ticks ticks = ticks_of(legend, rows, scale);
    for (const double value : ticks.values)
      width = std::max(width, scale * text_width(tick_text(value, ticks.step)));
  }
  return width;
}

void draw_rows(Image& image, const Legend& legend, const LegendPlace& place) {
  const PixelBox& colors = place.colors;
  const PixelBox& opacities = place.opacities;
  fill(image, opacities, glm::vec3(0), 0.75F);
  for (int row = 0; row < colors.height; ++row) {
    const double value = legend.high - (row + 0.5) / colors.height * (legend.high - legend.low);
    const glm::dvec4 rgba = legend.rgba(value);
    fill(image, {colors.left, colors.top + row, colors.width, 1}, glm::vec3(rgba));
    const int lit = static_cast<int>(std::lround(rgba.a * opacities.width));
    fill(image, {opacities.left + opacities.width - lit, opacities.top + row, lit, 1}, glm::vec3(0.85F));
  }
}

LegendPlace draw_legend(Image& image, const Legend& legend, int left, int top, int rows, int scale) {
  LegendPlace place;
  place.opacities = {left, top, opacity_columns * scale, rows};
  place.colors = {left + (opacity_columns + 1) * scale, top, color_columns * scale, rows};
  const PixelBox whole{left, top, (opacity_columns + 1 + color_columns) * scale, rows};
  fill_frame(image, grown(whole, 2 * scale), whole, glm::vec3(0));
  fill_frame(image, grown(whole, scale), whole, glm::vec3(1));
  fill(image, {left + opacity_columns * scale, top, scale, rows}, glm::vec3(1));
  draw_rows(image, legend, place);
  const int line = top - (line_height + 1) * scale; // the lowest of header_lines
  draw_outlined_text(image, left, line, "1", scale);
  draw_outlined_text(image, left + (opacity_columns - letter_advance + 1) * scale, line, "0", scale);
  draw_outlined_text(image, left, line - line_height * scale, legend.title, scale);
  const Ticks ticks = ticks_of(legend, rows, scale);
  const int edge = whole.left + whole.width + scale;
  for (const double value : ticks.values) {
    const int row =
        top +
        std::clamp(static_cast<int>(std::floor((legend.high - value) / (legend.high - legend.low) * rows)), 0,
                   rows - 1);
    const PixelBox tick{edge, row - (scale - 1) / 2, tick_columns * scale, scale};
    fill(image, grown(tick, scale), glm::vec3(0));
    fill(image, {edge - scale, tick.top, (tick_columns + 1) * scale, scale}, glm::vec3(1));
    draw_outlined_text(image, edge + (tick_columns + 2) * scale, row - letter_height * scale / 2,
                       tick_text(value, ticks.step), scale);
  }
  return place;
}

} // namespace

int annotation_scale(const Image& image) { return std::max(1, std::min(image.width, image.height) / 256); }

double round_length(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  const double room = limit * (1 + 1e-9);
  for (const double digit : {10.0, 5.0, 2.0, 1.0}) {
    if (digit * power <= room)
      return digit * power;
  }
  return power; // the logarithm was rounded up
}

Ticks round_ticks(double low, double high, int most) {
  Ticks ticks;
  // One step below what would be too many, then up until it fits.
  ticks.step = round_length((high - low) / most);
  while (std::floor(high / ticks.step + 1e-9) - std::ceil(low / ticks.step - 1e-9) + 1 > most) {
    const double next = round_length(2.6 * ticks.step);
    ticks.step = next > ticks.step ? next : 2 * ticks.step;
  }
  const double first = std::ceil(low / ticks.step - 1e-9);
  const double last = std::floor(high / ticks.step + 1e-9);
  for (double i = first; i <= last && static_cast<int>(ticks.values.size()) < most; ++i)
    ticks.values.push_back(i == 0 ? 0 : i * ticks.step);
  return ticks;
}

std::string tick_text(double value, double step) {
  char text[64];
  const double magnitude = std::max(std::abs(value), step);
  if (magnitude >= 1e6 || step < 1e-4) {
    const int digits = static_cast<int>(std::floor(std::log10(magnitude)) - std::floor(std::log10(step)));
    std::snprintf(text, sizeof text, "%.*g", std::clamp(digits + 1, 1, 15), value);
  } else {
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
  }
  return text;
}

int legends_width(const Image& image, const std::vector<Legend>& legends) {
  if (legends.empty())
    return 0;
  const int scale = annotation_scale(image);
  const int rows = legend_rows(image, static_cast<int>(legends.size()), scale);
  int title = 0;
  for (const Legend& legend : legends)
    title = std::max(title, scale * text_width(legend.title));
  const int bars = (opacity_columns + 1 + color_columns + 1 + tick_columns + 2) * scale;
  return std::max(bars + numbers_width(legends, rows, scale), title) + margin * scale;
}

std::vector<LegendPlace> draw_legends(Image& image, const std::vector<Legend>& legends) {
  std::vector<LegendPlace> places;
  if (legends.empty())
    return places;
  const int scale = annotation_scale(image);
  const int count = static_cast<int>(legends.size());
  const int rows = legend_rows(image, count, scale);
  const int left = image.width - legends_width(image, legends);
  const double share = legend_share(count);
  const int step = static_cast<int>(share * image.height) / count;
  const int top_of_all = static_cast<int>((1 - share) / 2 * image.height);
  // A small picture's margin is smaller than the header.
  int top = std::max(top_of_all, count > 1 ? 0 : (header_lines * line_height + 3) * scale);
  if (count > 1)
    top += header_lines * line_height * scale;
  for (const Legend& legend : legends) {
    places.push_back(draw_legend(image, legend, left, top, rows, scale));
    top += step;
  }
  return places;
}

PixelBox draw_scale_bar(Image& image, double pixels, const std::vector<std::string>& text) {
  const int scale = annotation_scale(image);
  const int length = std::max(1, static_cast<int>(std::lround(pixels)));
  const int bottom = image.height - margin * scale;
  const PixelBox bar{margin * scale, bottom - bar_rows * scale, length, bar_rows * scale};
  // Ends that stand up, within the length.
  const PixelBox first{bar.left, bar.top - 2 * scale, std::min(scale, length), 4 * scale};
  const PixelBox last{bar.left + length - first.width, first.top, first.width, first.height};
  for (const PixelBox& part : {bar, first, last})
    fill(image, grown(part, scale), glm::vec3(0));
  for (const PixelBox& part : {bar, first, last})
    fill(image, part, glm::vec3(1));
  int line = first.top - 2 * scale;
  for (auto words = text.rbegin(); words != text.rend(); ++words) {
    line -= line_height * scale;
    draw_outlined_text(image, bar.left, line + scale, *words, scale);
  }
  return bar;
}

void draw_edge_letters(Image& image, const std::array<std::string, 4>& letters, int taken_right) {
  const int scale = annotation_scale(image);
  const auto width = [&](int i) { return scale * text_width(letters[static_cast<std::size_t>(i)]); };
  const int high = letter_height * scale;
  const int middle_row = (image.height - high) / 2;
  const int far = image.height - margin * scale - high;
  draw_outlined_text(image, margin * scale, middle_row, letters[0], scale);
  draw_outlined_text(image, image.width - std::max(taken_right, 0) - margin * scale - width(1), middle_row,
                     letters[1], scale);
  draw_outlined_text(image, (image.width - width(2)) / 2, margin * scale, letters[2], scale);
  draw_outlined_text(image, (image.width - width(3)) / 2, far, letters[3], scale);
}

} // namespace slicelens
