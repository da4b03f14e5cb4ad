#include "warp/shown_bounds.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>

namespace slicelens {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Bounds nothing() { return {glm::dvec3(infinity), glm::dvec3(-infinity)}; }

bool is_nothing(const Bounds& bounds) { return glm::any(glm::greaterThan(bounds.low, bounds.high)); }

Bounds joined(const Bounds& a, const Bounds& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

Bounds common(const Bounds& a, const Bounds& b) { return {glm::max(a.low, b.low), glm::min(a.high, b.high)}; }

bool holds(const Bounds& outer, const Bounds& inner) {
  return glm::all(glm::lessThan(outer.low, inner.low)) && glm::all(glm::lessThan(inner.high, outer.high));
}

/// The box of the lens, beyond which nothing moves, and within it only into it.
template <class Map>
Bounds lens_box(const Map& map) {
  return {map.size * (map.center - map.outer), map.size * (map.center + map.outer)};
}

template <class Map>
Bounds magnified(const Map& map, const Bounds& box) {
  const VolumeLensMap lens{map.size, map.center, map.inner, map.outer, map.magnification};
  return {magnified_from_texture(lens, box.low), magnified_from_texture(lens, box.high)};
}

/// Axes are stretched one by one, and none runs backwards.
template <class Map>
Bounds stretched(const Map& map, const Bounds& box) {
  return {object_from_texture(map, box.low), object_from_texture(map, box.high)};
}

Bounds bounds_of(const BifocalMap& map, const Bounds& box) { return stretched(map, box); }
Bounds bounds_of(const FisheyeMap& map, const Bounds& box) { return stretched(map, box); }

Bounds bounds_of(const VolumeLensMap& map, const Bounds& box) {
  const Bounds lens = lens_box(map);
  const Bounds part = common(box, lens);
  if (is_nothing(part))
    return box;
  const Bounds shown = magnified(map, part);
  return holds(lens, box) ? shown : joined(box, shown);
}

/// With weights from 0 to 1 a point is shown between where it is and where the lens without them shows it;
/// within the focus region all weights are 1.
Bounds bounds_of(const ConnectedLensMap& map, const Bounds& box) {
  const Bounds lens = lens_box(map);
  const Bounds part = common(box, lens);
  if (is_nothing(part))
    return box;
  const Bounds shown = magnified(map, part);
  const Bounds focus{map.size * (map.center - map.inner), map.size * (map.center + map.inner)};
  const Bounds both = joined(box, shown);
  return holds(focus, both) ? shown : both;
}

Bounds bounds_of(const LamarMap& map, const Bounds& box) {
  const Bounds footprint = footprint_bounds(map);
  return is_nothing(common(box, footprint)) ? box : joined(box, footprint);
}

/// The cells of a grid, or blocks of them, by what they show, and eight by eight what these show together.
class GridIndex {
public:
  explicit GridIndex(const MapGrid& grid) : low_(grid.low) {
    Level first;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cells_[axis] = grid.size[axis] - 1;
      block_[axis] = (cells_[axis] + most_blocks - 1) / most_blocks;
      first.size[axis] = (cells_[axis] + block_[axis] - 1) / block_[axis];
    }
    edge_ = (node_position(grid, 1, 1, 1) - grid.low) * glm::dvec3(block_[0], block_[1], block_[2]);
    first.parts.resize(first.size[0] * first.size[1] * first.size[2]);
    tbb::parallel_for(std::size_t{0}, first.size[1] * first.size[2], [&](std::size_t row) {
      for (std::size_t i = 0; i < first.size[0]; ++i) {
        const Index at = {i, row % first.size[1], row / first.size[1]};
        first.parts[row * first.size[0] + i] = part_of_block(grid, at);
      }
    });
    levels_.push_back(std::move(first));
    while (levels_.back().parts.size() > 1)
      levels_.push_back(level_above(levels_.back()));
  }

  Bounds shown(const Bounds& box) const {
    Bounds result = nothing();
    include_shown(levels_.size() - 1, {0, 0, 0}, box, result);
    return result;
  }

private:
  using Index = std::array<std::size_t, 3>;
  static constexpr std::size_t most_blocks = 64; ///< on an axis: some 20 MB at most

  struct Part {
    Bounds data = nothing();               ///< that it shows
    glm::vec3 least = glm::vec3(infinity); ///< u − p
    glm::vec3 most = glm::vec3(-infinity);
  };
  struct Level {
    Index size{1, 1, 1};
    std::vector<Part> parts;
  };

  static void include(Part& whole, const Part& part) {
    whole.data = joined(whole.data, part.data);
    whole.least = glm::min(whole.least, part.least);
    whole.most = glm::max(whole.most, part.most);
  }

  Part part_of_block(const MapGrid& grid, const Index& block) const {
    Part whole;
    Index first;
    Index end;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first[axis] = block[axis] * block_[axis];
      end[axis] = std::min(first[axis] + block_[axis], cells_[axis]);
    }
    for (std::size_t k = first[2]; k < end[2]; ++k) {
      for (std::size_t j = first[1]; j < end[1]; ++j) {
        for (std::size_t i = first[0]; i < end[0]; ++i)
          include(whole, part_of_cell(grid, {i, j, k}));
      }
    }
    return whole;
  }

  Part part_of_cell(const MapGrid& grid, const Index& cell) const {
    Part part;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Index node = {cell[0] + (corner & 1), cell[1] + (corner >> 1 & 1), cell[2] + (corner >> 2)};
      const glm::vec3 offset(grid.offsets[(node[2] * grid.size[1] + node[1]) * grid.size[0] + node[0]]);
      const glm::dvec3 u = node_position(grid, node[0], node[1], node[2]) + glm::dvec3(offset);
      include(part, {{u, u}, offset, offset});
    }
    // Drivers may round the weights between nodes to 8 bits.
    const glm::dvec3 rounding = glm::dvec3(part.most - part.least) / 256.0;
    part.data = {part.data.low - rounding, part.data.high + rounding};
    // Beyond the grid displacements are those of its faces.
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (cell[a] == 0)
        part.data.low[axis] = -infinity;
      if (cell[a] + 1 == cells_[a])
        part.data.high[axis] = infinity;
    }
    return part;
  }

  static Level level_above(const Level& level) {
    Level above;
    for (std::size_t axis = 0; axis < 3; ++axis)
      above.size[axis] = (level.size[axis] + 1) / 2;
    above.parts.resize(above.size[0] * above.size[1] * above.size[2]);
    for (std::size_t i = 0; i < level.parts.size(); ++i) {
      const std::size_t x = i % level.size[0] / 2;
      const std::size_t y = i / level.size[0] % level.size[1] / 2;
      const std::size_t z = i / level.size[0] / level.size[1] / 2;
      include(above.parts[(z * above.size[1] + y) * above.size[0] + x], level.parts[i]);
    }
    return above;
  }

  /// Where part `at` of a level is, to infinity at the grid's faces.
  Bounds place(std::size_t level, const Index& at) const {
    const glm::dvec3 index(at[0], at[1], at[2]);
    const glm::dvec3 last =
        glm::dvec3(levels_[level].size[0], levels_[level].size[1], levels_[level].size[2]) - 1.0;
    const glm::dvec3 edge = edge_ * static_cast<double>(std::size_t{1} << level);
    return {glm::mix(low_ + index * edge, glm::dvec3(-infinity), glm::equal(index, glm::dvec3(0))),
            glm::mix(low_ + (index + 1.0) * edge, glm::dvec3(infinity), glm::equal(index, last))};
  }

  /// Adds where a part shows the box: p = u − (u − p).
  void include_shown(std::size_t level, const Index& at, const Bounds& box, Bounds& result) const {
    const Level& own = levels_[level];
    const Part& part = own.parts[(at[2] * own.size[1] + at[1]) * own.size[0] + at[0]];
    if (is_nothing(common(part.data, box)))
      return;
    const Bounds here =
        common(place(level, at), {box.low - glm::dvec3(part.most), box.high - glm::dvec3(part.least)});
    if (is_nothing(here) || (glm::all(glm::lessThanEqual(result.low, here.low)) &&
                             glm::all(glm::lessThanEqual(here.high, result.high))))
      return;
    if (level == 0) {
      result = joined(result, here);
      return;
    }
    const Index& finer = levels_[level - 1].size;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Index child = {2 * at[0] + (corner & 1), 2 * at[1] + (corner >> 1 & 1),
                           2 * at[2] + (corner >> 2)};
      if (child[0] < finer[0] && child[1] < finer[1] && child[2] < finer[2])
        include_shown(level - 1, child, box, result);
    }
  }

  glm::dvec3 low_;
  glm::dvec3 edge_{1}; ///< of a block
  Index cells_{1, 1, 1};
  Index block_{1, 1, 1}; ///< cells along the edges of a block
  std::vector<Level> levels_;
};

Bounds bounds_of(const GridMap& map, const Bounds& box) { return GridIndex(*map.grid).shown(box); }

std::optional<Bounds> unless_nothing(const Bounds& bounds) {
  return is_nothing(bounds) ? std::nullopt : std::optional<Bounds>(bounds);
}

} // namespace

std::optional<Bounds> shown_bounds(const WarpMap& map, const Bounds& box) {
  return std::visit(
      [&](const auto& value) -> std::optional<Bounds> {
        if constexpr (requires { bounds_of(value, box); })
          return unless_nothing(bounds_of(value, box));
        else
          return object_bounds(map, box);
      },
      map);
}

ShownBounds shown_bounds_of(const std::vector<WarpMap>& maps) {
  std::vector<ShownBounds> steps;
  for (const WarpMap& map : maps) {
    if (const auto* grid = std::get_if<GridMap>(&map)) {
      const auto index = std::make_shared<const GridIndex>(*grid->grid);
      steps.push_back([index](const Bounds& box) { return unless_nothing(index->shown(box)); });
    } else {
      steps.push_back([map](const Bounds& box) { return shown_bounds(map, box); });
    }
  }
  return [steps](const Bounds& box) -> std::optional<Bounds> {
    std::optional<Bounds> shown = box;
    for (const ShownBounds& step : steps) {
      if (shown)
        shown = step(*shown);
    }
    return shown;
  };
}

} // namespace slicelens
