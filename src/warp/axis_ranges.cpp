#include "warp/axis_ranges.h"

#include "core/errors.h"
#include "core/text.h"

#include <cmath>

namespace slicelens {

void validate_inside(const AxisRanges& ranges, const std::string& what) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const glm::dvec2& range = ranges[axis];
    const std::string text = what + " on axis " + std::string(1, "xyz"[axis]) + ", [" + number_text(range.x) +
                             ", " + number_text(range.y) + "], ";
    if (!std::isfinite(range.x) || !std::isfinite(range.y))
      throw UsageError(text + "must be two finite numbers");
    if (range.x >= range.y)
      throw UsageError(text + "is empty or reversed; the first number must be the smaller one");
    if (range.x <= 0 || range.y >= 1) {
      throw UsageError(text + "must lie within the volume and touch no face: above 0 and below 1 (texture "
                              "coordinates)");
    }
  }
}

} // namespace slicelens
