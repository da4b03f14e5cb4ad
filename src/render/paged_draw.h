// Drawing a volume through pools of bricks: part by part of the stack, each with its pages loaded.
#pragma once

#include "gl/target.h"
#include "render/gpu_scene.h"
#include "render/stack_geometry.h"

#include <functional>
#include <span>
#include <string>

namespace slicelens {

/// Of the pools of a scene, in the order of its volumes.
std::vector<PoolCounts> pool_counts(const GpuScene& scene);

/// How a drawing may be cut where the pools hold too few bricks for all of it.
enum class Splitting {
  everywhere, ///< along the view, and into bands of the picture
  along_view, ///< a slice of all pixels at a time
  nowhere
};

/// Calls `draw(begin, end)` for the entries [begin, end) of a drawing whose entries have these `numbers`: all
/// of them at once without pools. With pools: in parts whose pages they hold together, loaded before, and for
/// the rows of pixels of a band at a time, to which the scissor is set. `what` is drawn, for messages. Throws
/// LimitError where it would have to be cut further than `splitting` allows; FileError where a volume on disk
/// cannot be read.
void draw_in_parts(const gl::Functions& gl, const PreparedScene& prepared, const GpuScene& scene,
                   std::span<const SliceNumbers> numbers, const gl::Target& target, Splitting splitting,
                   const std::string& what,
                   const std::function<void(std::size_t begin, std::size_t end)>& draw);

} // namespace slicelens
