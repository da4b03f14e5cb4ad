#include "volume/segment_table.h"

#include "core/errors.h"
#include "core/text.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace slicelens {

namespace {

/// Cells between neighbouring texels.
constexpr std::size_t cells_between = 8;

/// Extinction of a reference length.
double extinction(double opacity) { return opacity < 1 ? -std::log1p(-opacity) : -std::log(1e-30); }

/// Three points of Gauss and Legendre on [0, 1].
constexpr std::array<double, 3> gauss_place = {0.112701665379258311, 0.5, 0.887298334620741689};
constexpr std::array<double, 3> gauss_weight = {5.0 / 18, 8.0 / 18, 5.0 / 18};

/// Mean extinction where the opacity goes linearly from a to b.
double mean_extinction(double a, double b) {
  const double x = std::max(1 - a, 1e-30);
  const double y = std::max(1 - b, 1e-30);
  if (std::abs(x - y) > 0.02 * std::min(x, y)) // ∫ −ln x dx = x − x ln x
    return ((x - x * std::log(x)) - (y - y * std::log(y))) / (x - y);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    sum += gauss_weight[i] * extinction(a + gauss_place[i] * (b - a));
  return sum;
}

/// A short range of values: ∫τ over it, in units of the cell, and the colour weighted by τ.
struct Cell {
  double depth = 0;
  glm::dvec3 color{0};
};

/// The function on [a, b] from its linear pieces.
Cell cell_of(const TransferFunction& transfer, double a, double b) {
  Cell cell;
  double weight = 0;
  glm::dvec3 color(0);
  const auto add_piece = [&](double from, double to, const glm::dvec4& start, const glm::dvec4& end) {
    const double share = (to - from) / (b - a);
    cell.depth += share * mean_extinction(start.a, end.a);
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec4 rgba = glm::mix(start, end, gauss_place[i]);
      const double w = share * gauss_weight[i] * extinction(rgba.a);
      weight += w;
      color += w * glm::dvec3(rgba);
    }
  };
  const auto& points = transfer.points;
  const auto rgba_of = [&](std::size_t k) {
    return glm::dvec4(points[k].r, points[k].g, points[k].b, points[k].opacity);
  };
  if (a < points.front().value)
    add_piece(a, std::min(b, points.front().value), rgba_of(0), rgba_of(0));
  const auto above = std::upper_bound(points.begin(), points.end(), a,
                                      [](double v, const TransferPoint& p) { return v < p.value; });
  for (auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - points.begin(), 1));
       k < points.size() && points[k - 1].value < b; ++k) {
    const double low = points[k - 1].value;
    const double width = points[k].value - low;
    const double from = std::max(a, low);
    const double to = std::min(b, points[k].value);
    if (to > from)
      add_piece(from, to, glm::mix(rgba_of(k - 1), rgba_of(k), (from - low) / width),
                glm::mix(rgba_of(k - 1), rgba_of(k), (to - low) / width));
  }
  if (b > points.back().value)
    add_piece(std::max(a, points.back().value), b, rgba_of(points.size() - 1), rgba_of(points.size() - 1));
  cell.color = weight > 0 ? color / weight : glm::dvec3(evaluate(transfer, (a + b) / 2));
  return cell;
}

/// Part of a segment: associated colour, opacity, and what goes through. The last two are kept apart so that
/// neither is lost beside 1.
struct Slab {
  glm::dvec3 color{0};
  double opacity = 0;
  double through = 1;
};

Slab over(const Slab& front, const Slab& back) {
  return {front.color + front.through * back.color, front.opacity + front.through * back.opacity,
          front.through * back.through};
}

/// Writes all segments of d texels. Windows over runs of cells of one length are composited with two
/// compositions each (van Herk 1992): every block of that length is scanned from its start and from its end.
class Diagonal {
public:
  Diagonal(SegmentTable& table, const std::vector<Cell>& cells, double ratio, std::size_t d)
      : table_(table), length_(d * cells_between), distance_(d), slabs_(cells.size()),
        from_start_(cells.size()), to_end_(cells.size()) {
    for (std::size_t m = 0; m < cells.size(); ++m) {
      const double depth = ratio * cells[m].depth / static_cast<double>(length_);
      const double opacity = -std::expm1(-depth);
      slabs_[m] = {opacity * cells[m].color, opacity, std::exp(-depth)};
    }
  }

  /// `forward`: from lower values in front to higher ones behind.
  void write(bool forward) {
    const auto join = [&](const Slab& lower, const Slab& higher) {
      return forward ? over(lower, higher) : over(higher, lower);
    };
    const std::size_t count = slabs_.size();
    for (std::size_t m = 0; m < count; ++m)
      from_start_[m] = m % length_ == 0 ? slabs_[m] : join(from_start_[m - 1], slabs_[m]);
    for (std::size_t m = count; m-- > 0;)
      to_end_[m] = m + 1 == count || (m + 1) % length_ == 0 ? slabs_[m] : join(slabs_[m], to_end_[m + 1]);
    for (std::size_t i = 0; i + distance_ < table_.texels; ++i) {
      const std::size_t begin = i * cells_between;
      const Slab& last = from_start_[begin + length_ - 1];
      const Slab whole = begin % length_ == 0 ? last : join(to_end_[begin], last);
      const std::size_t front = forward ? i : i + distance_;
      const std::size_t back = forward ? i + distance_ : i;
      float* texel = table_.rgba.data() + 4 * (back * table_.texels + front);
      for (int c = 0; c < 3; ++c)
        texel[c] = static_cast<float>(whole.color[c]);
      texel[3] = static_cast<float>(whole.opacity);
    }
  }

private:
  SegmentTable& table_;
  std::size_t length_;
  std::size_t distance_;
  std::vector<Slab> slabs_;
  std::vector<Slab> from_start_;
  std::vector<Slab> to_end_;
};

/// Segments of one value.
void write_constant(SegmentTable& table, const TransferFunction& transfer, double ratio) {
  for (std::size_t i = 0; i < table.texels; ++i) {
    const double f = static_cast<double>(i) / static_cast<double>(table.texels - 1);
    const glm::dvec4 rgba = evaluate(transfer, table.first * (1 - f) + table.last * f);
    const double opacity = -std::expm1(-ratio * extinction(rgba.a));
    float* texel = table.rgba.data() + 4 * (i * table.texels + i);
    for (int c = 0; c < 3; ++c)
      texel[c] = static_cast<float>(opacity * rgba[c]);
    texel[3] = static_cast<float>(opacity);
  }
}

} // namespace

SegmentTable make_segment_table(const TransferFunction& transfer, double low, double high, double ratio,
                                std::size_t texels) {
  validate(transfer);
  if (!(ratio > 0) || !std::isfinite(ratio))
    throw UsageError("a segment's length must be positive and finite, not " + number_text(ratio));
  if (texels < 2 || texels > 4096)
    throw UsageError("a table of segments takes from 2 to 4096 texels, not " + std::to_string(texels));
  SegmentTable table;
  table.texels = texels;
  table.first = low;
  table.last = high;
  if (!(high > low)) { // one value
    const double half = 1e-3 * std::max(std::abs(low), 1.0);
    table.first = low - half;
    table.last = low + half;
  }
  table.rgba.resize(4 * texels * texels);
  std::vector<Cell> cells((texels - 1) * cells_between);
  const double step = (table.last - table.first) / static_cast<double>(cells.size());
  tbb::parallel_for(std::size_t{0}, cells.size(), [&](std::size_t m) {
    const double a = table.first + static_cast<double>(m) * step;
    cells[m] = cell_of(transfer, a, table.first + static_cast<double>(m + 1) * step);
  });
  write_constant(table, transfer, ratio);
  tbb::parallel_for(std::size_t{1}, texels, [&](std::size_t d) {
    Diagonal diagonal(table, cells, ratio, d);
    diagonal.write(true);
    diagonal.write(false);
  });
  return table;
}

glm::dvec4 evaluate(const SegmentTable& table, double front, double back) {
  const auto last = static_cast<double>(table.texels - 1);
  const auto place = [&](double value) {
    return std::clamp((value - table.first) / (table.last - table.first), 0.0, 1.0) * last;
  };
  const double x = place(front);
  const double y = place(back);
  const auto i = static_cast<std::size_t>(std::min(std::floor(x), last - 1));
  const auto j = static_cast<std::size_t>(std::min(std::floor(y), last - 1));
  const auto at = [&](std::size_t column, std::size_t row) {
    const float* texel = table.rgba.data() + 4 * (row * table.texels + column);
    return glm::dvec4(texel[0], texel[1], texel[2], texel[3]);
  };
  const double fx = x - static_cast<double>(i);
  const double fy = y - static_cast<double>(j);
  return glm::mix(glm::mix(at(i, j), at(i + 1, j), fx), glm::mix(at(i, j + 1), at(i + 1, j + 1), fx), fy);
}

} // namespace slicelens
