#include "render/brick_filling.h"

#include "volume/pyramid.h"
#include "volume/streamed.h"

#include <algorithm>
#include <cstring>

namespace slicelens {

namespace {

/// A box of voxels that may reach beyond its volume.
struct BrickBox {
  std::array<std::ptrdiff_t, 3> first{0, 0, 0};
  std::size_t edge = 1;
};

BrickBox box_of_page(const PageGrid& grid, const PageAddress& page) {
  BrickBox box;
  box.edge = brick_edge(grid);
  for (std::size_t axis = 0; axis < 3; ++axis)
    box.first[axis] =
        static_cast<std::ptrdiff_t>(page.at[axis] * grid.edge) - static_cast<std::ptrdiff_t>(grid.overlap);
  return box;
}

std::size_t clamped(std::ptrdiff_t i, std::size_t count) {
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, static_cast<std::ptrdiff_t>(count) - 1));
}

/// Voxels [first, first + dims) of a level of `level` voxels: where `encode` finds them.
struct Part {
  std::array<std::size_t, 3> first{0, 0, 0};
  std::array<std::size_t, 3> dims{1, 1, 1};
  std::array<std::size_t, 3> level{1, 1, 1};
};

/// `encode(index, count, out)` writes the texels of voxels of the part.
template <class Encode>
void fill_brick(const Part& part, const BrickBox& box, std::size_t texel_bytes, const Encode& encode,
                std::byte* out) {
  // Along x the brick is the level's first voxel some times, a run, and its last voxel some times.
  const std::size_t begin = clamped(box.first[0], part.level[0]);
  const std::size_t end =
      clamped(box.first[0] + static_cast<std::ptrdiff_t>(box.edge) - 1, part.level[0]) + 1;
  const auto before = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, -box.first[0]));
  for (std::size_t z = 0; z < box.edge; ++z) {
    const std::size_t k =
        clamped(box.first[2] + static_cast<std::ptrdiff_t>(z), part.level[2]) - part.first[2];
    for (std::size_t y = 0; y < box.edge; ++y) {
      const std::size_t j =
          clamped(box.first[1] + static_cast<std::ptrdiff_t>(y), part.level[1]) - part.first[1];
      std::byte* const row = out + (z * box.edge + y) * box.edge * texel_bytes;
      std::byte* const run = row + before * texel_bytes;
      encode((k * part.dims[1] + j) * part.dims[0] + begin - part.first[0], end - begin, run);
      for (std::size_t x = 0; x < before; ++x)
        std::memcpy(row + x * texel_bytes, run, texel_bytes);
      const std::byte* const last = run + (end - begin - 1) * texel_bytes;
      for (std::size_t x = before + (end - begin); x < box.edge; ++x)
        std::memcpy(row + x * texel_bytes, last, texel_bytes);
    }
  }
}

const Volume& level_of(const PreparedScene& prepared, std::size_t level) {
  return level == 0 ? prepared.volume : prepared.pyramid[level - 1];
}

} // namespace

std::vector<BrickRow> rows_of_bricks(const PageGrid& grid, std::span<const std::uint32_t> pages,
                                     std::size_t most) {
  std::vector<BrickRow> rows;
  for (const std::uint32_t page : pages) {
    const bool follows = !rows.empty() && rows.back().pages.back() + 1 == page &&
                         rows.back().pages.size() < most && address_of(grid, page).at[0] != 0;
    if (!follows)
      rows.emplace_back();
    rows.back().pages.push_back(page);
  }
  return rows;
}

void fill_row(const PreparedScene& prepared, const PageGrid& grid, const EncodeRun& encode,
              std::size_t texel_bytes, BrickRow& row) {
  const PageAddress begin = address_of(grid, row.pages.front());
  const BrickBox first = box_of_page(grid, begin);
  const BrickBox last = box_of_page(grid, address_of(grid, row.pages.back()));
  const Volume& level = level_of(prepared, begin.level);
  Part part{{0, 0, 0}, level.dims, level.dims};
  Volume read; // what is on disk
  if (is_streamed(level)) {
    std::array<std::size_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      part.first[axis] = clamped(first.first[axis], level.dims[axis]);
      size[axis] = clamped(last.first[axis] + static_cast<std::ptrdiff_t>(last.edge) - 1, level.dims[axis]) +
                   1 - part.first[axis];
    }
    part.dims = size;
    read = crop(level, part.first, size);
  }
  const Volume& source = is_streamed(level) ? read : level;
  const std::size_t voxels = first.edge * first.edge * first.edge;
  row.voxels.resize(row.pages.size() * voxels * texel_bytes);
  for (std::size_t i = 0; i < row.pages.size(); ++i) {
    const BrickBox box = box_of_page(grid, address_of(grid, row.pages[i]));
    fill_brick(
        part, box, texel_bytes,
        [&](std::size_t index, std::size_t count, std::byte* out) { encode(source, index, count, out); },
        row.voxels.data() + i * voxels * texel_bytes);
  }
  const std::vector<std::uint8_t>& labels = prepared.labels.rows;
  if (prepared.labels.table.empty())
    return;
  row.labels.resize(row.pages.size() * voxels);
  const Part all{{0, 0, 0}, level.dims, level.dims};
  for (std::size_t i = 0; i < row.pages.size(); ++i) {
    fill_brick(
        all, box_of_page(grid, address_of(grid, row.pages[i])), 1,
        [&](std::size_t index, std::size_t count, std::byte* out) {
          std::memcpy(out, labels.data() + index, count);
        },
        row.labels.data() + i * voxels);
  }
}

} // namespace slicelens
