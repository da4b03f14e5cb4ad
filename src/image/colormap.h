// One perceptual colour map, for error pictures.
#pragma once

#include <glm/glm.hpp>

namespace slicelens {

/// Display-space sRGB of the heat map at t (clamped to [0,1]; NaN gives white): black at 0, then violet, red,
/// orange to pale yellow at 1. OKLab lightness is .97t, so equal steps of t look equally large and the map
/// still reads in grey; the hue turns evenly from 285° to 465° (= 105°); the chroma is .52t − .42t², which
/// stays inside sRGB and has no edge of its own. (OKLab: B. Ottosson, "A perceptual color space for image
/// processing", 2020.)
glm::vec3 heat_color(double t);

} // namespace slicelens
