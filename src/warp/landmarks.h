// The warp that landmarks define: its parameters, their limits, its map and how well that hits them.
#pragma once

#include "warp/box_space.h"
#include "warp/map_grid.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// A point of the undeformed data and where it is shown.
using LandmarkPair = std::array<glm::dvec3, 2>;

enum class LandmarkSpace { world, texture };
enum class LandmarkMethod { tps, bspline };

/// Carries points of the data to where targets say (Brunet, Nowak and Gleicher 2006 §4.2). Exactly one of
/// `file`, `source` with `target`, and `pairs` is given.
struct Landmarks {
  std::optional<std::string> file = std::nullopt;   ///< pairs
  std::optional<std::string> source = std::nullopt; ///< a list of points
  std::optional<std::string> target = std::nullopt; ///< the list of where they are shown, in the same order
  std::optional<std::vector<LandmarkPair>> pairs = std::nullopt;
  LandmarkSpace space = LandmarkSpace::world; ///< of the points: world (LPS), or texture coordinates
  LandmarkMethod method = LandmarkMethod::tps;
  double stiffness = 0;        ///< tps: 0 hits every landmark; a length, as a fraction of the longest edge
  std::size_t levels = 6;      ///< bspline: the last has 2^(levels − 1) spans
  std::size_t resolution = 64; ///< nodes on each axis of the grid that all pipelines look the map up in

  std::shared_ptr<const std::vector<LandmarkPair>> loaded = nullptr; ///< what the files hold; no key
  std::string sha256 = {}; ///< of the files as they were read; no key

  bool operator==(const Landmarks&) const = default;
};

inline constexpr std::size_t max_landmarks = 2000; ///< a system of so many equations is solved

/// Throws UsageError naming the key: no points or two kinds of them, numbers beyond their limits, and lists
/// of points that determine no map (see landmark_map) as far as they are there already.
void validate(const Landmarks& landmarks);

/// The different pairs in box space. Throws UsageError as landmark_map does.
std::vector<LandmarkPair> landmarks_in_box(const Landmarks& landmarks, const BoxSpace& space);

/// The inverse map with u(target) = source, held on a grid of `resolution`³ nodes over the box in which the
/// volume is shown. Pairs given twice count once. Throws UsageError saying which landmarks are at fault:
/// equal targets with different sources, or equal sources with different targets (contradictory); for tps
/// fewer than four, or all in one plane, on one line or in one point.
GridMap landmark_map(const Landmarks& landmarks, const BoxSpace& space);

/// Distances |u(target) − source|, world units.
struct LandmarkReport {
  std::size_t count = 0;      ///< different pairs
  std::size_t duplicates = 0; ///< pairs given again
  double largest = 0;         ///< of the spline
  double rms = 0;
  double grid_largest = 0; ///< of the grid that is drawn
  double grid_rms = 0;
  double smallest_determinant = 1; ///< of the grid's derivative: at 0 or below the map folds
};

LandmarkReport landmark_report(const Landmarks& landmarks, const BoxSpace& space);

} // namespace slicelens
