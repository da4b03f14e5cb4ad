// The pool of bricks that a volume larger than render.memory is drawn through, and the page table that finds
// them (shaders/gpu/pages.glsl; docs/bricks.md).
#pragma once

#include "gl/program.h"
#include "gl/texture.h"
#include "render/pages.h"
#include "render/pre_classification.h"
#include "render/texels.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace slicelens {

/// What a pool has done so far.
struct PoolCounts {
  std::size_t pages = 0;         ///< of all levels of the volume
  std::size_t needed = 0;        ///< those whose voxels can matter under this transfer function
  std::size_t capacity = 0;      ///< bricks that it holds at once
  std::size_t parts = 0;         ///< times that pages were asked for
  std::size_t loads = 0;         ///< bricks loaded, one that was dropped and came back twice
  double seconds = 0;            ///< of wall clock that loading took, a part of drawing
  std::uint64_t read_bytes = 0;  ///< taken from the volume's file
  std::size_t texture_bytes = 0; ///< of the pool and its table
};

/// Textures of one volume's bricks. The driver's context must be current for all of it.
class BrickPool {
public:
  /// Makes the textures, without bricks: as many as the volume needs at most, or render.memory holds. Throws
  /// LimitError where not even one fits or the driver has no room.
  BrickPool(const gl::Functions& gl, const PreparedScene& prepared);

  const PageGrid& grid() const { return grid_; }
  std::span<const PageContent> contents() const { return contents_; }
  std::size_t capacity() const { return slots_.size(); }
  PoolCounts counts() const;

  /// Loads the pages that are not there, each in place of the one that was asked for longest ago. At most
  /// capacity() of them, ascending. Throws FileError where a volume on disk cannot be read.
  void require(const PreparedScene& prepared, std::span<const std::uint32_t> pages);

  /// Binds the voxels and the table and sets what shaders/gpu/pages.glsl declares; the program is in use.
  void bind(const gl::Functions& gl, const gl::Uniforms& program, GLenum voxel_unit, GLenum table_unit) const;
  /// Rows of labels beside the voxels, mode `two-level` only.
  const gl::Texture& labels() const { return labels_; }

private:
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
  struct Slot {
    std::uint32_t page = nothing;
    std::uint64_t asked = 0; ///< number of the last call of require() that needed it
  };

  void make_textures(const PreparedScene& prepared, std::size_t wanted);
  void fill_table(const PreparedScene& prepared);
  std::vector<std::uint32_t> assign(std::span<const std::uint32_t> pages);
  void place(std::uint32_t page, std::size_t slot);
  void upload(std::size_t slot, std::span<const std::byte> voxels, std::span<const std::byte> labels);
  std::array<int, 3> slot_at(std::size_t slot) const;
  void load(const PreparedScene& prepared, std::span<const std::uint32_t> slots);

  const gl::Functions* gl_;
  PageGrid grid_;
  std::vector<PageContent> contents_;
  TexelCoding coding_;
  gl::TextureSpec spec_;
  VoxelClassifier classifier_; ///< classification `pre` only
  std::size_t texel_bytes_ = 4;
  std::array<int, 3> slots_along_{1, 1, 1};
  gl::Texture voxels_;
  gl::Texture labels_;
  gl::Texture table_;
  std::vector<glm::vec4> entries_; ///< of the table
  std::array<std::size_t, 3> table_size_{1, 1, 1};
  bool table_changed_ = true;
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> slot_of_; ///< of each page
  std::uint64_t calls_ = 0;
  std::size_t loads_ = 0;
  double seconds_ = 0;
  std::uint64_t read_before_ = 0;
  std::uint64_t read_bytes_ = 0;
};

} // namespace slicelens
