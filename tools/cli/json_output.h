// JSON on stdout.
#pragma once

#include "study/metrics.h"
#include "volume/volume.h"

#include <string>

namespace slicelens::cli {

/// The metrics under their contract's names; null where a metric has no value (PSNR of equal pictures).
std::string metrics_json(const Metrics& metrics);

/// dims, spacing, origin, direction, type, range, mean, components, frames, format.
std::string volume_json(const Volume& volume);

} // namespace slicelens::cli
