// What a convex polygon leaves around a square inside it.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace slicelens {

/// Corners of the square |x| ≤ 1, |y| ≤ 1, counter-clockwise.
inline constexpr std::array<glm::dvec2, 4> square_corners = {glm::dvec2(1, 1), glm::dvec2(-1, 1),
                                                             glm::dvec2(-1, -1), glm::dvec2(1, -1)};

/// The convex `polygon` (either sense) around the square of half edge `half` about 0, in four convex parts:
/// one for each of the square's edges, between its corners and those of the polygon that lie farthest in
/// their directions. A part lists corners counter-clockwise: 0 to 3 are the square's, 4 + i the polygon's.
/// Empty where a part would not be convex, as when the square lies across the outline or near it.
std::vector<std::vector<std::size_t>> frame_around_square(const std::vector<glm::dvec2>& polygon,
                                                          double half);

} // namespace slicelens
