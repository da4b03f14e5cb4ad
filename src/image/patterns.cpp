#include "image/patterns.h"

#include "image/lettering.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace slicelens {

namespace {

constexpr double pi = 3.14159265358979323846;

glm::dvec3 hue_color(double turn, double value) {
  glm::dvec3 color;
  for (int c = 0; c < 3; ++c)
    color[c] = value * (0.55 + 0.45 * std::cos(2 * pi * (turn - c / 3.0)));
  return color;
}

/// Share of a pixel whose centre lies `distance` pixels inside an edge.
double coverage(double distance) { return std::clamp(distance + 0.5, 0.0, 1.0); }

/// Smooth gradient with thin lines every 1/32 and thicker ones every 1/8 of the longer edge.
glm::dvec3 ground(const glm::dvec2& p, double longer) {
  const glm::dvec2 u = p / longer;
  glm::dvec3 color(0.25 + 0.35 * u.x, 0.45 - 0.2 * u.y + 0.15 * u.x, 0.55 - 0.3 * u.x + 0.2 * u.y);
  const auto line = [&](double cell, double half_width) {
    const double spacing = longer * cell;
    double nearest = spacing;
    for (int axis = 0; axis < 2; ++axis)
      nearest = std::min(nearest, std::abs(p[axis] - spacing * std::round(p[axis] / spacing)));
    return coverage(half_width - nearest);
  };
  color = glm::mix(color, glm::dvec3(0.85), 0.6 * line(1.0 / 32, 0.5));
  return glm::mix(color, glm::dvec3(1.0), 0.8 * line(1.0 / 8, 1.0));
}

/// Siemens star of coloured spokes around `center`.
void star(glm::dvec3& color, const glm::dvec2& d, double radius) {
  const double r = glm::length(d);
  const double turn = std::atan2(d.y, d.x) / (2 * pi);
  constexpr double spokes = 36;
  // Spokes thinner than two pixels fade to their mean.
  const double contrast = std::clamp(2 * pi * r / spokes - 0.8, 0.0, 1.0);
  const double wave = std::clamp(0.5 + 2 * std::sin(2 * pi * spokes * turn), 0.0, 1.0);
  const glm::dvec3 star_color = hue_color(turn, 0.5 + (wave - 0.5) * contrast);
  color = glm::mix(color, star_color, coverage(radius - r));
}

/// Rings whose frequency grows with the radius, up to a quarter of a cycle a pixel at the rim.
void zone_plate(glm::dvec3& color, const glm::dvec2& d, double radius) {
  const double r2 = glm::dot(d, d);
  const double wave = 0.5 + 0.5 * std::cos(pi * r2 / (4 * radius));
  color = glm::mix(color, glm::dvec3(wave), coverage(radius - std::sqrt(r2)));
}

/// Four bands of stripes: periods 16, 8, 4 and 2 pixels, upright in the upper half, lying in the lower.
void gratings(glm::dvec3& color, const glm::dvec2& d, double half) {
  if (std::abs(d.x) >= half || std::abs(d.y) >= half)
    return;
  const int band = std::min(3, static_cast<int>((d.x + half) / (half / 2)));
  const double period = 16.0 / (1 << band);
  const double along = d.y < 0 ? d.x : d.y;
  const bool on = std::fmod(std::floor(along / (period / 2)) + 1e6, 2.0) < 1;
  color = on ? glm::dvec3(0.95, 0.95, 0.85) : glm::dvec3(0.1, 0.05, 0.3);
}

/// Discs in rows, each row's radius three quarters of the one above.
void discs(glm::dvec3& color, const glm::dvec2& d, double half) {
  if (std::abs(d.x) >= half || std::abs(d.y) >= half)
    return;
  color = glm::dvec3(0.08, 0.1, 0.12);
  double radius = half / 6;
  double top = -half;
  for (int row = 0; row < 12 && radius > 0.4; ++row) {
    const double pitch = 2.6 * radius;
    if (d.y < top + pitch) {
      const double column = std::round((d.x + half - pitch / 2) / pitch);
      const glm::dvec2 center(-half + pitch / 2 + column * pitch, top + pitch / 2);
      const double inside = coverage(radius - glm::length(d - center));
      color = glm::mix(color, hue_color(0.13 * column + 0.07 * row, 1), inside);
      return;
    }
    top += pitch;
    radius *= 0.75;
  }
}

void letter(Image& image, int left, int top, int right, int bottom) {
  const std::string lines[] = {"LAMAR, HAMANN, JOY 2001", "A MAGNIFICATION LENS",
                               "FOR INTERACTIVE VOLUME",  "VISUALIZATION",
                               "0123456789 +-*/=<>",      "THE QUICK BROWN FOX JUMPS"};
  int row = top + 2;
  for (int i = 0; row + letter_height <= bottom; ++i, row += letter_height + 3) {
    std::string line = lines[i % 6];
    while (!line.empty() && left + 2 + text_width(line) > right)
      line.pop_back();
    draw_text(image, left + 2, row, line,
              i % 2 == 0 ? glm::vec3(0.1F, 0.1F, 0.35F) : glm::vec3(0.5F, 0.05F, 0.05F));
  }
}

} // namespace

Image checkerboard(int width, int height, int squares) {
  Image image = make_image(width, height);
  const double edge = static_cast<double>(std::max(width, height)) / squares;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto column = static_cast<long>((x + 0.5) / edge);
      const auto row = static_cast<long>((y + 0.5) / edge);
      for (int c = 0; c < 4; ++c)
        channel(image, x, y, c) = c == 3 || (column + row) % 2 == 0 ? 1.0F : 0.0F;
    }
  }
  return image;
}

Image test_card(int width, int height) {
  Image image = make_image(width, height);
  const double longer = std::max(width, height);
  const glm::dvec2 size(width, height);
  const double shorter = std::min(width, height);
  const double half = 0.16 * shorter;
  const auto in_quarter = [&](double x, double y) { return size * glm::dvec2(x, y); };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec2 p(x + 0.5, y + 0.5);
      glm::dvec3 color = ground(p, longer);
      zone_plate(color, p - in_quarter(0.21, 0.21), half);
      gratings(color, glm::floor(p - in_quarter(0.79, 0.21)), half);
      discs(color, p - in_quarter(0.21, 0.79), half);
      const glm::dvec2 paper = glm::abs(p - in_quarter(0.79, 0.79));
      if (std::max(paper.x, paper.y) < half)
        color = glm::dvec3(0.93, 0.91, 0.84);
      star(color, p - in_quarter(0.5, 0.5), 0.2 * shorter);
      for (int c = 0; c < 3; ++c)
        channel(image, x, y, c) = static_cast<float>(std::clamp(color[c], 0.0, 1.0));
      channel(image, x, y, 3) = 1;
    }
  }
  letter(image, static_cast<int>(0.79 * width - half), static_cast<int>(0.79 * height - half),
         static_cast<int>(0.79 * width + half), static_cast<int>(0.79 * height + half));
  return image;
}

} // namespace slicelens
