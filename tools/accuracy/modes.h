// Tables of section `modes` that stand in files of their own.
#pragma once

#include "bench.h"

namespace slicelens::accuracy {

/// The first surface of a ball against the sphere: where rays meet it, and which ones do.
void surface_tables(const Bench& bench);

/// Slices and rays against `reference` in every mode, and `reference` against finer samples.
void mode_spacing_table(const Bench& bench);

} // namespace slicelens::accuracy
