// What prepare() works out of a volume's voxels and place. Private to src/render/prepare.cpp.
#pragma once

#include "render/prepare.h"

#include <optional>

namespace slicelens {

/// Voxels without a value are drawn as empty: as a value that the transfer function does not show, for maxima
/// as the smallest one.
void fill_missing(PreparedScene& prepared);

/// The levels above the first. They depend on the data alone, so those there are stay. Throws UsageError
/// where a volume on disk has too few.
void prepare_pyramid(PreparedScene& prepared);

/// What render.skip and pages tell empty cells by. It depends on the data and the filter's reach, so it
/// stays.
void prepare_cells(PreparedScene& prepared);

/// Puts the volume where its placement says. `middle`: of the first volume, which `align` may ask for.
void place(PreparedScene& prepared, const std::optional<glm::dvec3>& middle);

} // namespace slicelens
