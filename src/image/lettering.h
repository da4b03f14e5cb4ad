// Small capital letters for captions and scales in pictures about pictures.
#pragma once

#include "image/image.h"

#include <glm/glm.hpp>

#include <string>

namespace slicelens {

/// Height of a letter, and the distance from one letter's left edge to the next one's, in pixels.
inline constexpr int letter_height = 7;
inline constexpr int letter_advance = 6;

/// Pixels that `text` is wide: without the gap behind the last letter.
int text_width(const std::string& text);

/// Writes `text` (UTF-8) in opaque `color` with its top left corner at column x, row y; what lies outside the
/// picture is cut off. Letters are 5×7 pixels; small letters show as capitals, letters that are not in the
/// set (ASCII without some signs) as an empty box.
void draw_text(Image& image, int x, int y, const std::string& text, const glm::vec3& color);

/// The same in white, each dot of a letter `scale` × `scale` pixels, in a black outline of half as many (at
/// least one); black in white where the picture is bright. A small m stays small: a unit of length is not a
/// million.
void draw_outlined_text(Image& image, int x, int y, const std::string& text, int scale);

} // namespace slicelens
