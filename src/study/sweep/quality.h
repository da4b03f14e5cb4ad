// What a study measures of one picture: metrics by name, and counts.
#pragma once

#include "image/image.h"
#include "render/prepare.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace slicelens {

/// A column of the results and its value; nothing stands for JSON's null.
using Value = std::pair<std::string, std::optional<double>>;

/// Throws UsageError naming `path` and the nearest known metric for a name that neither study/metrics.h nor
/// study/lens_metrics.h has.
void check_metric(const std::string& name, const std::string& path);

/// Whether the metric compares two pictures; the others are of the warp alone.
bool needs_reference(const std::string& metric);

/// A picture and what it lies over.
struct Shown {
  const Image* image = nullptr;
  glm::dvec3 background{0};
};

/// Every named metric of `picture` against `reference` (whose image is null where none is needed), and of the
/// warp of `prepared` (null for 2D lenses, which have no such metrics). Throws UsageError as the metrics do.
std::vector<Value> measure_quality(const std::vector<std::string>& metrics, const PreparedScene* prepared,
                                   const Shown& picture, const Shown& reference);

} // namespace slicelens
