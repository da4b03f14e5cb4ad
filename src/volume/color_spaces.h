// Interpolation of display colours in the colour spaces that colour maps of VTK and ParaView name.
#pragma once

#include <glm/glm.hpp>

namespace slicelens {

/// Where two neighbouring colours are interpolated.
enum class ColorSpace {
  rgb,
  hsv,         ///< hue the long way round where that is the direct one
  hsv_wrapped, ///< hue the short way round
  lab,         ///< CIE L*a*b* of sRGB, white D65
  diverging,   ///< Msh: Moreland, Diverging Color Maps for Scientific Visualization, ISVC 2009, §4
  step         ///< the upper colour all the way
};

/// Colours in [0,1]³ (sRGB) to CIE L*a*b*, and back; what lies outside the display's gamut is scaled down by
/// its largest channel and cut off at 0, as VTK does.
glm::dvec3 lab_from_rgb(const glm::dvec3& rgb);
glm::dvec3 rgb_from_lab(const glm::dvec3& lab);

/// Hue, saturation and value, all in [0,1], and back.
glm::dvec3 hsv_from_rgb(const glm::dvec3& rgb);
glm::dvec3 rgb_from_hsv(const glm::dvec3& hsv);

/// The colour at `weight` in [0,1] between `a` (0) and `b` (1). Results lie in [0,1]³.
glm::dvec3 mix_colors(ColorSpace space, const glm::dvec3& a, const glm::dvec3& b, double weight);

} // namespace slicelens
