// Cohen's three 1D textures drawn as curves and as texels.
#pragma once

#include "study/plot.h"

#include <array>
#include <string>
#include <vector>

namespace slicelens {

/// The focus along one axis in displayed coordinates, [0,1] over the volume (Cohen, Brodlie and Phillips
/// 2008, Figure 3).
struct FocusMarks {
  std::optional<std::pair<double, double>> shown; ///< x'_min and x'_max; nothing for a fisheye
  std::optional<double> center;                   ///< x_f
};

/// A page with one column for each axis and five rows: the data coordinate x + R that is shown at x, the mask
/// G, the attenuation B, the highlight A, and the texels themselves as boxes (the paper's Figure 5).
///
/// `texels` holds (R offset, G mask, B attenuation, A highlight) of each axis; texel j of N sits at (j +
/// ½)/N. R, B and A are drawn as a linear filter with clamped ends reads them, G, which is fetched nearest,
/// as steps. Values that are not finite interrupt the curves
/// and are black boxes. Throws UsageError where an axis has no texels.
PlotPage axis_tables_page(const std::string& title, const std::array<std::vector<glm::vec4>, 3>& texels,
                          const std::array<FocusMarks, 3>& marks = {});

/// Colour of an offset relative to the largest one, in [-1,1] (clamped): blue where the data comes from
/// below, white at 0, red where it comes from above. 0xRRGGBB.
std::uint32_t diverging_color(double value);

} // namespace slicelens
