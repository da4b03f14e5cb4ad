// LaMar's Table 2 on this machine: what a 2D lens costs.
#pragma once

#include "gl/context.h"

namespace slicelens::bench {

/// Prints a Markdown table: pictures per second of the paper's six lenses as a fraction of the same renderer
/// without a lens, beside the paper's fractions, and triangles and nanoseconds per triangle. Window 500², lens
/// 250², zoom region 186², border 32 pixels, zoom 4; squares have four angular segments, circles 32; linear
/// borders four radial segments, cubic eight. Each measurement is `frames` pictures one after another, `runs`
/// measurements of lens and baseline in turn; medians.
void run_lens2d(gl::Context& context, int runs, int frames);

} // namespace slicelens::bench
