// What a scene's deformation does to the volume: how much it magnifies and where, whether it folds or tears,
// and how finely its focus is sampled.
#pragma once

#include "render/prepare.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slicelens {

// All of these are of the first volume (one_volume gives another one alone), of the map that is drawn
// (pipeline `grid`: the sampled one) and of the displayed points: those of the displayed volume's bounds
// whose u(p) lies in the data. Lengths are in box space, as fractions of the box's longest edge; J = ∂u/∂p
// there, u the inverse map, so that J shrinks where the display magnifies. Extremes and fractions are over
// samples, so a region that is thinner than the samples lie apart can be missed.

/// How much larger than undeformed the surroundings of a displayed point are shown; infinite where J is
/// singular in that sense.
struct LocalMagnification {
  /// In the picture: √(1/area) of what the unit square across the viewing direction shows of the data, area =
  /// |J·right × J·up|. LaMar's zoom region has its zoom.
  double in_view = 1;
  /// Of lengths on average over the three directions: |det J|^(−1/3). LaMar's zoom region has zoom^(2/3),
  /// because nothing grows along the view.
  double in_volume = 1;
};
LocalMagnification local_magnification(const PreparedScene& prepared, const glm::dvec3& p);

/// Where the focus is shown, box space: a lens' centre, the middle of the shown focus region or the sphere of
/// influence, of the last warp that has one, carried on by the warps after it; without one the box's middle.
glm::dvec3 displayed_focus(const PreparedScene& prepared);

/// Over cells' middles of a grid of n³ in the displayed bounds, and displayed_focus, where lenses magnify
/// most.
struct FoldOver {
  std::size_t points = 0;           ///< displayed points that were looked at, without those near cuts
  std::size_t near_cuts = 0;        ///< displayed points within 1e-6 of a declared cut, counted apart
  std::size_t folded = 0;           ///< of `points`, those with det J ≤ 0
  double jacobian_min = 1;          ///< smallest det J; 1 without points
  LocalMagnification largest{1, 1}; ///< largest of each, over the same points; 1 without points

  /// folded / points; 0 without points.
  double fraction() const;
};
FoldOver fold_over(const PreparedScene& prepared, std::size_t n = 64);

/// The largest jump of the map over the displayed bounds (study/continuity.h: lines n³, pairs of points 1e-7
/// apart): declared cuts are what it finds. Places outside the data count as the nearest ones of the box, so
/// that it says by how much of the volume the picture jumps. Where the map is continuous the result is 1e-7
/// times its steepest slope.
double largest_border_jump(const PreparedScene& prepared, std::size_t n = 32);

/// Samples for each voxel along the ray through displayed_focus: 1/|k|, k the way in voxels (of the three
/// axes) that the data position moves while the ray goes on by the spacing Δ, k = ∂(u∘dims)/∂s·Δ. Sample
/// distances are those of rays; slices under perspective lie 1/cos farther apart away from the axis.
double samples_per_voxel(const PreparedScene& prepared);

/// Fraction of the picture's pixels whose ray meets the focus on display: LaMar's zoom region, the box of
/// uniform magnification (bifocal, volume-lens, connected-lens), the pulse's sphere of influence, of the last
/// warp that has one; without one the points with a magnification in view above 1 + 1e-6. Of at most 256×256
/// pixels, evenly spread, and of steps of 1/256 along a ray.
double focus_share(const PreparedScene& prepared);

/// magnification and magnification_max (in view: at displayed_focus and largest), magnification_volume and
/// magnification_volume_max, fold_over, jacobian_min, jump, samples_per_voxel, focus_share.
const std::vector<std::string>& lens_metric_names();

/// Throws UsageError naming the nearest known name unless it is one of lens_metric_names().
void validate_lens_metric(const std::string& name);

/// The metrics of these names, in their order; no others are computed. Nothing stands for a value that is not
/// finite. Throws as validate_lens_metric does.
std::vector<std::pair<std::string, std::optional<double>>> measure_lens(const std::vector<std::string>& names,
                                                                        const PreparedScene& prepared);

} // namespace slicelens
