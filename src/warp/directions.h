// Axes of the volume as scene files name them.
#pragma once

#include <glm/glm.hpp>

namespace slicelens {

enum class Axis { x, y, z };
/// An axis and a sense.
enum class Direction { x, y, z, minus_x, minus_y, minus_z };

inline int index_of(Axis axis) { return static_cast<int>(axis); }
inline int index_of(Direction direction) { return static_cast<int>(direction) % 3; }

inline glm::dvec3 unit_vector(Axis axis) {
  glm::dvec3 result(0);
  result[index_of(axis)] = 1;
  return result;
}
inline glm::dvec3 unit_vector(Direction direction) {
  glm::dvec3 result(0);
  result[index_of(direction)] = static_cast<int>(direction) < 3 ? 1 : -1;
  return result;
}

} // namespace slicelens
