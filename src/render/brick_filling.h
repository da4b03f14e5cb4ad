// The texels of bricks: pages with their overlap, cut out of a volume in memory or on disk.
#pragma once

#include "render/pages.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace slicelens {

/// Writes the texels of the voxels [first, first + count) of `part`, x fastest.
using EncodeRun =
    std::function<void(const Volume& part, std::size_t first, std::size_t count, std::byte* out)>;

/// The texels of some pages of one level that follow each other along x, one brick after the other.
struct BrickRow {
  std::vector<std::uint32_t> pages;
  std::vector<std::byte> voxels; ///< pages.size() bricks, each x fastest, then y, then z
  std::vector<std::byte> labels; ///< one byte each, mode `two-level` only
};

/// Pages in ascending order as rows of neighbours, each of at most `most` pages.
std::vector<BrickRow> rows_of_bricks(const PageGrid& grid, std::span<const std::uint32_t> pages,
                                     std::size_t most);

/// Fills a row: reads the part of the level that its bricks lie in, once, and encodes it. What of a brick
/// lies beyond the level repeats its edge, as textures do that are clamped to the edge. Throws what
/// VoxelStream::read throws.
void fill_row(const PreparedScene& prepared, const PageGrid& grid, const EncodeRun& encode,
              std::size_t texel_bytes, BrickRow& row);

} // namespace slicelens
