#include "render/bricks.h"

#include "core/errors.h"
#include "render/level_function.h"
#include "render/pages.h"
#include "tess/lens_footprint.h"
#include "volume/pyramid.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

std::string triple(const std::array<std::size_t, 3>& n) {
  return "[" + std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]) + "]";
}

void check_fits(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  const auto& dims = prepared.volume.dims;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (render.tiles[axis] > 1 && render.tiles[axis] > dims[axis] / min_tile_voxels) {
      throw UsageError("render.tiles " + triple(render.tiles) + " cuts the volume's " + triple(dims) +
                       " voxels into tiles of fewer than " + std::to_string(min_tile_voxels) +
                       " on an axis; take at most " +
                       std::to_string(std::max<std::size_t>(1, dims[axis] / min_tile_voxels)) + " there");
    }
  }
  const std::size_t longest = std::max({dims[0], dims[1], dims[2]});
  if (prepared.levels > 1 && (longest >> (prepared.levels - 1)) == 0) {
    throw UsageError("render.levels " + std::to_string(prepared.levels) + " is more than the volume's " +
                     triple(dims) + " voxels have; its coarsest level would hold less than one voxel");
  }
}

/// A part of the volume in voxel units, x = N·t: voxel i has its centre at i + ½.
struct Part {
  glm::dvec3 low;
  glm::dvec3 high;
};

Brick brick_of(const PreparedScene& prepared, const Part& part, std::size_t level) {
  const RenderSettings& render = prepared.scene.render;
  const auto dims = level_dims(prepared.volume.dims, level);
  const double edge = std::ldexp(1, static_cast<int>(level)); // voxels of level 0 in one of this level
  // Steps of the gradient follow the level blended to, at most the next coarser one: two voxels of this.
  const double step = !uses_gradients(prepared.scene) ? 0 : level + 1 < prepared.levels ? 2 : 1;
  const double filter = render.filter == Filter::cubic ? 1 : 0; // beyond the voxels of linear interpolation
  const double below = (render.gradient == Gradient::central ? step : 0) + filter;
  const double above = step + filter;
  Brick brick;
  brick.level = level;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int a = static_cast<int>(axis);
    const double last_voxel = static_cast<double>(dims[axis] - 1);
    const double first = std::clamp(std::floor(part.low[a] / edge - 0.5 - below), 0.0, last_voxel);
    const double last = std::clamp(std::ceil(part.high[a] / edge - 0.5 + above), first, last_voxel);
    brick.first[axis] = static_cast<std::size_t>(first);
    brick.size[axis] = static_cast<std::size_t>(last - first) + 1;
    const double size = static_cast<double>(brick.size[axis]);
    brick.scale[a] = static_cast<double>(prepared.volume.dims[axis]) / (edge * size);
    brick.offset[a] = -first / size;
  }
  return brick;
}

/// What of the tile is seen at a level finer than the coarsest, as one box; empty (low > high) for nothing.
Part seen_at(const PreparedScene& prepared, const Part& tile, std::size_t level) {
  const auto& dims = prepared.volume.dims;
  const glm::dvec3 n(dims[0], dims[1], dims[2]);
  LevelFunction function;
  const double q = function.magnification_of(static_cast<double>(level) + 1,
                                             static_cast<double>(prepared.levels - 1), prepared.log_zoom);
  Part seen{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (const LensTessellation& lens : prepared.lenses) {
    const auto box = magnified_data(lens, prepared.space, std::max(1.0, q));
    if (!box)
      continue;
    // A voxel of margin for the rounding of the GPU's coordinates.
    const glm::dvec3 low = glm::max(tile.low, box->low * n - 1.0);
    const glm::dvec3 high = glm::min(tile.high, box->high * n + 1.0);
    if (glm::any(glm::greaterThan(low, high)))
      continue;
    seen.low = glm::min(seen.low, low);
    seen.high = glm::max(seen.high, high);
  }
  return seen;
}

/// The boundaries of tiles on one axis in voxel units, outer ones included.
std::vector<double> boundaries(std::size_t voxels, std::size_t tiles) {
  std::vector<double> result = {0};
  for (std::size_t i = 1; i < tiles; ++i)
    result.push_back(static_cast<double>(voxels * i / tiles) + 0.5);
  result.push_back(static_cast<double>(voxels));
  return result;
}

} // namespace

bool is_bricked(const PreparedScene& prepared) {
  const RenderSettings& render = prepared.scene.render;
  const bool asked = prepared.levels > 1 || render.tiles[0] > 1 || render.tiles[1] > 1 || render.tiles[2] > 1;
  return asked && !is_paged(prepared);
}

std::optional<Bounds> finer_level_data(const PreparedScene& prepared, std::size_t level) {
  if (level + 1 >= prepared.levels || prepared.scene.render.footprint == Footprint::mip)
    return std::nullopt;
  const auto& dims = prepared.volume.dims;
  const glm::dvec3 n(dims[0], dims[1], dims[2]);
  const Part seen = seen_at(prepared, {glm::dvec3(0), n}, level);
  return Bounds{seen.low / n, seen.high / n};
}

BrickPlan plan_bricks(const PreparedScene& prepared) {
  check_fits(prepared);
  const RenderSettings& render = prepared.scene.render;
  BrickPlan plan;
  plan.levels = prepared.levels;
  std::array<std::vector<double>, 3> at;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    at[axis] = boundaries(prepared.volume.dims[axis], render.tiles[axis]);
    for (std::size_t i = 1; i + 1 < at[axis].size(); ++i)
      plan.cuts.planes[axis].push_back(at[axis][i] / static_cast<double>(prepared.volume.dims[axis]));
  }
  for (std::size_t z = 0; z < render.tiles[2]; ++z) {
    for (std::size_t y = 0; y < render.tiles[1]; ++y) {
      for (std::size_t x = 0; x < render.tiles[0]; ++x) {
        const Part tile{{at[0][x], at[1][y], at[2][z]}, {at[0][x + 1], at[1][y + 1], at[2][z + 1]}};
        plan.bricks.push_back(brick_of(prepared, tile, prepared.levels - 1));
        std::vector<std::size_t> of_level(prepared.levels, plan.bricks.size() - 1);
        for (std::size_t level = 0; level + 1 < prepared.levels; ++level) {
          const bool anywhere = render.footprint == Footprint::mip; // fragments and rays look at any level
          const Part seen = anywhere ? tile : seen_at(prepared, tile, level);
          if (seen.low.x > seen.high.x)
            continue;
          of_level[level] = plan.bricks.size();
          plan.bricks.push_back(brick_of(prepared, seen, level));
        }
        plan.of_tile.push_back(std::move(of_level));
      }
    }
  }
  return plan;
}

std::size_t brick_voxels(const BrickPlan& plan) {
  std::size_t sum = 0;
  for (const Brick& brick : plan.bricks) {
    Volume size;
    size.dims = brick.size;
    const std::size_t voxels = voxel_count(size);
    if (voxels > SIZE_MAX - sum)
      throw LimitError("render.tiles and render.levels hold more voxels than this machine can address");
    sum += voxels;
  }
  return sum;
}

double level_of(double q, double coarsest, double log_zoom) {
  return LevelFunction().level_of(q, coarsest, log_zoom);
}

} // namespace slicelens
