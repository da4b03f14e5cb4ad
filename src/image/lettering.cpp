#include "image/lettering.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace slicelens {

namespace {

struct Glyph {
  char letter;
  std::string_view rows; ///< seven rows of five pixels, with a bar between rows
};

// clang-format off
constexpr Glyph glyphs[] = {
    {'A', ".###.|#...#|#...#|#####|#...#|#...#|#...#"},
    {'B', "####.|#...#|#...#|####.|#...#|#...#|####."},
    {'C', ".###.|#...#|#....|#....|#....|#...#|.###."},
    {'D', "####.|#...#|#...#|#...#|#...#|#...#|####."},
    {'E', "#####|#....|#....|####.|#....|#....|#####"},
    {'F', "#####|#....|#....|####.|#....|#....|#...."},
    {'G', ".###.|#...#|#....|#.###|#...#|#...#|.###."},
    {'H', "#...#|#...#|#...#|#####|#...#|#...#|#...#"},
    {'I', ".###.|..#..|..#..|..#..|..#..|..#..|.###."},
    {'J', "..###|...#.|...#.|...#.|...#.|#..#.|.##.."},
    {'K', "#...#|#..#.|#.#..|##...|#.#..|#..#.|#...#"},
    {'L', "#....|#....|#....|#....|#....|#....|#####"},
    {'M', "#...#|##.##|#.#.#|#.#.#|#...#|#...#|#...#"},
    {'N', "#...#|##..#|##..#|#.#.#|#..##|#..##|#...#"},
    {'O', ".###.|#...#|#...#|#...#|#...#|#...#|.###."},
    {'P', "####.|#...#|#...#|####.|#....|#....|#...."},
    {'Q', ".###.|#...#|#...#|#...#|#.#.#|#..#.|.##.#"},
    {'R', "####.|#...#|#...#|####.|#.#..|#..#.|#...#"},
    {'S', ".####|#....|#....|.###.|....#|....#|####."},
    {'T', "#####|..#..|..#..|..#..|..#..|..#..|..#.."},
    {'U', "#...#|#...#|#...#|#...#|#...#|#...#|.###."},
    {'V', "#...#|#...#|#...#|#...#|.#.#.|.#.#.|..#.."},
    {'W', "#...#|#...#|#...#|#.#.#|#.#.#|##.##|#...#"},
    {'X', "#...#|#...#|.#.#.|..#..|.#.#.|#...#|#...#"},
    {'Y', "#...#|#...#|.#.#.|..#..|..#..|..#..|..#.."},
    {'Z', "#####|....#|...#.|..#..|.#...|#....|#####"},
    {'0', ".###.|#...#|#..##|#.#.#|##..#|#...#|.###."},
    {'1', "..#..|.##..|..#..|..#..|..#..|..#..|.###."},
    {'2', ".###.|#...#|....#|..##.|.#...|#....|#####"},
    {'3', "####.|....#|....#|.###.|....#|....#|####."},
    {'4', "...#.|..##.|.#.#.|#..#.|#####|...#.|...#."},
    {'5', "#####|#....|####.|....#|....#|#...#|.###."},
    {'6', ".###.|#....|#....|####.|#...#|#...#|.###."},
    {'7', "#####|....#|...#.|...#.|..#..|..#..|..#.."},
    {'8', ".###.|#...#|#...#|.###.|#...#|#...#|.###."},
    {'9', ".###.|#...#|#...#|.####|....#|....#|.###."},
    {' ', ".....|.....|.....|.....|.....|.....|....."},
    {'.', ".....|.....|.....|.....|.....|.##..|.##.."},
    {',', ".....|.....|.....|.....|.##..|..#..|.#..."},
    {':', ".....|.##..|.##..|.....|.##..|.##..|....."},
    {'-', ".....|.....|.....|.###.|.....|.....|....."},
    {'+', ".....|..#..|..#..|#####|..#..|..#..|....."},
    {'=', ".....|.....|#####|.....|#####|.....|....."},
    {'_', ".....|.....|.....|.....|.....|.....|#####"},
    {'/', "....#|...#.|...#.|..#..|.#...|.#...|#...."},
    {'(', "...#.|..#..|.#...|.#...|.#...|..#..|...#."},
    {')', ".#...|..#..|...#.|...#.|...#.|..#..|.#..."},
    {'[', ".###.|.#...|.#...|.#...|.#...|.#...|.###."},
    {']', ".###.|...#.|...#.|...#.|...#.|...#.|.###."},
    {'%', "##..#|##.#.|...#.|..#..|.#...|.#.##|#..##"},
    {'<', "...#.|..#..|.#...|#....|.#...|..#..|...#."},
    {'>', ".#...|..#..|...#.|....#|...#.|..#..|.#..."},
    {'*', ".....|#.#.#|.###.|#####|.###.|#.#.#|....."},
    {'!', "..#..|..#..|..#..|..#..|..#..|.....|..#.."},
    {'?', ".###.|#...#|....#|...#.|..#..|.....|..#.."},
    {'\'', "..#..|..#..|.....|.....|.....|.....|....."},
    {'|', "..#..|..#..|..#..|..#..|..#..|..#..|..#.."},
};
// clang-format on

constexpr std::string_view unknown = "#####|#...#|#...#|#...#|#...#|#...#|#####";

std::string_view rows_of(char letter) {
  const auto capital = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  const auto* found = std::find_if(std::begin(glyphs), std::end(glyphs),
                                   [&](const Glyph& glyph) { return glyph.letter == capital; });
  return found == std::end(glyphs) ? unknown : found->rows;
}

/// Dots of the small m.
constexpr std::string_view small_m = ".....|.....|##.#.|#.#.#|#.#.#|#.#.#|#.#.#";

/// A byte that continues a UTF-8 character and so takes no place of its own.
bool continues(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

} // namespace

int text_width(const std::string& text) {
  const auto letters = std::count_if(text.begin(), text.end(), [](char byte) { return !continues(byte); });
  return std::max(0, static_cast<int>(letters) * letter_advance - 1);
}

void draw_text(Image& image, int x, int y, const std::string& text, const glm::vec3& color) {
  int left = x;
  for (const char letter : text) {
    if (continues(letter))
      continue;
    const std::string_view rows = rows_of(letter);
    for (int row = 0; row < letter_height; ++row) {
      for (int column = 0; column < letter_advance - 1; ++column) {
        const int px = left + column;
        const int py = y + row;
        if (rows[static_cast<std::size_t>(row * letter_advance + column)] != '#' || px < 0 ||
            px >= image.width || py < 0 || py >= image.height)
          continue;
        for (int c = 0; c < 3; ++c)
          channel(image, px, py, c) = color[c];
        channel(image, px, py, 3) = 1;
      }
    }
    left += letter_advance;
  }
}

namespace {

/// Mean of the colours in a part of the picture, over black.
double mean_brightness(const Image& image, int left, int top, int right, int bottom) {
  double sum = 0;
  int count = 0;
  for (int y = std::max(0, top); y < std::min(image.height, bottom); ++y) {
    for (int x = std::max(0, left); x < std::min(image.width, right); ++x) {
      for (int c = 0; c < 3; ++c)
        sum += static_cast<double>(channel(image, x, y, c)) / 3;
      ++count;
    }
  }
  return count > 0 ? sum / count : 0;
}

/// Brightness from which dark letters read better than light ones.
constexpr double bright = 0.7;

} // namespace

void draw_outlined_text(Image& image, int x, int y, const std::string& text, int scale) {
  const bool dark =
      mean_brightness(image, x, y, x + scale * text_width(text), y + scale * letter_height) > bright;
  const auto draw_dots = [&](int grow, float value) {
    int left = x;
    for (const char letter : text) {
      if (continues(letter))
        continue;
      const std::string_view rows = letter == 'm' ? small_m : rows_of(letter);
      for (int dot = 0; dot < letter_height * letter_advance - 1; ++dot) {
        if (rows[static_cast<std::size_t>(dot)] != '#')
          continue;
        const int px = left + dot % letter_advance * scale;
        const int py = y + dot / letter_advance * scale;
        for (int row = std::max(0, py - grow); row < std::min(image.height, py + scale + grow); ++row) {
          for (int column = std::max(0, px - grow); column < std::min(image.width, px + scale + grow);
               ++column) {
            for (int c = 0; c < 4; ++c)
              channel(image, column, row, c) = c < 3 ? value : 1;
          }
        }
      }
      left += letter_advance * scale;
    }
  };
  draw_dots(std::max(1, scale / 2), dark ? 1.0F : 0.0F);
  draw_dots(0, dark ? 0.0F : 1.0F);
}

} // namespace slicelens
