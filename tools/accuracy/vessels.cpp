// Do Cohen's displays cut vessels? Pieces of a displayed arterial tree, jumps and smallest determinants of
// the maps (docs/papers/cohen.md).

#include "bench.h"
#include "study/components.h"
#include "study/continuity.h"
#include "volume/phantom.h"
#include "volume/read.h"
#include "warp/warp.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <type_traits>

namespace slicelens::accuracy {

namespace {

using glm::dvec3;

// One lens for all displays, about the same centre: the box within c ± kInner is shown kZoom times as large.
constexpr double kInner = 0.14;
constexpr double kOuter = 0.28;
constexpr double kZoom = 2.5;
constexpr double kDistortion = 2; // of the fisheye: magnification 3 at the focal point
constexpr std::size_t kTiny = 8;  // voxels of the volume below which a piece is a speck
const std::vector<double> kSteps = {1e-3, 1e-4, 1e-5};
const std::vector<std::size_t> kFactors = {1, 2, 3};

struct Vessels {
  std::string name;
  Volume volume;
  double threshold = 0;
  dvec3 center{0.5}; ///< of the aneurysm, texture coordinates
};

struct Display {
  std::string name;
  TextureMap u;
  JacobianMap jacobian;
};

Display display(const std::string& name, const Warp& warp, const BoxSpace& space) {
  validate(warp);
  const WarpMap map = map_of(warp, space, {});
  return {name,
          [map, space](const dvec3& p) {
            return texture_from_box(space, texture_from_object(map, box_from_texture(space, p)));
          },
          [map, space](const dvec3& p) { return jacobian(map, box_from_texture(space, p)); }};
}

std::vector<Display> displays(const Vessels& vessels) {
  const dvec3 c = vessels.center;
  const LensBox box{c, dvec3(kInner), dvec3(kOuter), kZoom};
  const BoxSpace space = box_space(box_of(vessels.volume));
  const dvec3 seen(kInner / kZoom);
  return {
      {"undeformed", undeformed(), [](const dvec3&) { return glm::dmat3(1); }},
      display("bifocal", Bifocal{ranges_of(c - seen, c + seen), ranges_of(c - kInner, c + kInner)}, space),
      display("fisheye", Fisheye{c, dvec3(kDistortion)}, space),
      display("volume lens", VolumeLens{box}, space),
      display("connected lens", ConnectedLens{box}, space)};
}

Region lens_box(const Vessels& vessels, double margin = 0) {
  return {vessels.center - kOuter - margin, vessels.center + kOuter + margin};
}

/// The vessels' largest piece alone: voxels of the others become the smallest value. Pieces are those of
/// voxels that share faces; the trilinear values between two such voxels are at least the smaller one's, so
/// what is left is one piece as a continuous solid, and every cell of it has a voxel of the piece.
Volume largest_tree(const Vessels& vessels) {
  Volume tree = vessels.volume;
  const VoxelMask all = displayed_mask(tree, undeformed(), vessels.threshold, tree.dims);
  const VoxelMask kept = largest_component(all, Connectivity::faces);
  visit_scalar_type(tree.type, [&](auto* tag) {
    using T = std::remove_pointer_t<decltype(tag)>;
    auto* scalars = reinterpret_cast<T*>(tree.voxels.data());
    for (std::size_t v = 0; v < kept.voxels.size(); ++v) {
      if (all.voxels[v] != 0 && kept.voxels[v] == 0)
        scalars[v] = static_cast<T>(tree.min);
    }
  });
  return tree;
}

struct Pieces {
  std::string text;
  std::string share; ///< of the voxels in the largest one
};

/// "3 + 17": pieces of at least kTiny voxels of the volume and tiny ones, on a grid `factor` times as fine.
Pieces pieces(const Volume& volume, const TextureMap& u, double threshold, std::size_t factor) {
  const auto n = volume.dims;
  const Components found = connected_components(
      displayed_mask(volume, u, threshold, {factor * n[0], factor * n[1], factor * n[2]}));
  const ComponentCount count = count_components(found, kTiny * factor * factor * factor);
  const double all = static_cast<double>(voxel_count(found));
  return {std::to_string(count.large) + " + " + std::to_string(count.tiny),
          found.sizes.empty() ? "none" : percent(static_cast<double>(found.sizes[0]) / all)};
}

void pieces_table(const Vessels& vessels) {
  const Volume tree = largest_tree(vessels);
  const auto grid = [&](std::size_t factor) { return std::to_string(factor * tree.dims[0]) + "³"; };
  std::vector<std::string> heads = {"display", "all vessels, " + grid(1)};
  for (const std::size_t factor : kFactors)
    heads.push_back("largest tree, " + grid(factor));
  heads.insert(heads.end(), {"in its largest piece", "goes on across the box"});
  std::cout << vessels.name << ". Pieces of at least " << kTiny << " voxels + smaller ones:\n\n";
  Table table(heads);
  for (const Display& d : displays(vessels)) {
    say("pieces of " + vessels.name + ", " + d.name);
    std::vector<std::string> cells = {d.name, pieces(vessels.volume, d.u, vessels.threshold, 1).text};
    Pieces last;
    for (const std::size_t factor : kFactors) {
      last = pieces(tree, d.u, vessels.threshold, factor);
      cells.push_back(last.text);
    }
    cells.push_back(last.share);
    cells.push_back(
        percent(face_crossing(tree, d.u, vessels.threshold, lens_box(vessels), 512, 1e-6).continued()));
    table.row(cells);
  }
}

void maps_table(const Vessels& vessels) {
  std::vector<std::string> heads = {"map"};
  for (const double step : kSteps)
    heads.push_back("largest jump, step " + scientific(step));
  heads.insert(heads.end(), {"in voxels", "smallest determinant"});
  Table table(heads);
  for (const Display& d : displays(vessels)) {
    say("map of " + d.name);
    std::vector<std::string> cells = {d.name};
    double jump = 0;
    for (const double step : kSteps) {
      jump = std::max(largest_jump(d.u, {}, 65, step).size,
                      largest_jump(d.u, lens_box(vessels, 0.01), 97, step).size);
      cells.push_back(scientific(jump));
    }
    cells.push_back(fixed(jump * static_cast<double>(vessels.volume.dims[0]), 3));
    cells.push_back(fixed(std::min(smallest_determinant(d.jacobian, {}, 129, 1000000).value,
                                   smallest_determinant(d.jacobian, lens_box(vessels), 129, 1000000).value),
                          4));
    table.row(cells);
  }
}

} // namespace

void vessel_section(const Bench& bench) {
  std::cout << "## Vessels under Cohen's displays\n\n";
  std::cout << "Centre: the aneurysm. Lenses: inner " << kInner << ", outer " << kOuter << ", magnification "
            << kZoom << "; bifocal: ±" << kInner / kZoom << " shown in ±" << kInner
            << "; fisheye: distortion " << kDistortion << ".\n\n";
  // The phantom's aneurysm lies at (21, −19, 16) mm from the middle of 256 mm; half a voxel's blood is 100.
  const dvec3 aneurysm = 0.5 + dvec3(21, -19, 16) / 256.0;
  const Vessels phantom{"Phantom head-arteries 256³, threshold 100", make_phantom("head-arteries"), 100,
                        aneurysm};
  maps_table(phantom);
  pieces_table(phantom);
  const std::filesystem::path file = bench.volumes / "aneurism" / "aneurism.vti";
  if (bench.volumes.empty() || !std::filesystem::exists(file))
    return;
  VolumeSource source;
  source.file = file;
  // The centre is where the vessels are thickest: what is left last when they are eroded.
  const Vessels real{"Rotational angiography 256³ (aneurism), threshold 80",
                     read_volume(source),
                     80,
                     {0.431, 0.416, 0.6285}};
  pieces_table(real);
}

} // namespace slicelens::accuracy
