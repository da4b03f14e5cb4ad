#include "volume/phantom_head.h"

#include <cmath>
#include <cstdint>

namespace slicelens::head {

using glm::dvec3;

namespace {

/// A fixed sequence in [−1, 1): the tree is the same on every machine.
struct Sequence {
  std::uint64_t state = 1;
  double next() {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state >> 33) / static_cast<double>(std::uint64_t{1} << 30) - 1;
  }
};

void add_path(std::vector<Vessel>& tree, const std::vector<dvec3>& points, double r0, double r1) {
  // Catmull-Rom through the points, four pieces each, so that arteries curve.
  const auto count = static_cast<double>(points.size() - 1);
  const auto at = [&](double s) {
    const auto last = static_cast<std::ptrdiff_t>(points.size()) - 1;
    const auto i = std::min<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(s), last - 1);
    const auto point = [&](std::ptrdiff_t k) {
      return points[static_cast<std::size_t>(std::min(std::max<std::ptrdiff_t>(k, 0), last))];
    };
    const double f = s - static_cast<double>(i);
    const dvec3 p0 = point(i - 1), p1 = point(i), p2 = point(i + 1), p3 = point(i + 2);
    return 0.5 * (2.0 * p1 + (p2 - p0) * f + (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) * f * f +
                  (3.0 * p1 - p0 - 3.0 * p2 + p3) * f * f * f);
  };
  const int pieces = 4 * static_cast<int>(points.size() - 1);
  for (int i = 0; i < pieces; ++i) {
    const double s0 = count * i / pieces;
    const double s1 = count * (i + 1) / pieces;
    tree.push_back({at(s0), at(s1), r0 + (r1 - r0) * s0 / count, r0 + (r1 - r0) * s1 / count});
  }
}

dvec3 cavity_normal(const dvec3& p) {
  const double e = 0.5;
  return glm::normalize(dvec3(cavity(p + dvec3(e, 0, 0)) - cavity(p - dvec3(e, 0, 0)),
                              cavity(p + dvec3(0, e, 0)) - cavity(p - dvec3(0, e, 0)),
                              cavity(p + dvec3(0, 0, e)) - cavity(p - dvec3(0, 0, e))));
}

/// Branches that wander over the brain's surface, some 4 mm under the skull.
void add_surface_branch(std::vector<Vessel>& tree, Sequence& random, dvec3 p, dvec3 direction, double r,
                        int steps, int generation) {
  for (int i = 0; i < steps && r > 0.45; ++i) {
    direction += 0.45 * dvec3(random.next(), random.next(), random.next());
    const dvec3 normal = cavity_normal(p);
    direction = glm::normalize(direction - glm::dot(direction, normal) * normal);
    dvec3 q = p + 7.0 * direction;
    q -= (cavity(q) + 4.5) * 0.7 * cavity_normal(q);
    tree.push_back({p, q, r, r * 0.96});
    p = q;
    r *= 0.96;
    if (i % 3 == 1 && generation > 0) {
      const dvec3 side = glm::cross(cavity_normal(p), direction) * (random.next() > 0 ? 1.0 : -1.0);
      add_surface_branch(tree, random, p, glm::normalize(direction + 0.9 * side), r * 0.78, steps - i,
                         generation - 1);
    }
  }
}

/// One side of the anterior circulation; s is +1 for the left, −1 for the right.
void add_carotid(std::vector<Vessel>& tree, double s) {
  const auto side = [s](double x, double y, double z) { return dvec3(s * x, y, z); };
  add_path(tree,
           {side(26, 12, -140), side(25, 8, -100), side(29, 4, -70), side(26, 8, -46), side(27, 8, -30),
            side(22, 4, -20), side(13, -2, -12), side(11, -10, -4), side(10, -17, 1), side(12, -11, 6),
            side(14, -9, 12)},
           3.4, 2.5);
  // Middle cerebral artery to the Sylvian fissure, anterior cerebral artery over the corpus callosum.
  add_path(tree, {side(14, -9, 12), side(26, -12, 13), side(38, -10, 14), side(48, -6, 18), side(57, 2, 24)},
           2.3, 1.7);
  add_path(tree,
           {side(14, -9, 12), side(7, -17, 14), side(2.5, -24, 18), side(2.2, -44, 30), side(2.2, -46, 46),
            side(2.2, -28, 58), side(2.2, 6, 64), side(2.2, 34, 60)},
           1.8, 1.0);
  add_path(tree, {side(12, -11, 8), side(9, -2, 8), side(7, 7, 7)}, 1.0, 1.0); // posterior communicating
  Sequence random{static_cast<std::uint64_t>(s > 0 ? 11 : 23)};
  const dvec3 sylvian = side(57, 2, 24);
  add_surface_branch(tree, random, sylvian, side(0, 0.3, 1), 1.5, 9, 2);
  add_surface_branch(tree, random, sylvian, side(0, 1, 0.25), 1.5, 10, 2);
  add_surface_branch(tree, random, sylvian, side(0, -0.9, 0.7), 1.3, 8, 2);
  // External carotid to the temple.
  add_path(tree,
           {side(25, 8, -100), side(38, 0, -76), side(56, 2, -50), side(68, 2, -20), side(77, -4, 8),
            side(80, -8, 30)},
           2.2, 1.0);
}

void add_vertebral(std::vector<Vessel>& tree, double s) {
  const auto side = [s](double x, double y, double z) { return dvec3(s * x, y, z); };
  add_path(tree,
           {side(21, 22, -140), side(21, 23, -90), side(22, 25, -60), side(24, 34, -46), side(13, 36, -40),
            side(7, 24, -30), side(0, 14, -20)},
           2.1, 1.7);
  add_path(tree, {side(0, 8, 6), side(10, 10, 7), side(20, 24, 9), side(20, 44, 12), side(14, 66, 18)}, 1.7,
           1.0);
  add_path(tree, {side(0, 13, -17), side(16, 22, -18), side(34, 40, -20), side(40, 56, -16)}, 1.1, 0.7);
  Sequence random{static_cast<std::uint64_t>(s > 0 ? 37 : 41)};
  add_surface_branch(tree, random, side(8, 84, 30), side(0.3, 0, 1), 1.0, 7, 1);
}

} // namespace

std::vector<Vessel> arteries() {
  std::vector<Vessel> tree;
  for (const double s : {1.0, -1.0}) {
    add_carotid(tree, s);
    add_vertebral(tree, s);
  }
  add_path(tree, {{0, 14, -20}, {0, 9, -12}, {0, 6, -2}, {0, 8, 6}}, 2.3, 2.1); // basilar
  add_path(tree, {{-2.5, -24, 18}, {0, -25, 18}, {2.5, -24, 18}}, 1.1, 1.1);    // anterior communicating
  tree.push_back({{15, -10, 12}, {18, -15, 14}, 3.0, 3.4});                     // the aneurysm's neck
  tree.push_back({kAneurysmCenter, kAneurysmCenter, kAneurysmRadius, kAneurysmRadius});
  return tree;
}

} // namespace slicelens::head
