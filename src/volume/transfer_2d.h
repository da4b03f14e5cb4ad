// Transfer functions of value and gradient magnitude: colour and opacity as a sum of shapes in that plane
// (after Kniss, Kindlmann and Hansen 2002, whose widgets are such shapes).
#pragma once

#include <glm/glm.hpp>

#include <vector>

namespace slicelens {

/// A trapezoid along each axis, multiplied: 0 up to the first number, rising linearly to 1 at the second, 1
/// to the third, falling to 0 at the fourth. Numbers are non-decreasing; two equal ones make a step, whose
/// own place belongs to the inside.
struct TransferShape {
  glm::dvec4 value{0, 0, 1, 1};    ///< data units
  glm::dvec4 gradient{0, 0, 1, 1}; ///< data units per world unit, ≥ 0
  glm::dvec3 color{1};             ///< in [0,1], straight
  double opacity = 0.1;            ///< α per reference length Δ₀, in [0,1]

  bool operator==(const TransferShape&) const = default;
};

/// Throws UsageError naming the shape (from 0) for numbers that are not finite or decrease, gradients below
/// 0, and colours and opacities outside [0,1].
void validate(const std::vector<TransferShape>& shapes);

/// (r, g, b, opacity): opacities add up to at most 1, the colour is their weighted mean; black where nothing
/// is.
glm::dvec4 evaluate(const std::vector<TransferShape>& shapes, double value, double gradient);

/// Samples for a 2D float texture with linear filtering, clamped to the edge: texel (i, j) of width × height
/// has its centre at value first.x + (last.x − first.x)·i/(width − 1) and likewise for the gradient.
struct TransferTable2D {
  glm::dvec2 first{0}; ///< value, gradient
  glm::dvec2 last{1};
  int width = 2;
  int height = 2;
  std::vector<float> rgba; ///< associated, so that the filter does not mix in colours of nothing: row by row
};

/// The table over the data's range low to high and gradients from 0 to the shapes' largest; 1024 × 512
/// texels. `shapes` must be valid and not empty.
TransferTable2D make_table(const std::vector<TransferShape>& shapes, double low, double high);

} // namespace slicelens
