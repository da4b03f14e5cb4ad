#include "render/occupancy.h"

#include "render/gpu_scene.h"
#include "volume/segment_table.h"
#include "volume/transfer_2d.h"

#include <algorithm>
#include <cmath>
#include <functional>
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

OpacitySums sums_of(const TransferTable& table) {
  std::vector<bool> opaque(table.rgba.size() / 4);
  for (std::size_t i = 0; i < opaque.size(); ++i)
    opaque[i] = table.rgba[4 * i + 3] > 0;
  return sums_of(table.first, table.last, opaque);
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
  return sums_of(drawn_table(prepared));
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

namespace {

constexpr double infinity = 1e300; // clamped to a table's ends, and no NaN by any product

/// Values [low, high] that show nothing.
struct Stretch {
  double low = -infinity;
  double high = infinity;
};

/// The longest stretches without opacity, in ascending order. Where the function jumps at a value, that value
/// shows.
std::vector<Stretch> blank_stretches(const TransferFunction& transfer) {
  const std::vector<TransferPoint>& points = transfer.points;
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].opacity > 0)
      continue;
    const bool goes_on = i > 0 && points[i - 1].opacity <= 0;
    const bool jumps_here = i > 0 && !goes_on && points[i - 1].value == points[i].value;
    const bool jumps_next =
        i + 1 < points.size() && points[i + 1].opacity > 0 && points[i + 1].value == points[i].value;
    if (!goes_on)
      stretches.push_back({i == 0 ? -infinity : points[i].value, points[i].value});
    if (jumps_here)
      stretches.back().low = std::nextafter(points[i].value, infinity);
    stretches.back().high = i + 1 == points.size() ? infinity
                            : jumps_next           ? std::nextafter(points[i].value, -infinity)
                                                   : points[i].value;
  }
  return stretches;
}

/// Where nothing shows, for modes and classifications that read no table of opacities.
std::vector<Stretch> blank_stretches(const PreparedScene& prepared) {
  if (prepared.scene.render.mode != Mode::iso)
    return blank_stretches(prepared.transfer);
  const double isovalue = isovalue_of(prepared);
  // The shader compares floats: a value that rounds to the isovalue counts as above.
  const double step = 1e-6 * std::abs(isovalue);
  return {{-infinity, isovalue - step}, {isovalue + step, infinity}};
}

/// By how much what is drawn may differ from the function: what segments are interpolated between.
double widened_by(const PreparedScene& prepared) {
  if (prepared.scene.render.classification != Classification::preintegrated)
    return 0;
  return (prepared.volume.max - prepared.volume.min) / static_cast<double>(kSegmentTexels - 1);
}

/// From a cell to the stretch that its values lie in, or `occupied`.
using StretchOf = std::function<std::uint8_t(std::size_t cell, double low, double high)>;
constexpr std::uint8_t occupied = 255;

StretchOf by_stretches(const PreparedScene& prepared) {
  const double margin = widened_by(prepared);
  return [margin, stretches = blank_stretches(prepared)](std::size_t, double low, double high) {
    // Numbers beyond 254 have no code; such cells are drawn.
    for (std::size_t i = 0; i < std::min<std::size_t>(stretches.size(), occupied); ++i) {
      if (stretches[i].low <= low - margin && high + margin <= stretches[i].high)
        return static_cast<std::uint8_t>(i);
    }
    return occupied;
  };
}

StretchOf by_labels(const PreparedScene& prepared) {
  const bool eight_bit = prepared.scene.render.transfer_texture == TransferTexture::rgba8;
  std::vector<OpacitySums> tables;
  LabelSet whole; // rows of which a run counts as one
  for (const LabelRow& row : prepared.labels.table) {
    tables.push_back(
        sums_of(make_table(row.transfer, eight_bit ? 256 : 0, prepared.volume.min, prepared.volume.max)));
    whole[tables.size() - 1] = row.mode != LabelMode::dvr && tables.back().sums.back() > 0;
  }
  return [tables, whole, &cells = prepared.labels.in_cells](std::size_t cell, double low, double high) {
    const LabelSet& rows = cells[cell];
    if ((rows & whole).any())
      return occupied;
    for (std::size_t row = 0; row < tables.size(); ++row) {
      if (rows[row] && any_opacity(tables[row], low, high))
        return occupied;
    }
    return std::uint8_t{0};
  };
}

StretchOf by_table(const PreparedScene& prepared) {
  const Mode mode = prepared.scene.render.mode;
  return [mode, table = opacity_sums(prepared)](std::size_t, double low, double high) {
    const bool shows =
        any_opacity(table, mode == Mode::mip ? -infinity : low, mode == Mode::minip ? infinity : high);
    return shows ? occupied : std::uint8_t{0};
  };
}

StretchOf stretch_of(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  if (render.mode == Mode::two_level)
    return by_labels(prepared);
  if (render.mode == Mode::iso || render.classification != Classification::post)
    return by_stretches(prepared);
  return by_table(prepared);
}

} // namespace

bool looks_between_samples(const RenderSettings& render) {
  return render.mode == Mode::iso || render.classification == Classification::preintegrated;
}

Occupancy occupancy_of(const PreparedScene& prepared) { return occupancy_of(prepared, *prepared.cells); }

Occupancy occupancy_of(const PreparedScene& prepared, const CellRanges& cells) {
  const StretchOf stretch = stretch_of(prepared);
  const double rounding = rounding_of(prepared);
  Occupancy result;
  result.size = cells.size;
  result.shows.resize(cells.smallest.size());
  result.stretches.resize(cells.smallest.size());
  for (std::size_t i = 0; i < result.shows.size(); ++i) {
    result.stretches[i] = stretch(i, static_cast<double>(cells.smallest[i]) - rounding,
                                  static_cast<double>(cells.largest[i]) + rounding);
    result.shows[i] = result.stretches[i] == occupied ? 1 : 0;
    result.count += result.shows[i];
  }
  return result;
}

namespace {

/// Slices whose samples, all as opaque as the transfer function gets, leave 1 − opaque_enough of the light.
double opaque_after(const PreparedScene& prepared) {
  double most = 0;
  if (!prepared.scene.transfer.shapes.empty() || prepared.scene.render.mode == Mode::two_level) {
    most = 1;
  } else {
    for (const TransferPoint& point : prepared.transfer.points)
      most = std::max(most, point.opacity);
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
