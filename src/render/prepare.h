// A scene with its data, and every quantity that its picture depends on, worked out once for all pipelines.
#pragma once

#include "core/view.h"
#include "render/footprint.h"
#include "render/labels.h"
#include "scene/load.h"
#include "scene/scene.h"
#include "slicing/polygon.h"
#include "tess/lens_mesh.h"
#include "volume/cell_ranges.h"
#include "volume/transfer.h"
#include "volume/volume.h"
#include "warp/axis_tables.h"
#include "warp/warp_grid.h"

#include <limits>
#include <optional>
#include <variant>
#include <vector>

namespace slicelens {

/// The map of landmarks or a field, kept as long as they and the volume's box stay the same: the view does
/// not change it.
struct HeldWarp {
  std::variant<Landmarks, Field> warp;
  BoxSpace space;
  GridMap map;
};

/// What render.skip can leave out of a scene.
struct Skipping {
  bool empty = false; ///< enough cells show nothing for looking at them to pay
  /// Slices, or steps of a ray, that may be opaque together; infinite where render.skip does not look for
  /// them or no number can.
  double opaque_after = std::numeric_limits<double>::infinity();
};

/// Where a volume's file puts it.
struct FileGeometry {
  glm::dvec3 spacing{1};
  glm::dvec3 origin{0};
  glm::dmat3 direction{1};
};

/// Lengths are in world units. Plain data: change the scene, prepare again.
struct PreparedScene {
  Scene scene;
  Volume volume; ///< one component
  TransferFunction transfer;
  Box box;
  View view;
  double spacing = 1;             ///< Δ, slice or step distance
  double unit_distance = 1;       ///< Δ₀, the length that the transfer function's opacities are for
  double xray_scale = 1;          ///< grey of a line integral of one
  std::vector<Plane> data_clip;   ///< half-spaces of the data that are kept, in texture space
  std::vector<Plane> object_clip; ///< half-spaces of the displayed volume, in its texture coordinates
  BoxSpace space;
  WarpView warp_view;
  std::vector<WarpMap> maps;                          ///< the scene's warps for this view, in forward order
  std::vector<LensTessellation> lenses;               ///< those of kind `lamar`
  FocusEffects effects{};                             ///< highlight and attenuation for this view
  AxisTables tables;                                  ///< pipeline `axis` only
  std::vector<HeldWarp> held;                         ///< of the landmarks and fields among the warps
  std::optional<GridMap> map_grid;                    ///< pipeline `grid` only: all of `maps` in one
  GradientSpace gradient_space = GradientSpace::data; ///< where the differences of shading are taken
  double log_zoom = 0;             ///< ln of their largest zoom, for render.levels; 0 without a lens
  SampleSteps steps;               ///< from sample to sample, for render.footprint
  std::size_t levels = 1;          ///< of the pyramid: render.levels, or what render.footprint needs of them
  std::vector<Volume> pyramid;     ///< levels 1, 2 … (volume/pyramid.h)
  std::optional<CellRanges> cells; ///< where render.skip needs them
  /// What fragments leap over under render.skip; none of a volume on disk, where `cells` serve for this too.
  std::optional<CellRanges> small_cells;
  Skipping skipping; ///< under this transfer function
  glm::dvec3 object_low{
      0}; ///< bounds of the displayed volume, texture coordinates: the unit cube without a warp
  glm::dvec3 object_high{1};
  PreparedLabels labels;      ///< mode `two-level` only
  FileGeometry file_geometry; ///< of `volume`, which lies where its placement puts it
  /// The volumes after the first, each as a scene of its own under the same view and spacing. The bounds
  /// above are then those of all volumes, in the first one's texture coordinates.
  std::vector<PreparedScene> others;
};

/// The tables that pipeline `axis` reads, whatever the scene's pipeline: one texel for each voxel, or
/// render.axis_texels. Throws as make_axis_tables does.
AxisTables axis_tables_of(const PreparedScene& prepared);

/// The maps that shaders evaluate: pipeline `grid` has one in place of the whole chain.
std::vector<WarpMap> drawn_maps(const PreparedScene& prepared);

/// How far the picture of pipeline `grid` looks from where it should. Needs prepared.map_grid.
MapGridError map_grid_error(const PreparedScene& prepared);

/// Whether any point of the displayed volume may look elsewhere in the data, or outside: what is drawn beside
/// other volumes reaches beyond each of them.
inline bool is_warped(const PreparedScene& prepared) {
  return !prepared.maps.empty() || !prepared.others.empty();
}

inline std::size_t volume_count(const PreparedScene& prepared) { return 1 + prepared.others.size(); }

/// Volume `index`, 0 for the first.
inline const PreparedScene& volume_at(const PreparedScene& prepared, std::size_t index) {
  return index == 0 ? prepared : prepared.others[index - 1];
}

/// The smallest box along the first volume's axes that holds all of them, undeformed: the first one's own
/// where there is no other. The camera looks at its centre.
Box box_of_all(const PreparedScene& prepared);

/// Volume `index` alone, seen as in the whole. Moves the data out of `prepared`.
PreparedScene one_volume(PreparedScene prepared, std::size_t index);

/// From the first volume's texture coordinates to those of volume `index`: where it is displayed.
glm::dmat4 own_from_first(const PreparedScene& prepared, std::size_t index);

/// Works out the rest. `others` are the data of scene.others, `labels` those of volume.labels. Throws
/// UsageError where scene and data do not fit.
PreparedScene prepare(Scene scene, Volume volume, TransferFunction transfer,
                      std::vector<LoadedVolume> others = {},
                      std::optional<LoadedLabels> labels = std::nullopt);

/// Takes other data for the first volume or, from prepared.others, for one after it. Prepare again.
void set_volume(PreparedScene& prepared, Volume volume);

/// The same data seen by another camera or with other render settings; nothing is read again.
void prepare_again(PreparedScene& prepared);

/// Of mode `iso`: render.isovalue, or the middle of the data's range.
double isovalue_of(const PreparedScene& prepared);

/// Δ/Δ₀: exponent of the opacity correction on the view axis and along rays (docs/pipeline.md).
double axis_distance_ratio(const PreparedScene& prepared);

/// How a pipeline must correct the opacity of a sample.
enum class Correction { none, constant, per_fragment };

/// What render.opacity_correction asks of the pipeline: nothing where it would not change a value, per
/// fragment only for planar slices under perspective.
Correction correction_of(const PreparedScene& prepared);

/// Unit vector in world space from the object towards the light; `to_eye` where the light is at the camera.
glm::dvec3 light_direction(const PreparedScene& prepared, const glm::dvec3& to_eye);

} // namespace slicelens
