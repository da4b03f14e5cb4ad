#include "warp/landmarks.h"

#include "core/errors.h"
#include "core/text.h"
#include "warp/multilevel_bspline.h"
#include "warp/thin_plate_spline.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

[[noreturn]] void refuse(const std::string& problem) { throw UsageError("warp 'landmarks': " + problem); }

std::string point_text(const glm::dvec3& p) {
  return "[" + number_text(p.x) + ", " + number_text(p.y) + ", " + number_text(p.z) + "]";
}

/// Different pairs, apart.
struct Points {
  std::vector<glm::dvec3> source;
  std::vector<glm::dvec3> target;
  std::size_t duplicates = 0;
};

/// The longest edge of the points' bounds.
double reach(const std::vector<LandmarkPair>& pairs) {
  glm::dvec3 low(HUGE_VAL);
  glm::dvec3 high(-HUGE_VAL);
  for (const LandmarkPair& pair : pairs) {
    for (const glm::dvec3& p : pair) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const glm::dvec3 edges = high - low;
  return std::max({edges.x, edges.y, edges.z});
}

/// Leaves out pairs given twice and refuses those that contradict one another.
Points different_pairs(const std::vector<LandmarkPair>& pairs) {
  if (pairs.empty())
    refuse("there is not a single landmark; give at least one pair of points (four for method tps)");
  if (pairs.size() > max_landmarks)
    refuse(std::to_string(pairs.size()) + " landmarks; at most " + std::to_string(max_landmarks) +
           " can be interpolated");
  const double same = 1e-9 * reach(pairs);
  Points points;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    bool known = false;
    for (std::size_t j = 0; j < i && !known; ++j) {
      const bool sources = glm::length(pairs[i][0] - pairs[j][0]) <= same;
      const bool targets = glm::length(pairs[i][1] - pairs[j][1]) <= same;
      if (sources != targets) {
        refuse("landmarks " + std::to_string(j + 1) + " and " + std::to_string(i + 1) +
               " contradict one another: " +
               (sources ? "the source " + point_text(pairs[i][0]) + " has two targets"
                        : "the target " + point_text(pairs[i][1]) + " has two sources") +
               "; keep one of them");
      }
      known = sources;
    }
    if (known) {
      ++points.duplicates;
      continue;
    }
    points.source.push_back(pairs[i][0]);
    points.target.push_back(pairs[i][1]);
  }
  return points;
}

/// The dimensions that points span: 0 a point, 1 a line, 2 a plane, 3 space; within 1e-6 of their reach.
int spanned(const std::vector<glm::dvec3>& points) {
  std::vector<glm::dvec3> left;
  double scale = 0;
  for (const glm::dvec3& p : points) {
    left.push_back(p - points[0]);
    scale = std::max(scale, glm::length(left.back()));
  }
  for (int dimension = 0; dimension < 3; ++dimension) {
    const auto farthest =
        std::max_element(left.begin(), left.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
          return glm::length(a) < glm::length(b);
        });
    const double length = glm::length(*farthest);
    if (!(length > 1e-6 * scale))
      return dimension;
    const glm::dvec3 direction = *farthest / length;
    for (glm::dvec3& p : left)
      p -= glm::dot(p, direction) * direction;
  }
  return 3;
}

/// What determines the affine part of a thin-plate spline.
void require_space(const std::vector<glm::dvec3>& points, const char* which) {
  static const char* const words[] = {"are one point", "lie on one line", "lie in one plane"};
  const int dimensions = spanned(points);
  if (points.size() >= 4 && dimensions == 3)
    return;
  refuse("method tps needs at least 4 landmarks whose " + std::string(which) +
         "s do not lie in one plane; there " + (points.size() == 1 ? "is " : "are ") +
         std::to_string(points.size()) +
         (dimensions < 3 ? ", and they " + std::string(words[dimensions]) : "") +
         "; add landmarks off it or use method bspline");
}

const std::vector<LandmarkPair>* pairs_of(const Landmarks& landmarks) {
  if (landmarks.pairs)
    return &*landmarks.pairs;
  return landmarks.loaded.get();
}

Points checked_points(const Landmarks& landmarks) {
  const std::vector<LandmarkPair>* pairs = pairs_of(landmarks);
  if (pairs == nullptr)
    refuse("its files have not been read");
  Points points = different_pairs(*pairs);
  if (landmarks.method == LandmarkMethod::tps) {
    require_space(points.target, "target");
    require_space(points.source, "source");
  }
  return points;
}

glm::dvec3 box_point(const Landmarks& landmarks, const BoxSpace& space, const glm::dvec3& p) {
  return landmarks.space == LandmarkSpace::texture ? box_from_texture(space, p)
                                                   : glm::dvec3(space.box_from_world * glm::dvec4(p, 1));
}

/// The map before it is held on a grid, and a box that holds all that it shows.
struct Spline {
  PointMap map;
  GridFill fill; ///< where all nodes of a grid together are cheaper than one by one; else empty
  glm::dvec3 low;
  glm::dvec3 high;
};

/// Grows until nothing on the outermost cells shows data, twice the volume on each side at most.
Spline tps_map(const Landmarks& landmarks, const BoxSpace& space, const Points& points) {
  const auto spline = std::make_shared<ThinPlateSpline>(
      fit_thin_plate_spline(points.target, points.source, landmarks.stiffness));
  Spline result{[spline](const glm::dvec3& p) { return evaluate(*spline, p); }, {}, {}, {}};
  for (double margin = 0.5; margin <= 2; margin *= 2) {
    result.low = -margin * space.size;
    result.high = (1 + margin) * space.size;
    const glm::dvec3 low = result.low;
    const glm::dvec3 high = result.high;
    tighten_bounds(result.map, space.size, result.low, result.high);
    if (glm::all(glm::greaterThan(result.low, low)) && glm::all(glm::lessThan(result.high, high)))
      break;
  }
  return result;
}

/// p = u − offset: the volume is shown within its box grown by the offsets.
Spline bspline_map(const Landmarks& landmarks, const BoxSpace& space, const Points& points) {
  std::vector<glm::dvec3> offsets;
  glm::dvec3 low(0);
  glm::dvec3 high = space.size;
  for (std::size_t i = 0; i < points.target.size(); ++i) {
    offsets.push_back(points.source[i] - points.target[i]);
    low = glm::min(low, glm::min(-1.25 * offsets.back(), points.target[i]));
    high = glm::max(high, glm::max(space.size - 1.25 * offsets.back(), points.target[i]));
  }
  const auto spline = std::make_shared<MultilevelBSpline>(
      fit_multilevel_bspline(points.target, offsets, low, high, landmarks.levels));
  Spline result{[spline](const glm::dvec3& p) { return p + evaluate(*spline, p); },
                [spline](const auto& size, const glm::dvec3& from, const glm::dvec3& to) {
                  return evaluate_on_grid(*spline, size, from, to);
                },
                low, high};
  tighten_bounds(result.fill, space.size, result.low, result.high);
  return result;
}

Points points_in_box(const Landmarks& landmarks, const BoxSpace& space) {
  Points points = checked_points(landmarks);
  for (auto* list : {&points.source, &points.target}) {
    for (glm::dvec3& p : *list)
      p = box_point(landmarks, space, p);
  }
  return points;
}

Spline spline_of(const Landmarks& landmarks, const BoxSpace& space, const Points& points) {
  return landmarks.method == LandmarkMethod::tps ? tps_map(landmarks, space, points)
                                                 : bspline_map(landmarks, space, points);
}

GridMap grid_of(const Landmarks& landmarks, const Spline& spline) {
  const std::size_t n = landmarks.resolution;
  if (spline.fill)
    return {std::make_shared<const MapGrid>(make_map_grid(spline.fill, {n, n, n}, spline.low, spline.high))};
  return {std::make_shared<const MapGrid>(make_map_grid(spline.map, {n, n, n}, spline.low, spline.high))};
}

} // namespace

void validate(const Landmarks& landmarks) {
  const bool lists = landmarks.source || landmarks.target;
  const int given = (landmarks.file ? 1 : 0) + (lists ? 1 : 0) + (landmarks.pairs ? 1 : 0);
  if (given != 1 || landmarks.source.has_value() != landmarks.target.has_value())
    refuse("give its points by one of file, pairs, or source together with target");
  if (!(landmarks.stiffness >= 0 && landmarks.stiffness <= 1e6))
    refuse("stiffness must be from 0 to 1000000, not " + number_text(landmarks.stiffness));
  if (landmarks.stiffness > 0 && landmarks.method != LandmarkMethod::tps)
    refuse("stiffness belongs to method tps; for bspline take fewer levels");
  if (landmarks.levels < 1 || landmarks.levels > max_bspline_levels)
    refuse("levels must be from 1 to " + std::to_string(max_bspline_levels) + ", not " +
           std::to_string(landmarks.levels));
  if (landmarks.resolution < 8 || landmarks.resolution > max_grid_nodes)
    refuse("resolution must be from 8 to " + std::to_string(max_grid_nodes) + " nodes, not " +
           std::to_string(landmarks.resolution));
  if (pairs_of(landmarks) != nullptr)
    (void)checked_points(landmarks);
}

std::vector<LandmarkPair> landmarks_in_box(const Landmarks& landmarks, const BoxSpace& space) {
  const Points points = points_in_box(landmarks, space);
  std::vector<LandmarkPair> pairs;
  for (std::size_t i = 0; i < points.source.size(); ++i)
    pairs.push_back({points.source[i], points.target[i]});
  return pairs;
}

GridMap landmark_map(const Landmarks& landmarks, const BoxSpace& space) {
  return grid_of(landmarks, spline_of(landmarks, space, points_in_box(landmarks, space)));
}

LandmarkReport landmark_report(const Landmarks& landmarks, const BoxSpace& space) {
  const Points points = points_in_box(landmarks, space);
  const Spline spline = spline_of(landmarks, space, points);
  const GridMap grid = grid_of(landmarks, spline);
  LandmarkReport report;
  report.count = points.target.size();
  report.duplicates = points.duplicates;
  double squares = 0;
  double grid_squares = 0;
  for (std::size_t i = 0; i < report.count; ++i) {
    const double miss = space.longest * glm::length(spline.map(points.target[i]) - points.source[i]);
    const double held =
        space.longest * glm::length(texture_from_object(grid, points.target[i]) - points.source[i]);
    report.largest = std::max(report.largest, miss);
    report.grid_largest = std::max(report.grid_largest, held);
    squares += miss * miss;
    grid_squares += held * held;
  }
  report.rms = std::sqrt(squares / static_cast<double>(report.count));
  report.grid_rms = std::sqrt(grid_squares / static_cast<double>(report.count));
  report.smallest_determinant = smallest_determinant(*grid.grid);
  return report;
}

} // namespace slicelens
