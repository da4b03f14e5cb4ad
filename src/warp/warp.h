// All warps as one value. Adding one: its GLSL in shaders/warp/, its header here, an entry in Warp and in
// warp_infos.
#pragma once

#include "warp/lamar.h"

#include <string>
#include <variant>
#include <vector>

namespace slicelens {

/// One entry of a scene's `warp`.
using Warp = std::variant<LamarLens>;

/// The word of `warp.kind`.
std::string kind_of(const Warp& warp);

struct WarpInfo {
  std::string kind;
  std::string description;            ///< one line, with its paper
  std::vector<std::string> pipelines; ///< that can draw it, the paper's own first
};

/// In the order in which they are listed to users.
const std::vector<WarpInfo>& warp_infos();

/// Throws UsageError naming warp and key for parameters that make no warp.
void validate(const Warp& warp);

} // namespace slicelens
