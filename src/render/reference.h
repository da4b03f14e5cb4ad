// Pipeline `reference`: rays on the CPU in double precision, the truth that the GPU pipelines are held to. It
// shares with them only the functions of shaders/lib/, compiled as C++; sampling and classification are its
// own and exact.
#pragma once

#include "core/progress.h"
#include "image/image.h"
#include "render/prepare.h"

namespace slicelens {

/// Associated colour over transparent black. Filters: nearest, or trilinear for both linear and linear-exact.
/// The transfer function is evaluated exactly, not from a table. Multithreaded; the result does not depend on
/// the number of threads. Throws UsageError for a spacing that would take more than a million samples a ray.
Image render_reference(const PreparedScene& prepared, const Progress& progress);

} // namespace slicelens
