#include "warp/field.h"

#include "core/errors.h"
#include "warp/multilevel_bspline.h"

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

/// The field as a displacement of points in box space.
struct BoxField {
  const DisplacementField* field;
  glm::dmat4 index_from_world;
  glm::dmat4 world_from_box;
  glm::dmat3 turn; ///< box from world, directions and lengths

  glm::dvec3 operator()(const glm::dvec3& p) const {
    return turn * displacement_at(*field, index_from_world, glm::dvec3(world_from_box * glm::dvec4(p, 1)));
  }
};

BoxField box_field(const Field& field, const BoxSpace& space) {
  if (!field.loaded)
    throw UsageError("warp 'field': its file has not been read");
  return {field.loaded.get(), glm::inverse(field.loaded->world_from_index),
          glm::inverse(space.box_from_world), glm::dmat3(space.box_from_world)};
}

/// Whether any of the field's voxels lies in the volume's box, or any of a few points of the box in the
/// field.
bool overlaps(const DisplacementField& field, const BoxSpace& space) {
  const glm::dmat4 box_from_index = space.box_from_world * field.world_from_index;
  const glm::dmat4 index_from_box = glm::inverse(box_from_index);
  const glm::dvec3 last(field.dims[0] - 1, field.dims[1] - 1, field.dims[2] - 1);
  constexpr int n = 9;
  for (int point = 0; point < n * n * n; ++point) {
    const glm::dvec3 t = glm::dvec3(point % n, point / n % n, point / n / n) / (n - 1.0);
    const glm::dvec3 b(box_from_index * glm::dvec4(t * last, 1));
    if (glm::all(glm::greaterThanEqual(b, glm::dvec3(0))) && glm::all(glm::lessThanEqual(b, space.size)))
      return true;
    const glm::dvec3 i(index_from_box * glm::dvec4(t * space.size, 1));
    if (glm::all(glm::greaterThanEqual(i, glm::dvec3(-0.5))) && glm::all(glm::lessThanEqual(i, last + 0.5)))
      return true;
  }
  return false;
}

/// Bounds of the field's vectors and of zero, box space.
std::array<glm::dvec3, 2> displacement_bounds(const BoxField& displacement) {
  std::array<glm::dvec3, 2> bounds{glm::dvec3(0), glm::dvec3(0)};
  for (const glm::vec3& vector : displacement.field->vectors) {
    const glm::dvec3 d = displacement.turn * glm::dvec3(vector);
    bounds[0] = glm::min(bounds[0], d);
    bounds[1] = glm::max(bounds[1], d);
  }
  return bounds;
}

struct Domain {
  glm::dvec3 low;
  glm::dvec3 high;
};

/// p = u − D(p): the volume's box grown by the vectors, less what shows nothing.
Domain inverse_domain(const BoxField& displacement, const BoxSpace& space) {
  const auto bounds = displacement_bounds(displacement);
  Domain domain{-bounds[1], space.size - bounds[0]};
  tighten_bounds([&](const glm::dvec3& p) { return p + displacement(p); }, space.size, domain.low,
                 domain.high);
  return domain;
}

/// Points of the data with the points at which they are shown.
struct Pairs {
  std::vector<glm::dvec3> shown;
  std::vector<glm::dvec3> offsets; ///< x − d(x)
};

/// On a lattice over the volume's box.
Pairs forward_pairs(const BoxField& displacement, const BoxSpace& space) {
  constexpr int n = 33;
  Pairs pairs;
  for (int point = 0; point < n * n * n; ++point) {
    const glm::dvec3 x = space.size * glm::dvec3(point % n, point / n % n, point / n / n) / (n - 1.0);
    const glm::dvec3 d = displacement(x);
    pairs.shown.push_back(x + d);
    pairs.offsets.push_back(-d);
  }
  return pairs;
}

/// The point x near `start` with x + D(x) = p, or `start` where Newton's method comes no nearer to one.
glm::dvec3 refined(const BoxField& displacement, const glm::dvec3& p, const glm::dvec3& start) {
  const auto miss = [&](const glm::dvec3& x) { return x + displacement(x) - p; };
  glm::dvec3 x = start;
  glm::dvec3 left = miss(x);
  for (int step = 0; step < 30 && glm::length(left) > 1e-9; ++step) {
    constexpr double h = 1e-5;
    glm::dmat3 j;
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 e(0);
      e[axis] = h;
      j[axis] = (miss(x + e) - miss(x - e)) / (2 * h);
    }
    const glm::dvec3 full = std::abs(glm::determinant(j)) > 1e-6 ? glm::inverse(j) * left : left;
    double length = 1;
    while (length > 1e-3 && glm::length(miss(x - length * full)) >= glm::length(left))
      length *= 0.5;
    const glm::dvec3 next = x - length * full;
    const glm::dvec3 next_left = miss(next);
    if (glm::length(next_left) >= glm::length(left))
      break;
    x = next;
    left = next_left;
  }
  return x;
}

/// The scattered-data inverse of a forward field, and the box it is needed in.
struct ForwardInverse {
  MultilevelBSpline spline;
  Domain domain;
};

ForwardInverse scattered_inverse(const BoxField& displacement, const BoxSpace& space) {
  const Pairs pairs = forward_pairs(displacement, space);
  Domain domain{glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
  for (const glm::dvec3& p : pairs.shown) {
    domain.low = glm::min(domain.low, p);
    domain.high = glm::max(domain.high, p);
  }
  // 64 spans in the last of 6 levels would be finer than the pairs: 32 are as fine.
  return {fit_multilevel_bspline(pairs.shown, pairs.offsets, domain.low, domain.high, 6), domain};
}

/// What both kinds come to: the map on nodes over a domain.
struct FieldInverse {
  PointMap map;
  Domain domain;
};

FieldInverse inverse_of(const Field& field, const BoxField& displacement, const BoxSpace& space) {
  if (!overlaps(*field.loaded, space)) {
    throw UsageError("warp 'field': " + field.file +
                     " lies wholly beside the volume; it must be given in the volume's world space (LPS)");
  }
  if (field.direction == FieldDirection::inverse) {
    return {[displacement](const glm::dvec3& p) { return p + displacement(p); },
            inverse_domain(displacement, space)};
  }
  const auto scattered = std::make_shared<ForwardInverse>(scattered_inverse(displacement, space));
  return {[displacement, scattered](const glm::dvec3& p) {
            return refined(displacement, p, p + evaluate(scattered->spline, p));
          },
          scattered->domain};
}

GridMap grid_of(const Field& field, const FieldInverse& inverse) {
  const std::size_t n = field.resolution;
  return {std::make_shared<const MapGrid>(
      make_map_grid(inverse.map, {n, n, n}, inverse.domain.low, inverse.domain.high))};
}

struct Misses {
  double largest = 0;
  double squares = 0;
  std::size_t count = 0;

  void add(double miss) {
    largest = std::max(largest, miss);
    squares += miss * miss;
    ++count;
  }
  double rms() const { return count > 0 ? std::sqrt(squares / static_cast<double>(count)) : 0; }
};

bool in_data(const BoxSpace& space, const glm::dvec3& u) {
  return glm::all(glm::greaterThanEqual(u, glm::dvec3(0))) && glm::all(glm::lessThanEqual(u, space.size));
}

} // namespace

glm::dvec3 displacement_at(const DisplacementField& field, const glm::dmat4& index_from_world,
                           const glm::dvec3& world) {
  const glm::dvec3 x(index_from_world * glm::dvec4(world, 1));
  const glm::dvec3 last(field.dims[0] - 1, field.dims[1] - 1, field.dims[2] - 1);
  if (!glm::all(glm::greaterThanEqual(x, glm::dvec3(-0.5))) || !glm::all(glm::lessThanEqual(x, last + 0.5)))
    return glm::dvec3(0);
  const glm::dvec3 inside = glm::clamp(x, glm::dvec3(0), last);
  const glm::dvec3 first = glm::floor(glm::min(inside, glm::max(last - 1.0, glm::dvec3(0))));
  const glm::dvec3 f = inside - first;
  glm::dvec3 sum(0);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    const glm::dvec3 w = glm::mix(1.0 - f, f, step);
    const double weight = w.x * w.y * w.z;
    if (weight == 0)
      continue; // an axis of one voxel has no second node
    const glm::dvec3 node = first + step;
    const auto index = (static_cast<std::size_t>(node.z) * field.dims[1] + static_cast<std::size_t>(node.y)) *
                           field.dims[0] +
                       static_cast<std::size_t>(node.x);
    sum += weight * glm::dvec3(field.vectors[index]);
  }
  return sum;
}

void validate(const Field& field) {
  if (field.file.empty())
    throw UsageError("warp 'field': file is missing; name a file with three components a voxel");
  if (field.resolution < 8 || field.resolution > max_grid_nodes) {
    throw UsageError("warp 'field': resolution must be from 8 to " + std::to_string(max_grid_nodes) +
                     " nodes, not " + std::to_string(field.resolution));
  }
}

GridMap field_map(const Field& field, const BoxSpace& space) {
  return grid_of(field, inverse_of(field, box_field(field, space), space));
}

FieldReport field_report(const Field& field, const BoxSpace& space) {
  const BoxField displacement = box_field(field, space);
  const FieldInverse inverse = inverse_of(field, displacement, space);
  const GridMap grid = grid_of(field, inverse);
  FieldReport report;
  for (const glm::vec3& vector : field.loaded->vectors)
    report.largest_displacement =
        std::max(report.largest_displacement, static_cast<double>(glm::length(vector)));
  const bool forward = field.direction == FieldDirection::forward;
  const MultilevelBSpline spline =
      forward ? scattered_inverse(displacement, space).spline : MultilevelBSpline{};
  Misses held;
  Misses scattered;
  constexpr int n = 48; // points between the nodes
  const glm::dvec3 edges = inverse.domain.high - inverse.domain.low;
  for (int point = 0; point < n * n * n; ++point) {
    const glm::dvec3 at(point % n, point / n % n, point / n / n);
    const glm::dvec3 p = inverse.domain.low + (at + 0.5) / static_cast<double>(n) * edges;
    const glm::dvec3 u = texture_from_object(grid, p);
    if (!in_data(space, u))
      continue;
    held.add(space.longest * glm::length(forward ? u + displacement(u) - p : u - inverse.map(p)));
    if (!forward)
      continue;
    const glm::dvec3 first = p + evaluate(spline, p);
    scattered.add(space.longest * glm::length(first + displacement(first) - p));
  }
  (forward ? report.refined_largest : report.grid_largest) = held.largest;
  (forward ? report.refined_rms : report.grid_rms) = held.rms();
  report.scattered_largest = scattered.largest;
  report.scattered_rms = scattered.rms();
  report.smallest_determinant = smallest_determinant(*grid.grid);
  return report;
}

} // namespace slicelens
