#include "render/occupancy.h"

#include "render/gpu_scene.h"
#include "volume/transfer_2d.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slicelens {

namespace {

/// How many of the first n texels of a transfer function's table have opacity.
struct OpacitySums {
  double first = 0; ///< value of texel 0
  double last = 1;  ///< value of the last texel
  std::vector<std::uint32_t> sums;
};

OpacitySums sums_of(double first, double last, const std::vector<bool>& opaque) {
  OpacitySums result{first, last, {0}};
  for (const bool texel : opaque)
    result.sums.push_back(result.sums.back() + (texel ? 1 : 0));
  return result;
}

/// Of the table that the GPU reads. One of value and gradient counts as opaque where any gradient is.
OpacitySums opacity_sums(const PreparedScene& prepared) {
  const Volume& volume = prepared.volume;
  if (!prepared.scene.transfer.shapes.empty()) {
    const TransferTable2D table = make_table(prepared.scene.transfer.shapes, volume.min, volume.max);
    const auto width = static_cast<std::size_t>(table.width);
    std::vector<bool> opaque(width, false);
    for (std::size_t i = 0; i < table.rgba.size() / 4; ++i)
      opaque[i % width] = opaque[i % width] || table.rgba[4 * i + 3] > 0;
    return sums_of(table.first.x, table.last.x, opaque);
  }
  const TransferTable table = drawn_table(prepared);
  std::vector<bool> opaque(table.rgba.size() / 4);
  for (std::size_t i = 0; i < opaque.size(); ++i)
    opaque[i] = table.rgba[4 * i + 3] > 0;
  return sums_of(table.first, table.last, opaque);
}

/// Whether a linearly filtered look-up at any value of [low, high] may read an opaque texel. A hundredth of a
/// texel allows for how drivers round coordinates.
bool any_opacity(const OpacitySums& table, double low, double high) {
  const auto count = static_cast<double>(table.sums.size() - 1);
  const double scale = (count - 1) / (table.last - table.first);
  const double from = std::floor((low - table.first) * scale - 0.01);
  const double to = std::ceil((high - table.first) * scale + 0.01);
  const auto begin = static_cast<std::size_t>(std::clamp(from, 0.0, count - 1));
  const auto end = static_cast<std::size_t>(std::clamp(to, 0.0, count - 1));
  return table.sums[end + 1] > table.sums[begin];
}

/// By how much the volume's texture may change a value: a code of its coding, and what floats round by.
double rounding_of(const PreparedScene& prepared) {
  const Volume& volume = prepared.volume;
  const double largest = std::max(std::abs(volume.min), std::abs(volume.max));
  const VolumeTexture format = chosen_texture(prepared.scene.render.volume_texture, volume.type);
  const double codes = format == VolumeTexture::r8    ? 255
                       : format == VolumeTexture::r16 ? 65535
                                                      : std::numeric_limits<double>::infinity();
  return (volume.max - volume.min) / codes + 1e-6 * largest;
}

} // namespace

Occupancy occupancy_of(const PreparedScene& prepared) { return occupancy_of(prepared, *prepared.cells); }

Occupancy occupancy_of(const PreparedScene& prepared, const CellRanges& cells) {
  const OpacitySums table = opacity_sums(prepared);
  const Mode mode = prepared.scene.render.mode;
  const double rounding = rounding_of(prepared);
  constexpr double infinity = 1e300; // clamped to the table's ends, and no NaN by any product
  Occupancy result;
  result.size = cells.size;
  result.shows.resize(cells.smallest.size());
  for (std::size_t i = 0; i < result.shows.size(); ++i) {
    const double low = mode == Mode::mip ? -infinity : static_cast<double>(cells.smallest[i]) - rounding;
    const double high = mode == Mode::minip ? infinity : static_cast<double>(cells.largest[i]) + rounding;
    result.shows[i] = any_opacity(table, low, high) ? 1 : 0;
    result.count += result.shows[i];
  }
  return result;
}

namespace {

/// Slices whose samples, all as opaque as the transfer function gets, leave 1 − opaque_enough of the light.
double opaque_after(const PreparedScene& prepared) {
  double most = 0;
  if (prepared.scene.transfer.shapes.empty()) {
    const TransferTable table = drawn_table(prepared);
    for (std::size_t i = 3; i < table.rgba.size(); i += 4)
      most = std::max(most, static_cast<double>(table.rgba[i]));
  } else {
    most = 1;
  }
  // An 8-bit table rounds, and rays towards the picture's corners are the longest.
  most = std::min(1.0, most + 1.0 / 255);
  const View& view = prepared.view;
  const double ratio = correction_of(prepared) == Correction::none ? 1 : axis_distance_ratio(prepared);
  const double longest =
      view.projection == Projection::perspective ? std::hypot(1.0, half_width(view), view.half_height) : 1;
  const double extinction = -std::log1p(-most) * ratio * longest;
  return -std::log(1 - opaque_enough) / extinction;
}

} // namespace

Skipping skipping_of(const PreparedScene& prepared) {
  const Occupancy occupancy = occupancy_of(prepared);
  Skipping skipping;
  skipping.empty =
      static_cast<double>(occupancy.count) <= too_many_occupied * static_cast<double>(occupancy.shows.size());
  if (prepared.scene.render.skip == Skip::empty_and_hidden)
    skipping.opaque_after = opaque_after(prepared);
  return skipping;
}

CellBox cell_box(const PreparedScene& prepared, const CellRanges& cells, std::size_t index) {
  const auto& size = cells.size;
  const auto& dims = prepared.volume.dims;
  const glm::dvec3 edge = static_cast<double>(cells.edge) / glm::dvec3(dims[0], dims[1], dims[2]);
  const glm::dvec3 at(index % size[0], index / size[0] % size[1], index / size[0] / size[1]);
  return {at * edge, glm::min((at + 1.0) * edge, glm::dvec3(1))};
}

} // namespace slicelens
