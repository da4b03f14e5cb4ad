#include "render/annotations.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace slicelens {

namespace {

/// sin 15°: how far a direction leans to its second axis before that is named.
constexpr double second_letter = 0.2588;

/// Share of the picture's width that a scale bar takes at most.
constexpr double scale_bar_share = 0.25;

Legend legend_of(const PreparedScene& volume) {
  const std::vector<TransferPoint>& points = volume.transfer.points;
  Legend legend;
  legend.low = points.front().value;
  legend.high = points.back().value;
  if (!(legend.low < legend.high)) {
    legend.low = std::min(legend.low, volume.volume.min);
    legend.high = std::max(legend.high, volume.volume.max);
  }
  const double least = 1e-6 * std::max(std::abs(legend.low), 1e-6); // what doubles and digits can tell apart
  if (!(legend.high - legend.low > least)) {
    legend.low -= std::max(0.5, least);
    legend.high += std::max(0.5, least);
  }
  legend.rgba = [&volume](double value) { return evaluate(volume.transfer, value); };
  return legend;
}

/// The unit of world space behind a number.
std::string unit_text(const PreparedScene& prepared) {
  const std::string& format = prepared.volume.format;
  const std::string known = format == "DICOM" || format == "NIfTI" ? "mm" : "";
  const std::string unit = prepared.scene.overlay.unit.value_or(known);
  return unit.empty() ? "" : " " + unit;
}

} // namespace

std::string orientation_letters(const glm::dvec3& direction) {
  constexpr std::array<std::array<char, 2>, 3> letters = {{{'R', 'L'}, {'A', 'P'}, {'I', 'S'}}};
  // Of equally near axes the first is taken: rounding must not decide.
  const auto nearest = [&](int without) {
    int best = without == 0 ? 1 : 0;
    for (int axis = best + 1; axis < 3; ++axis) {
      if (axis != without && std::abs(direction[axis]) > std::abs(direction[best]) + 1e-9)
        best = axis;
    }
    return best;
  };
  const auto letter = [&](int axis) {
    return letters[static_cast<std::size_t>(axis)][direction[axis] > 0 ? 1 : 0];
  };
  const int first = nearest(-1);
  const int second = nearest(first);
  std::string text(1, letter(first));
  if (std::abs(direction[second]) >= second_letter * glm::length(direction))
    text += letter(second);
  return text;
}

double pixel_size(const PreparedScene& prepared) {
  const View& view = prepared.view;
  const double size = 2 * view.half_height / view.height;
  if (view.projection == Projection::orthographic)
    return size;
  const glm::dvec3 focus = prepared.scene.camera.focal_point.value_or(center(box_of_all(prepared)));
  return size * depth(view, focus);
}

std::vector<Legend> legends_of(const PreparedScene& prepared) {
  std::vector<Legend> legends;
  for (std::size_t i = 0; i < volume_count(prepared); ++i) {
    legends.push_back(legend_of(volume_at(prepared, i)));
    legends.back().title =
        volume_count(prepared) > 1 ? "VOLUMES[" + std::to_string(i) + "]" : std::string("opacity");
  }
  return legends;
}

void draw_annotations(Image& image, const PreparedScene& prepared) {
  const OverlaySettings& overlay = prepared.scene.overlay;
  const View& view = prepared.view;
  const std::vector<Legend> legends = overlay.legend ? legends_of(prepared) : std::vector<Legend>{};
  draw_legends(image, legends);
  if (overlay.labels) {
    draw_edge_letters(image,
                      {orientation_letters(-view.right), orientation_letters(view.right),
                       orientation_letters(view.up), orientation_letters(-view.up)},
                      legends_width(image, legends));
  }
  if (overlay.scale_bar) {
    const double pixel = pixel_size(prepared);
    const double length = round_length(scale_bar_share * image.width * pixel);
    std::vector<std::string> text = {tick_text(length, length) + unit_text(prepared)};
    if (view.projection == Projection::perspective)
      text.emplace_back("focal plane");
    draw_scale_bar(image, length / pixel, text);
  }
}

} // namespace slicelens
