// All warps as one value. Adding one: its GLSL in shaders/warp/, its header here, an entry in Warp, WarpMap,
// map_of, glsl_of and warp_infos.
#pragma once

#include "warp/bifocal.h"
#include "warp/deformations.h"
#include "warp/field.h"
#include "warp/fisheye.h"
#include "warp/lamar.h"
#include "warp/landmarks.h"
#include "warp/map_grid.h"
#include "warp/volume_lens.h"
#include "warp/widgets.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace slicelens {

/// One entry of a scene's `warp`.
using Warp = std::variant<LamarLens, Bifocal, Fisheye, VolumeLens, ConnectedLens, Shift, Sine, Twist, Bend,
                          Pulse, Spreader, Leafer, Peeler, Expander, Landmarks, Field>;

/// The word of `warp.kind`.
std::string kind_of(const Warp& warp);

struct WarpInfo {
  std::string kind;
  std::string description;            ///< one line, with its paper
  std::vector<std::string> pipelines; ///< that can draw it, the paper's own first
};

/// In the order in which they are listed to users.
const std::vector<WarpInfo>& warp_infos();
const WarpInfo& info_of(const Warp& warp);

/// A warp of that kind with its defaults, or nothing. `landmarks` and `field` have no valid ones: they need
/// points or a file.
std::optional<Warp> make_warp(const std::string& kind);

/// Throws UsageError naming warp and key for parameters that make no warp.
void validate(const Warp& warp);

/// Whether the map is one map for each axis, u_a(p_a), under masks or weights that are products of one factor
/// for each axis, and takes the volume onto itself: what Cohen's tables can hold.
bool is_separable(const Warp& warp);

/// Whether the map is the identity outside a bounded region, whatever its parameters.
bool has_bounded_support(const Warp& warp);

/// The focus region that the warp shows, on display, texture coordinates: where highlight and attenuation
/// have theirs. A focal point is a region with low = high. None for warps without one.
std::optional<AxisRanges> focus_region(const Warp& warp);
/// Of the last warp in the list that has one.
std::optional<AxisRanges> focus_region(const std::vector<Warp>& warps);

/// A warp's numbers for a box and a view: what its functions in shaders/warp/ take.
using WarpMap =
    std::variant<LamarMap, BifocalMap, FisheyeMap, VolumeLensMap, ConnectedLensMap, ShiftMap, SineMap,
                 TwistMap, BendMap, PulseMap, SpreaderMap, LeaferMap, PeelerMap, ExpanderMap, GridMap>;

/// Throws UsageError where a lens cannot be seen from the view, for a bend or a peeler that folds the box,
/// and where landmarks or a field make no map. Those two take the time of solving and sampling; what they
/// give does not depend on the view.
WarpMap map_of(const Warp& warp, const BoxSpace& space, const WarpView& view);

/// The inverse map and its derivative at p, box space, in double precision; the forward map at u.
glm::dvec3 texture_from_object(const WarpMap& map, const glm::dvec3& p);
glm::dmat3 jacobian(const WarpMap& map, const glm::dvec3& p);
glm::dvec3 object_from_texture(const WarpMap& map, const glm::dvec3& u);

/// Declared cuts: whether the map may be discontinuous within `distance` of p, box space. Conservative:
/// borders between pieces count where they happen to join.
bool has_cuts(const WarpMap& map);
bool near_cut(const WarpMap& map, const glm::dvec3& p, double distance);
bool near_cut(const std::vector<WarpMap>& maps, const glm::dvec3& p, double distance);

/// The same for a list of warps in forward order: u = u_1 ∘ … ∘ u_n (docs/pipeline.md).
glm::dvec3 texture_from_object(const std::vector<WarpMap>& maps, const glm::dvec3& p);
glm::dmat3 jacobian(const std::vector<WarpMap>& maps, const glm::dvec3& p);
glm::dvec3 object_from_texture(const std::vector<WarpMap>& maps, const glm::dvec3& u);

/// How GLSL names a map: the file of its functions, its struct, and the prefix of
/// PREFIX_texture_from_object(STRUCT, vec3) and PREFIX_jacobian.
struct WarpGlsl {
  std::string library; ///< that the file's functions need first; empty: none
  std::string file;
  std::string type;
  std::string prefix;
};
WarpGlsl glsl_of(const WarpMap& map);

} // namespace slicelens
