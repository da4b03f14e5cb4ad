// `engine`: a two-cylinder block in the manner of the well-known CT of a cast part with steel inserts.
// Lengths in units of 1/256 of the longest edge, origin in the box centre: x, y in ±128, z in ±64.
#include "volume/phantom_rows.h"
#include "volume/phantom_sdf.h"

#include <numbers>

namespace slicelens {

namespace {

using glm::dvec2;
using glm::dvec3;
using namespace sdf;

constexpr double kAir = 8;
constexpr double kAluminium = 120;
constexpr double kCast = 150;
constexpr double kSteel = 225;

/// Distance to a coil spring about the z axis.
double spring(const dvec3& p, double radius, double wire, double pitch, double half) {
  const double angle = std::atan2(p.y, p.x) / (2 * std::numbers::pi);
  const double turn = p.z / pitch - angle;
  const double dz = (turn - std::round(turn)) * pitch;
  const double dr = glm::length(dvec2(p.x, p.y)) - radius;
  return std::max(glm::length(dvec2(dr, dz)) - wire, std::abs(p.z) - half);
}

/// Cylinder along y.
double cross_bore(const dvec3& p, double r, double half) { return cylinder({p.x, p.z, p.y}, r, half); }

/// The block: body, base flange, bosses and cooling fins, with all bores cut.
double block(const dvec3& p, const dvec3& m) {
  double d = box(p - dvec3(0, 0, -2), {88, 56, 46}, 8);
  d = blend(d, box(p - dvec3(0, 0, -46), {104, 74, 9}, 4), 5);                    // base flange
  d = blend(d, cylinder(m - dvec3(42, 0, 6), 42, 46), 4);                         // cylinder barrels
  d = blend(d, cross_bore(p - dvec3(0, -66, -8), 26, 28), 6);                     // inlet boss, to the front
  d = blend(d, cylinder(dvec3(p.z + 8, p.y, p.x) - dvec3(0, 0, -96), 16, 18), 5); // side boss
  const double fin = std::abs(p.z - 14 - 12 * std::clamp(std::round((p.z - 14) / 12), -2.0, 2.0)) - 2.2;
  d = std::min(d, std::max(box(p - dvec3(0, 18, 12), {100, 56, 34}, 6), fin));
  d = cut(d, cylinder(m - dvec3(42, 0, 0), 27, 200), 1.5); // cylinder bores
  const double jacket =
      std::max(std::abs(glm::length(dvec2(m.x - 42, m.y)) - 35.5) - 2.6, std::abs(p.z - 10) - 26);
  d = cut(d, jacket, 1.5);                                    // water jackets
  d = cut(d, cross_bore(p - dvec3(0, -70, -8), 16, 44), 1.5); // inlet
  d = cut(d, cylinder(dvec3(p.z + 8, p.y, p.x) - dvec3(0, 0, -96), 8, 34), 1.5);
  d = cut(d, cylinder({p.y, p.z + 30, p.x}, 7, 200), 1); // oil gallery along x
  const dvec3 corner(std::abs(p.x) - 92, std::abs(p.y) - 62, p.z);
  d = cut(d, cylinder(corner, 5.5, 200), 1); // flange bolt holes
  const dvec3 stud(std::abs(p.x) - 78, std::abs(p.y) - 46, p.z - 30);
  return cut(d, cylinder(stud, 3.6, 26), 0.8); // threaded holes
}

/// Cylinder liners, valve guides and the ring on the inlet: thin, dense parts.
double inserts(const dvec3& p, const dvec3& m) {
  const double r = glm::length(dvec2(m.x - 42, m.y));
  double d = std::max(std::abs(r - 28) - 1.6, std::abs(p.z - 2) - 50); // liners
  const double ring_z = std::abs(p.z - 12 * std::clamp(std::round(p.z / 12), -1.0, 1.0)) - 1.8;
  const dvec2 inlet(p.x, p.z + 8);
  d = std::min(d, std::max(std::abs(glm::length(inlet) - 15) - 1.4, std::abs(p.y + 78) - 14));
  // Valves: head, stem and spring in each cylinder, and a guide around the stem.
  const dvec3 q = m - dvec3(42, 0, 0);
  const double stem = cylinder(q - dvec3(0, 0, 10), 3.2, 48);
  const double disc = ellipsoid(q - dvec3(0, 0, -40), {19, 19, 4});
  d = std::min({d, blend(stem, disc, 8), spring(q - dvec3(0, 0, 34), 13, 2.2, 8.5, 20)});
  d = std::min(d, cylinder(q - dvec3(0, 0, 57), 15, 2.5));
  // Piston rings between spring and head.
  return std::min(d,
                  std::max({ring_z, std::abs(glm::length(dvec2(q.x, q.y)) - 23) - 2.2, p.z - 14, -p.z - 30}));
}

double bridge(const dvec3& m) {
  // A spider of three thin arms that holds the guide in the bore.
  const dvec3 q = m - dvec3(42, 0, 6);
  const double guide = std::max(glm::length(dvec2(q.x, q.y)) - 6.5, std::abs(q.z) - 10);
  const double angle = std::atan2(q.y, q.x);
  const double third = 2 * std::numbers::pi / 3;
  const double a = angle - third * std::round(angle / third);
  const double r = glm::length(dvec2(q.x, q.y));
  const double arm = std::max({std::abs(r * std::sin(a)) - 2, std::abs(q.z) - 5, r - 27, -r * std::cos(a)});
  return std::min(guide, arm);
}

} // namespace

PhantomRows engine_rows() {
  return [](const PhantomGrid& grid, std::size_t j, std::size_t k, std::span<double> row) {
    const dvec3 edges(256, 256, 128);
    const double w =
        std::max({edges.x / static_cast<double>(grid.dims[0]), edges.y / static_cast<double>(grid.dims[1]),
                  edges.z / static_cast<double>(grid.dims[2])});
    dvec3 p = (dvec3(0, grid.texture(1, j), grid.texture(2, k)) - 0.5) * edges;
    for (std::size_t i = 0; i < row.size(); ++i) {
      p.x = (grid.texture(0, i) - 0.5) * edges.x;
      const dvec3 m(std::abs(p.x), p.y, p.z);
      double v = kAir;
      put(v, kAluminium, inside(block(p, m), w));
      put(v, kCast, inside(bridge(m), w));
      put(v, kSteel, inside(inserts(p, m), w));
      row[i] = v;
    }
  };
}

} // namespace slicelens
