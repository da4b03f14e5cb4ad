// What a changed warp costs before the next frame can be drawn.
#pragma once

#include "gl/context.h"
#include "render/prepare.h"

#include <optional>

namespace slicelens {

/// Seconds of wall clock from a scene whose warp has changed to a driver that can slice and draw it: splines
/// solved, bounds, grids and tables filled, and handed over (the first part of the frames of Brunet, Nowak
/// and Gleicher 2006, Table 3). Nothing for scenes without a warp. The context must be current. Works on a
/// copy of the data, whose making does not count.
std::optional<double> deform_seconds(gl::Context& context, const PreparedScene& prepared);

} // namespace slicelens
