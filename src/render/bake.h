// The deformed volume as a volume of its own, for other programs and to hold pictures against.
#pragma once

#include "core/progress.h"
#include "render/prepare.h"

#include <array>
#include <optional>

namespace slicelens {

struct BakeOptions {
  std::optional<std::array<std::size_t, 3>> size; ///< voxels; none: those of the volume, and as many more of
                                                  ///< their size as the displayed volume sticks out
  bool as_float = false;                          ///< float32; else the volume's own type, rounded
  std::optional<double> outside; ///< where nothing is shown; none: the volume's smallest value
};

/// v∘u on voxels over the displayed volume's bounds, with the volume's axes, where the picture shows it:
/// samples by render.filter in double precision, on all cores. Clipping, effects and the transfer function
/// are the picture's, not the volume's. Throws LimitError for more voxels than fit the memory, UsageError for
/// an outside value that the type cannot hold and for volumes of colours.
Volume bake(const PreparedScene& prepared, const BakeOptions& options, const Progress& progress);

} // namespace slicelens
