// Cohen's three 1D textures as values (Cohen, Brodlie and Phillips 2008 §4, Fig. 5; docs/papers/cohen.md).
#pragma once

#include "warp/focus_effects.h"
#include "warp/warp.h"

#include <array>
#include <vector>

namespace slicelens {

/// What the G channel of the tables means.
enum class AxisMask {
  test,  ///< 0 or 1: the offsets apply where all three are 1
  weight ///< in [0,1]: the offsets apply times the product of all three (connected lens)
};

/// Texel j of an axis with N texels sits at displayed texture coordinate (j+½)/N and holds offset u − x (R),
/// mask (G), attenuation (B) and highlight (A).
struct AxisTables {
  std::array<std::vector<glm::vec4>, 3> texels;
  AxisMask mask = AxisMask::test;
};

/// Limits of render.axis_texels.
inline constexpr std::size_t min_axis_texels = 16;
inline constexpr std::size_t max_axis_texels = 4096;

/// The tables of the warps in forward order, with `counts` texels on the axes (texture coordinates, whatever
/// the maps' box space). Several warps are chained into one table where none of them has a mask. Throws
/// UsageError for a warp that is_separable refuses, naming it, and for a mask among several warps.
AxisTables make_axis_tables(const std::vector<Warp>& warps, const FocusEffects& effects,
                            const std::array<std::size_t, 3>& counts);

/// Whether all masks are 1, so that offsets apply everywhere.
bool is_unmasked(const AxisTables& tables);

/// The inverse map of a separable warp on one axis, texture coordinates, with the axis' mask or weight.
struct AxisSample {
  double texture = 0; ///< u
  double mask = 1;
};
AxisSample sample_axis(const Warp& warp, int axis, double x);

} // namespace slicelens
