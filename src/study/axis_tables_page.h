// Cohen's three 1D textures drawn as curves and as texels (docs/papers/cohen.md).
#pragma once

#include "render/prepare.h"
#include "study/plot.h"
#include "warp/axis_tables.h"

#include <array>
#include <optional>
#include <string>

namespace slicelens {

/// Focus regions on display, texture coordinates (Cohen, Brodlie and Phillips 2008, Figure 3); low = high for
/// a fisheye's focal point. Without one, attenuation and highlight are drawn with the mapping's.
struct AxisTableMarks {
  std::optional<AxisRanges> mapping;
  std::optional<AxisRanges> attenuation;
  std::optional<AxisRanges> highlight;
};

/// A page with one column for each axis and five rows: the data coordinate x + R that is shown at x, the mask
/// G, the attenuation B, the highlight A, and the texels themselves as boxes (the paper's Figure 5).
///
/// Curves are what `filter` with clamped ends reads at each x, masks that are tested are what a nearest fetch
/// reads. Focus regions are shaded, with x'_min, x'_max and the middle x_f. Values that are not finite
/// interrupt the curves and are black boxes. Throws UsageError where an axis has no texels.
PlotPage axis_tables_page(const std::string& title, const AxisTables& tables,
                          const AxisTableMarks& marks = {}, AxisFilter filter = AxisFilter::linear);

/// The same of a scene, whatever its pipeline. Throws as axis_tables_of does.
PlotPage axis_tables_page(const std::string& title, const PreparedScene& prepared);

/// Colour of an offset relative to the largest one, in [-1,1] (clamped): blue where the data comes from
/// below, white at 0, red where it comes from above. 0xRRGGBB.
std::uint32_t diverging_color(double value);

} // namespace slicelens
