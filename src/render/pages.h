// A volume larger than render.memory, cut into pages: which of them a picture needs, where, and when. Without
// OpenGL; docs/bricks.md.
#pragma once

#include "render/prepare.h"
#include "render/screen_cover.h"
#include "render/stack_geometry.h"
#include "warp/object_bounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace slicelens {

/// Voxels along an edge from which on no texture is tried: what drivers of today take at least.
inline constexpr std::size_t most_texture_voxels = 2048;

/// render.memory in bytes.
std::size_t texture_budget(const RenderSettings& render);

/// Whether the volume's texture would be larger than render.memory or most_texture_voxels, or its voxels stay
/// on disk, so that it is drawn through a pool of bricks. Not for pipelines without textures (`reference`).
bool is_paged(const PreparedScene& prepared);

/// Whether one of the scene's volumes is.
bool any_paged(const PreparedScene& prepared);

/// Throws UsageError for what needs the volume in one texture, where is_paged.
void refuse_unpaged_settings(const PreparedScene& prepared);

/// One level of the pyramid, level 0 the volume itself.
struct PageLevel {
  std::array<std::size_t, 3> voxels{1, 1, 1};
  std::array<std::size_t, 3> pages{1, 1, 1};
  std::size_t first = 0; ///< number of its first page; x runs fastest, then y, then z
  std::size_t layer = 0; ///< of the page table along z, where its pages begin
};

/// Pages of all levels. Page (x, y, z) of a level holds its voxels edge·(x, y, z) to edge·(x+1, y+1, z+1),
/// the last ones less.
struct PageGrid {
  std::size_t edge = 32;
  /// Voxels around a page that are loaded with it: as far as the filter reaches, and a gradient's step.
  std::size_t overlap = 1;
  std::vector<PageLevel> levels;
  std::size_t count = 0; ///< of pages
};

/// Texels along the edge of a brick: a page with its overlap.
inline std::size_t brick_edge(const PageGrid& grid) { return grid.edge + 2 * grid.overlap; }

PageGrid page_grid(const PreparedScene& prepared);

struct PageAddress {
  std::size_t level = 0;
  std::array<std::size_t, 3> at{0, 0, 0};
};
PageAddress address_of(const PageGrid& grid, std::size_t page);

/// What is known of a page without its voxels.
struct PageContent {
  float value = 0;     ///< stands for all of it where it is not loaded, data units
  bool needed = false; ///< its voxels can matter to the picture
};

/// By the cells of the volume (prepared.cells): a page is not needed where its voxels are all the same, where
/// the transfer function shows nothing of them (modes `dvr`, `xray`, `mip` and `minip`), or where the
/// isovalue does not lie among them; nor a page of a finer level than lenses ask for.
std::vector<PageContent> page_contents(const PreparedScene& prepared, const PageGrid& grid);

/// What a box of the displayed volume covers, its depths as distances from the eye where samples count so.
ScreenCover cover_of_samples(const PreparedScene& prepared, const Bounds& shown);

/// A page that the view may show: the pixels that it covers, from the bottom left corner, and the slices, as
/// a range of k + ½ (along the ray from the eye for shells and rays under perspective).
struct PageNeed {
  std::uint32_t page = 0;
  float bottom = 0;
  float top = 0;
  float near = 0;
  float far = 0;
};

/// In ascending order of page numbers. Conservative under every warp; where no bounds are known (warp/
/// object_bounds.h) a page may be anywhere.
std::vector<PageNeed> page_needs(const PreparedScene& prepared, const PageGrid& grid,
                                 std::span<const PageContent> contents);

/// Entries [begin, end) of the drawing order and the pages that they need, of each volume in turn.
struct PagedPart {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::vector<std::vector<std::uint32_t>> pages;
};

/// Rows of pixels [bottom, top) and the parts that are drawn into them in turn.
struct PagedBand {
  int bottom = 0;
  int top = 0;
  std::vector<PagedPart> parts;
};

/// What one volume needs and how many bricks its pool holds.
struct PagedVolume {
  std::span<const PageNeed> needs;
  std::size_t capacity = 0;
};

/// Parts as long as the pools allow; where one entry alone needs more, the picture is cut into bands. Entries
/// are in drawing order: numbers ascend or descend. Throws LimitError where one entry in 8 rows of pixels
/// still needs too many.
std::vector<PagedBand> paged_bands(std::span<const PagedVolume> volumes,
                                   std::span<const SliceNumbers> entries, int height);

} // namespace slicelens
