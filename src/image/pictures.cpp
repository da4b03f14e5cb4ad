#include "image/pictures.h"

#include "core/errors.h"
#include "core/text.h"
#include "image/colormap.h"
#include "image/lettering.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

std::string size_text(const Image& image) {
  return std::to_string(image.width) + "×" + std::to_string(image.height);
}

void check_same_size(const Image& a, const Image& b) {
  if (a.width != b.width || a.height != b.height)
    throw UsageError("the pictures are " + size_text(a) + " and " + size_text(b) +
                     "; only pictures of the same size can be compared");
}

void fill(Image& image, const glm::vec3& color) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < 3; ++c)
        channel(image, x, y, c) = color[c];
      channel(image, x, y, 3) = 1;
    }
  }
}

/// Black or white, whichever stands out from `background` (Rec. 709 luma).
glm::vec3 ink_on(const glm::vec3& background) {
  return glm::vec3(glm::dot(background, glm::vec3(0.2126F, 0.7152F, 0.0722F)) > 0.5F ? 0.0F : 1.0F);
}

/// Which share of old pixels a new pixel covers along one axis.
struct Share {
  int index;
  double weight;
};

std::vector<std::vector<Share>> shares(int from, int to) {
  std::vector<std::vector<Share>> all(static_cast<std::size_t>(to));
  const double scale = static_cast<double>(from) / to;
  for (int i = 0; i < to; ++i) {
    const double begin = i * scale;
    const double end = std::min((i + 1) * scale, static_cast<double>(from));
    for (int k = static_cast<int>(begin); k < from && k < end; ++k) {
      const double covered = std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k));
      if (covered > 0)
        all[static_cast<std::size_t>(i)].push_back({k, covered / (end - begin)});
    }
  }
  return all;
}

void draw_bar(Image& map, int top, double scale) {
  constexpr int bar_height = 10;
  for (int x = 0; x < map.width; ++x) {
    const glm::vec3 color = heat_color((x + 0.5) / map.width);
    for (int y = top + 2; y < top + 2 + bar_height; ++y) {
      for (int c = 0; c < 3; ++c)
        channel(map, x, y, c) = color[c];
    }
  }
  const std::string end = number_text(scale);
  const int row = top + 2 + bar_height + 2;
  draw_text(map, 1, row, "0", glm::vec3(1));
  draw_text(map, map.width - text_width(end) - 1, row, end, glm::vec3(1));
  const std::string name = "|A-B|";
  if (text_width(name) + 2 * text_width(end) + 8 * letter_advance <= map.width)
    draw_text(map, (map.width - text_width(name)) / 2, row, name, glm::vec3(1));
}

} // namespace

Image over_background(const Image& image, const glm::vec3& background) {
  Image result = image;
  for (std::size_t i = 0; i + 3 < result.pixels.size(); i += 4) {
    const float rest = 1 - result.pixels[i + 3];
    for (int c = 0; c < 3; ++c)
      result.pixels[i + static_cast<std::size_t>(c)] += rest * background[c];
    result.pixels[i + 3] = 1;
  }
  return result;
}

Image difference_image(const Image& a, const Image& b, double factor) {
  check_same_size(a, b);
  Image result = make_image(a.width, a.height);
  for (std::size_t i = 0; i < result.pixels.size(); ++i) {
    const double difference = std::abs(static_cast<double>(a.pixels[i]) - b.pixels[i]);
    result.pixels[i] = i % 4 == 3 ? 1.0F : static_cast<float>(difference * factor);
  }
  return result;
}

Image heat_map(const Image& a, const Image& b, double scale) {
  check_same_size(a, b);
  if (!(scale > 0) || !std::isfinite(scale))
    throw UsageError("heat map scale " + number_text(scale) + ": it must be a positive number");
  Image map = make_image(a.width, a.height + heat_map_bar_height);
  fill(map, glm::vec3(0));
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      double error = 0;
      for (int c = 0; c < 3; ++c) {
        const double d = std::abs(static_cast<double>(channel(a, x, y, c)) - channel(b, x, y, c));
        error = std::isnan(d) || d > error ? d : error; // a NaN stays: no number is greater than it
      }
      const glm::vec3 color = heat_color(error / scale);
      for (int c = 0; c < 3; ++c)
        channel(map, x, y, c) = color[c];
    }
  }
  draw_bar(map, a.height, scale);
  return map;
}

Image resize(const Image& image, int width, int height) {
  if (width < 1 || height < 1)
    throw UsageError("a picture cannot be resized to " + std::to_string(width) + "×" +
                     std::to_string(height) + "; it needs at least one pixel on each side");
  Image result = make_image(width, height);
  result.metadata = image.metadata;
  const auto columns = shares(image.width, width);
  const auto rows = shares(image.height, height);
  std::vector<double> line(4 * static_cast<std::size_t>(image.width)); // the old rows' mean, still full width
  for (int y = 0; y < height; ++y) {
    std::fill(line.begin(), line.end(), 0.0);
    for (const Share& row : rows[static_cast<std::size_t>(y)]) {
      for (std::size_t i = 0; i < line.size(); ++i)
        line[i] += row.weight * image.pixels[line.size() * static_cast<std::size_t>(row.index) + i];
    }
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 4; ++c) {
        double sum = 0;
        for (const Share& column : columns[static_cast<std::size_t>(x)])
          sum += column.weight * line[static_cast<std::size_t>(4 * column.index + c)];
        channel(result, x, y, c) = static_cast<float>(sum);
      }
    }
  }
  return result;
}

Image contact_sheet(const std::vector<Image>& images, const std::vector<std::string>& captions, int columns,
                    int padding, const glm::vec3& background) {
  if (images.empty() || columns < 1 || padding < 0)
    throw UsageError("a contact sheet needs at least one picture, one column and padding of at least 0");
  if (!captions.empty() && captions.size() != images.size())
    throw UsageError("a contact sheet of " + std::to_string(images.size()) + " pictures has " +
                     std::to_string(captions.size()) + " captions; give one for each, or none");
  int cell_width = 0;
  int cell_height = 0;
  for (const Image& image : images) {
    cell_width = std::max(cell_width, image.width);
    cell_height = std::max(cell_height, image.height);
  }
  const int count = static_cast<int>(images.size());
  const int across = std::min(columns, count);
  const int down = (count + across - 1) / across;
  const int step_x = cell_width + padding;
  const int step_y = cell_height + padding + (captions.empty() ? 0 : letter_height + 3);
  Image sheet = make_image(across * step_x + padding, down * step_y + padding);
  fill(sheet, background);
  for (int i = 0; i < count; ++i) {
    const Image& image = images[static_cast<std::size_t>(i)];
    const int left = padding + i % across * step_x;
    const int top = padding + i / across * step_y;
    const Image opaque = over_background(image, background);
    const std::size_t row_floats = 4 * static_cast<std::size_t>(image.width);
    for (int y = 0; y < image.height; ++y) {
      std::copy_n(opaque.pixels.begin() + static_cast<std::ptrdiff_t>(row_floats) * y, row_floats,
                  &channel(sheet, left + (cell_width - image.width) / 2,
                           top + (cell_height - image.height) / 2 + y, 0));
    }
    if (!captions.empty()) {
      std::string caption = captions[static_cast<std::size_t>(i)];
      while (!caption.empty() && text_width(caption) > cell_width)
        caption.pop_back();
      draw_text(sheet, left + (cell_width - text_width(caption)) / 2, top + cell_height + 3, caption,
                ink_on(background));
    }
  }
  return sheet;
}

} // namespace slicelens
