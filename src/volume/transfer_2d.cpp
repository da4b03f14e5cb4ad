#include "volume/transfer_2d.h"

#include "core/errors.h"
#include "core/text.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

void check_corners(std::size_t index, const char* name, const glm::dvec4& corners, double least) {
  for (int i = 0; i < 4; ++i) {
    const bool rises = i == 0 || corners[i] >= corners[i - 1];
    if (!std::isfinite(corners[i]) || std::abs(corners[i]) > 1e38 || !rises || corners[i] < least) {
      throw UsageError("transfer.shapes[" + std::to_string(index) + "]." + name + ": number " +
                       std::to_string(i) + " is " + number_text(corners[i]) +
                       "; give four that do not decrease" + (least == 0 ? ", none below 0" : ""));
    }
  }
}

double trapezoid(const glm::dvec4& corners, double x) {
  if (!(x >= corners[0] && x <= corners[3])) // also NaN
    return 0;
  if (x < corners[1])
    return (x - corners[0]) / (corners[1] - corners[0]);
  if (x > corners[2])
    return (corners[3] - x) / (corners[3] - corners[2]);
  return 1;
}

} // namespace

void validate(const std::vector<TransferShape>& shapes) {
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const TransferShape& shape = shapes[i];
    check_corners(i, "value", shape.value, -1e38);
    check_corners(i, "gradient", shape.gradient, 0);
    const glm::dvec4 rgba(shape.color, shape.opacity);
    for (int c = 0; c < 4; ++c) {
      if (!(rgba[c] >= 0 && rgba[c] <= 1)) {
        throw UsageError("transfer.shapes[" + std::to_string(i) +
                         "]: colours and opacity must be in [0,1], not " + number_text(rgba[c]));
      }
    }
  }
}

glm::dvec4 evaluate(const std::vector<TransferShape>& shapes, double value, double gradient) {
  glm::dvec3 color(0);
  double sum = 0;
  for (const TransferShape& shape : shapes) {
    const double opacity =
        shape.opacity * trapezoid(shape.value, value) * trapezoid(shape.gradient, gradient);
    color += opacity * shape.color;
    sum += opacity;
  }
  if (sum <= 0)
    return glm::dvec4(0);
  return {color / sum, std::min(sum, 1.0)};
}

TransferTable2D make_table(const std::vector<TransferShape>& shapes, double low, double high) {
  TransferTable2D table;
  table.width = 1024;
  table.height = 512;
  double steepest = 0;
  for (const TransferShape& shape : shapes)
    steepest = std::max(steepest, shape.gradient[3]);
  table.first = {low, 0};
  table.last = {high > low ? high : low + 1, steepest > 0 ? steepest : 1};
  for (int j = 0; j < table.height; ++j) {
    for (int i = 0; i < table.width; ++i) {
      const glm::dvec2 at =
          glm::mix(table.first, table.last, glm::dvec2(i / (table.width - 1.0), j / (table.height - 1.0)));
      // Beyond the steepest shape there is nothing, which the clamped last row then says.
      const glm::dvec4 rgba = j + 1 == table.height ? glm::dvec4(0) : evaluate(shapes, at.x, at.y);
      for (int c = 0; c < 3; ++c)
        table.rgba.push_back(static_cast<float>(rgba[c] * rgba.a));
      table.rgba.push_back(static_cast<float>(rgba.a));
    }
  }
  return table;
}

} // namespace slicelens
