// `colon`: a winding tube of air with folds and polyps in fat, as CT colonography shows it (HU).
#include "volume/phantom_colon.h"

#include "volume/phantom_rows.h"
#include "volume/phantom_sdf.h"

#include <memory>
#include <numbers>

namespace slicelens {

using glm::dvec3;
using namespace sdf;

namespace colon {

namespace {

constexpr double kPi = std::numbers::pi;

/// Corner points of the centre line and the mean radius there.
struct Corner {
  dvec3 position;
  double radius;
};

constexpr Corner kCorners[] = {{{-104, -12, -92}, 32}, {{-108, -12, -62}, 31}, {{-114, -4, -12}, 28},
                               {{-112, 6, 48}, 26},    {{-92, 12, 92}, 24},    {{-58, -18, 84}, 23},
                               {{-12, -36, 56}, 23},   {{38, -30, 74}, 22},    {{80, 0, 112}, 21},
                               {{108, 24, 122}, 20},   {{117, 28, 78}, 19},    {{119, 24, 18}, 18},
                               {{113, 18, -42}, 17.5}, {{92, 6, -84}, 17},     {{56, -14, -88}, 17},
                               {{26, -30, -54}, 17},   {{-8, -14, -34}, 17},   {{-32, 14, -66}, 17},
                               {{-14, 36, -104}, 19},  {{0, 38, -138}, 22},    {{2, 34, -176}, 20}};
constexpr int kSteps = 24; ///< of the path between two corners

/// Cubic through the points b and c with the slopes of their neighbours (Catmull and Rom 1974).
template <class T>
T catmull_rom(const T& a, const T& b, const T& c, const T& d, double t) {
  return b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

/// Narrow ridges at whole numbers, 1 high.
double ridge(double x) {
  const double s = std::sin(kPi * x) / 0.3;
  return std::exp(-s * s);
}

} // namespace

std::vector<PathNode> path() {
  std::vector<PathNode> nodes;
  const int last = static_cast<int>(std::size(kCorners)) - 1;
  const auto corner = [&](int i) { return kCorners[std::clamp(i, 0, last)]; };
  for (int i = 0; i < last; ++i) {
    for (int k = 0; k < kSteps + (i + 1 == last ? 1 : 0); ++k) {
      const double t = k / static_cast<double>(kSteps);
      PathNode node;
      node.position = catmull_rom(corner(i - 1).position, corner(i).position, corner(i + 1).position,
                                  corner(i + 2).position, t);
      node.radius = corner(i).radius + (corner(i + 1).radius - corner(i).radius) * t;
      nodes.push_back(node);
    }
  }
  dvec3 normal(0, -1, 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const dvec3& before = nodes[i == 0 ? 0 : i - 1].position;
    const dvec3& after = nodes[std::min(i + 1, nodes.size() - 1)].position;
    const dvec3 tangent = glm::normalize(after - before);
    normal = glm::normalize(normal - tangent * glm::dot(normal, tangent));
    nodes[i].normal = normal;
    nodes[i].binormal = glm::cross(tangent, normal);
    if (i > 0)
      nodes[i].length = nodes[i - 1].length + glm::length(nodes[i].position - before);
  }
  return nodes;
}

double inner_radius(double length, double angle, double radius) {
  const double period = 1.15 * radius + 4;
  double fold = 0;
  double taenia = 0;
  for (int k = 0; k < 3; ++k) {
    // Each third of the wall has folds of its own, between those of its neighbours.
    const double across = std::cos(0.75 * std::remainder(angle - 2 * kPi * k / 3, 2 * kPi));
    const double share = across * across * across * across;
    fold = std::max(fold, share * ridge(length / period + k / 3.0));
    const double from_taenia = std::remainder(angle - 2 * kPi * (k + 0.5) / 3, 2 * kPi) / 0.16;
    taenia += std::exp(-from_taenia * from_taenia);
  }
  return radius * (1 - 0.34 * fold - 0.07 * taenia);
}

const std::vector<Polyp>& polyps() {
  static const std::vector<Polyp> list = {{.055, 2.0, 7, 0}, {.16, 4.6, 5, 0},   {.27, 1.2, 6.5, 9},
                                          {.37, 5.6, 4, 0},  {.46, 3.0, 8, 0},   {.58, 0.5, 5, 6},
                                          {.69, 4.1, 6, 0},  {.79, 2.4, 4.5, 0}, {.91, 5.2, 7, 6}};
  return list;
}

namespace {

/// A place on the wall and the unit vector from there to the path.
struct WallPoint {
  dvec3 position;
  dvec3 inward;
};

WallPoint wall_of(const Polyp& polyp, const std::vector<PathNode>& path) {
  const double length = polyp.fraction * path.back().length;
  std::size_t i = 0;
  while (i + 2 < path.size() && path[i + 1].length < length)
    ++i;
  const PathNode& node = path[i];
  const dvec3 outward = std::cos(polyp.angle) * node.normal + std::sin(polyp.angle) * node.binormal;
  return {node.position + outward * inner_radius(node.length, polyp.angle, node.radius), -outward};
}

} // namespace

dvec3 head_of(const Polyp& polyp, const std::vector<PathNode>& path) {
  const WallPoint wall = wall_of(polyp, path);
  return wall.position + wall.inward * (polyp.stalk > 0 ? polyp.stalk : 0.45 * polyp.radius);
}

namespace {

/// What the rows share.
struct Anatomy {
  std::vector<PathNode> path = colon::path();
  struct Bump {
    dvec3 wall;
    dvec3 head;
    double radius;
    double stalk;
  };
  std::vector<Bump> bumps;

  Anatomy() {
    for (const Polyp& polyp : polyps())
      bumps.push_back({wall_of(polyp, path).position, head_of(polyp, path), polyp.radius, polyp.stalk});
  }
};

/// Small bowel and appendix, which end in the caecum.
double side_tubes(const dvec3& p) {
  const dvec3 ileum[] = {{-24, -6, -98}, {-44, -18, -84}, {-62, -12, -72}, {-82, -8, -66}};
  double d = 1e9;
  for (int i = 0; i < 3; ++i)
    d = std::min(d, capsule(p, ileum[i], ileum[i + 1], kIleumRadius));
  const dvec3 appendix[] = {{-96, 2, -116}, {-84, 8, -134}, {-64, 10, -138}, {-52, 6, -128}};
  for (int i = 0; i < 3; ++i)
    d = std::min(d, capsule(p, appendix[i], appendix[i + 1], kAppendixRadius));
  return d;
}

/// Distance to the inside of the wall at the place of the path that is nearest to p.
double lumen_from(const PathNode& a, const PathNode& b, const dvec3& p) {
  const dvec3 ab = b.position - a.position;
  const double t = std::clamp(glm::dot(p - a.position, ab) / glm::dot(ab, ab), 0.0, 1.0);
  const dvec3 offset = p - a.position - ab * t;
  const double length = a.length + (b.length - a.length) * t;
  const double radius = a.radius + (b.radius - a.radius) * t;
  const double angle = std::atan2(glm::dot(offset, glm::mix(a.binormal, b.binormal, t)),
                                  glm::dot(offset, glm::mix(a.normal, b.normal, t)));
  const double inner = inner_radius(length, angle, radius);
  // To first order the distance to a wall that slopes by r′ is shorter by √(1 + r′²).
  const double slope = inner_radius(length + 0.5, angle, radius) - inner_radius(length - 0.5, angle, radius);
  return (glm::length(offset) - inner) / std::sqrt(1 + slope * slope);
}

/// Pieces of the path that can reach a row.
using Pieces = std::vector<std::size_t>;

Pieces pieces_near(const std::vector<PathNode>& path, double y, double z, double margin) {
  Pieces pieces;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const dvec3& a = path[i].position;
    const dvec3& b = path[i + 1].position;
    const double r = std::max(path[i].radius, path[i + 1].radius) + margin;
    if (std::min(a.y, b.y) - r < y && y < std::max(a.y, b.y) + r && std::min(a.z, b.z) - r < z &&
        z < std::max(a.z, b.z) + r)
      pieces.push_back(i);
  }
  return pieces;
}

double lumen(const std::vector<PathNode>& path, const Pieces& pieces, const dvec3& p, double margin) {
  double nearest = margin;
  std::size_t at = path.size();
  for (const std::size_t i : pieces) {
    const dvec3& a = path[i].position;
    if (std::abs(p.x - a.x) > path[i].radius + margin + 8)
      continue;
    const double d = capsule(p, a, path[i + 1].position, path[i].radius, path[i + 1].radius);
    if (d < nearest) {
      nearest = d;
      at = i;
    }
  }
  return at < path.size() ? lumen_from(path[at], path[at + 1], p) : nearest;
}

constexpr double kFat = -100;
constexpr double kWallValue = 40;
constexpr double kAir = -1000;
constexpr double kPolypValue = 90;

double value_at(const Anatomy& anatomy, const Pieces& pieces, const dvec3& p, double w) {
  const double margin = kWall + 2 * w;
  double d = pieces.empty() ? margin : lumen(anatomy.path, pieces, p, margin);
  d = blend(d, side_tubes(p), 3);
  double v = kFat;
  put(v, kWallValue, inside(d - kWall, w));
  put(v, kAir, inside(d, w));
  if (d > kWall / 2)
    return v;
  for (const Anatomy::Bump& bump : anatomy.bumps) {
    if (glm::length(p - bump.head) > bump.radius + bump.stalk + w + 4)
      continue;
    double polyp = glm::length(p - bump.head) - bump.radius;
    if (bump.stalk > 0)
      polyp = blend(polyp, capsule(p, bump.wall, bump.head, 2.6), 2);
    put(v, kPolypValue, inside(std::max(polyp, d - kWall / 2), w));
  }
  return v;
}

} // namespace

} // namespace colon

PhantomRows colon_rows() {
  const auto anatomy = std::make_shared<const colon::Anatomy>();
  return [anatomy](const PhantomGrid& grid, std::size_t j, std::size_t k, std::span<double> row) {
    const double w = 1.2 * std::max({grid.spacing(0), grid.spacing(1), grid.spacing(2)});
    dvec3 p = (dvec3(0, grid.texture(1, j), grid.texture(2, k)) - 0.5) * grid.edges;
    const colon::Pieces pieces = colon::pieces_near(anatomy->path, p.y, p.z, colon::kWall + 2 * w);
    for (std::size_t i = 0; i < row.size(); ++i) {
      p.x = (grid.texture(0, i) - 0.5) * grid.edges.x;
      row[i] = colon::value_at(*anatomy, pieces, p, w);
    }
  };
}

} // namespace slicelens
