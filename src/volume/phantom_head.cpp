// `head` and `head-mr`: one anatomy (phantom_head.h), two tables of tissue values; `head-arteries`: their
// arteries alone.
#include "volume/phantom_head.h"

#include "volume/phantom_rows.h"
#include "volume/phantom_sdf.h"

#include <memory>
#include <vector>

namespace slicelens {

namespace {

using glm::dvec3;
using namespace sdf;

/// Values of the tissues.
struct Tissues {
  double air, skin, fat, muscle, cortical, spongy, tooth, mucosa, fluid, grey, white, blood, vitreous, lens;
};

/// Hounsfield units; blood with contrast agent.
constexpr Tissues kCt{-1000, 60, -95, 52, 1250, 420, 2300, 35, 8, 39, 28, 330, 12, 85};

/// T1-weighted with contrast agent: fat and marrow bright, cortical bone, air and fluid dark.
constexpr Tissues kMr{4, 420, 820, 340, 35, 560, 20, 470, 130, 500, 690, 960, 110, 280};

/// What is needed of the arteries in one row of voxels.
using Vessels = std::vector<head::Vessel>;

void select_row(const Vessels& tree, double y, double z, double margin, Vessels& row) {
  row.clear();
  for (const head::Vessel& v : tree) {
    const double r = std::max(v.ra, v.rb) + margin;
    if (std::min(v.a.y, v.b.y) - r < y && y < std::max(v.a.y, v.b.y) + r && std::min(v.a.z, v.b.z) - r < z &&
        z < std::max(v.a.z, v.b.z) + r)
      row.push_back(v);
  }
}

double vessel_distance(const Vessels& vessels, const dvec3& p) {
  double d = 1e3;
  for (const head::Vessel& v : vessels) {
    const double r = std::max(v.ra, v.rb);
    if (p.x < std::min(v.a.x, v.b.x) - r - 6 || p.x > std::max(v.a.x, v.b.x) + r + 6)
      continue;
    d = std::min(d, v.a == v.b ? glm::length(p - v.a) - v.ra : capsule(p, v.a, v.b, v.ra, v.rb));
  }
  return d;
}

/// Windings of the cortex: |folds| is small on the sulci. A gyroid with a slow warp, so that it does not
/// repeat.
double folds(const dvec3& p, double wavelength) {
  const double k = 6.2831853 / wavelength;
  const dvec3 q = k * p + 1.3 * glm::sin(0.55 * k * dvec3(p.y, p.z, p.x) + dvec3(0.3, 1.1, 2.3));
  const dvec3 s = glm::sin(q);
  const dvec3 c = glm::cos(q);
  return s.x * c.y + s.y * c.z + s.z * c.x;
}

/// Everything inside the dura, painted over `v`. `depth` > 0 is the distance from the cavity's wall.
void put_brain(double& v, const dvec3& p, double depth, double w, const Tissues& t) {
  put(v, t.fluid, inside(-depth, w));
  const double surface = depth - 2.5;
  if (surface < -w)
    return;
  // The tentorium: the brain keeps a millimetre off it on both sides.
  const double below = ellipsoid(p - dvec3(0, 50, -8), {48, 37, 27});
  const bool cerebellum = below < 0;
  double sulcus = std::abs(below) - 0.9; // distance to the nearest sulcus or fissure
  double cortex = 3.2;
  if (cerebellum) {
    cortex = 1.6;
    if (surface < 16)
      sulcus = std::min(sulcus, std::abs(std::sin(0.9 * (p.z + 0.3 * p.y))) * 2.2 - 0.4 +
                                    0.3 * std::max(0.0, surface - 8));
  } else {
    if (surface < 22)
      sulcus = std::min(sulcus, std::abs(folds(p, 30)) * 3.9 - 0.9 + 0.3 * std::max(0.0, surface - 9));
    // Between the hemispheres, as far as the corpus callosum.
    const double callosum = glm::length(glm::dvec2((p.y - 6) / 42, (p.z - 18) / 34)) * 36 - 36;
    sulcus = std::min(sulcus, std::max({std::abs(p.x) - 1.1, -callosum, 16 - p.z}));
  }
  const double brain = std::min(surface, sulcus);
  put(v, t.grey, inside(-brain, w));
  if (brain > cortex - w)
    put(v, t.white, inside(cortex - brain, w));
  if (surface > 2) {
    put(v, t.grey, inside(head::deep_grey(p), w));
    put(v, t.fluid, inside(head::ventricles(p), w));
  }
}

/// Orbits, air spaces, bone and teeth, painted over the soft tissue.
void put_face(double& v, const dvec3& p, double surface, double wall, double w, const Tissues& t) {
  const double orbit = head::orbit(p);
  const double air = head::airways(p, surface);
  double bone = meet(head::bone(p, wall), surface + 3.5, 3);
  bone = std::max({bone, -orbit, 0.8 - air, -head::spinal_canal(p)});
  const double socket = inside(std::max(orbit, surface + 4), w);
  if (socket > 0) {
    put(v, t.fat, socket);
    put(v, t.muscle, inside(head::orbital_muscle(p), w));
  }
  if (orbit < 20 && p.y < -50) {
    const double eye = head::eyeball(p);
    put(v, t.skin, inside(eye, w));
    put(v, t.vitreous, inside(eye + 1.2, w));
    put(v, t.lens, inside(head::eye_lens(p), w));
  }
  put(v, t.mucosa, inside(std::max(air - 1.2, -(air - 1.2) - 4), w) * inside(std::max(-bone - 2, 0.0), w));
  if (bone < w) {
    put(v, t.cortical, inside(bone, w));
    // The diploe lies between two tables in the vault; elsewhere bone is spongy from 3 mm inwards.
    const double table =
        std::max(wall > 0 && wall < 7 ? std::max(1.9 - wall, bone + 1.9) : bone + 3.2, bone + 1.9);
    put(v, t.spongy, inside(table, w));
  }
  put(v, t.tooth, inside(std::max(head::tooth(p), surface + 1.5), w));
  put(v, t.air, inside(air, w));
}

double head_at(const dvec3& p, double w, const Tissues& t, const Vessels& vessels) {
  const double surface = head::skin(p);
  double v = t.air;
  if (surface > w)
    return v;
  const double wall = head::cavity(p);
  if (wall > -w) {
    put(v, t.skin, inside(surface, w));
    put(v, t.fat, inside(surface + 2.2, w));
    const double scalp =
        std::clamp((p.z + 10) / 60, 0.0, 1.0); // the fat is thinner on the vault than on the face
    put(v, t.muscle, inside(surface + 5.5 - 1.3 * scalp, w));
    put_face(v, p, surface, wall, w, t);
    const double canal = head::spinal_canal(p);
    put(v, t.fluid, inside(canal, w));
    put(v, t.white, inside(canal + 3.5, w));
  }
  if (wall < w)
    put_brain(v, p, -wall, w, t);
  if (!vessels.empty())
    put(v, t.blood, inside(std::max(vessel_distance(vessels, p), surface + 2.5), w));
  return v;
}

/// Rows of value(position, width of a voxel's surface, arteries near the row).
template <class Value>
PhantomRows rows_of_vessels(Value value) {
  const auto tree = std::make_shared<const Vessels>(head::arteries());
  return [tree, value](const PhantomGrid& grid, std::size_t j, std::size_t k, std::span<double> row) {
    const double w = 1.2 * std::max({grid.spacing(0), grid.spacing(1), grid.spacing(2)});
    dvec3 p = (dvec3(0, grid.texture(1, j), grid.texture(2, k)) - 0.5) * grid.edges;
    Vessels vessels;
    select_row(*tree, p.y, p.z, w, vessels);
    for (std::size_t i = 0; i < row.size(); ++i) {
      p.x = (grid.texture(0, i) - 0.5) * grid.edges.x;
      row[i] = value(p, w, vessels);
    }
  };
}

/// Blood of `head-arteries`; everything else is 0, as bone and soft tissue are after subtraction.
constexpr double kSubtractedBlood = 200;

double arteries_at(const dvec3& p, double w, const Vessels& vessels) {
  if (vessels.empty())
    return 0;
  return kSubtractedBlood * inside(std::max(vessel_distance(vessels, p), head::skin(p) + 2.5), w);
}

} // namespace

PhantomRows head_artery_rows() {
  return rows_of_vessels(
      [](const dvec3& p, double w, const Vessels& vessels) { return arteries_at(p, w, vessels); });
}

PhantomRows head_rows(bool magnetic_resonance) {
  const Tissues tissues = magnetic_resonance ? kMr : kCt;
  return rows_of_vessels([tissues](const dvec3& p, double w, const Vessels& vessels) {
    return head_at(p, w, tissues, vessels);
  });
}

} // namespace slicelens
