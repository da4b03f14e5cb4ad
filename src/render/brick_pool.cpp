#include "render/brick_pool.h"

#include "core/errors.h"
#include "core/stopwatch.h"
#include "render/brick_filling.h"
#include "render/gpu_scene.h"
#include "volume/streamed.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace slicelens {

namespace {

/// x of a table entry whose page is not in the pool; above no_place of shaders/gpu/pages.glsl.
constexpr float absent = 2e9F;

/// Bytes of texels that are made before they are handed to the driver.
constexpr std::size_t staged_bytes = std::size_t{64} << 20;

/// Bricks on each axis of a texture: of those with room for `wanted` the smallest, or with the room that
/// there is for `most` the largest; at most `limit` on an axis.
std::array<int, 3> arranged(std::size_t wanted, std::size_t most, int limit) {
  std::array<int, 3> best{1, 1, 1};
  std::size_t best_count = 1;
  for (int x = 1; x <= limit; ++x) {
    for (int y = 1; y <= x; ++y) {
      const auto plane = static_cast<std::size_t>(x) * static_cast<std::size_t>(y);
      const std::size_t depth =
          std::min({(wanted + plane - 1) / plane, most / plane, static_cast<std::size_t>(limit)});
      const std::size_t count = plane * depth;
      const bool better = best_count < wanted ? count > best_count : count >= wanted && count < best_count;
      if (depth > 0 && better) {
        best = {x, y, static_cast<int>(depth)};
        best_count = count;
      }
    }
  }
  return best;
}

std::size_t product(const std::array<int, 3>& n) {
  return static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]) * static_cast<std::size_t>(n[2]);
}

} // namespace

BrickPool::BrickPool(const gl::Functions& gl, const PreparedScene& prepared)
    : gl_(&gl), grid_(page_grid(prepared)), contents_(page_contents(prepared, grid_)) {
  if (prepared.scene.render.classification == Classification::pre) {
    classifier_ = voxel_classifier(prepared);
    texel_bytes_ = classified_voxel_bytes;
    spec_.format = GL_RGBA8;
  } else {
    coding_ = texel_coding(prepared);
    texel_bytes_ = coding_.bytes;
    spec_.format = coding_.gl_format;
  }
  spec_.filter = texture_filter(prepared.scene.render.filter);
  const auto needed = static_cast<std::size_t>(
      std::count_if(contents_.begin(), contents_.end(), [](const PageContent& page) { return page.needed; }));
  make_textures(prepared, std::max<std::size_t>(1, needed));
  fill_table(prepared);
  if (is_streamed(prepared.volume))
    read_before_ = prepared.volume.streamed->stream->bytes_read();
}

void BrickPool::make_textures(const PreparedScene& prepared, std::size_t wanted) {
  const std::size_t edge = brick_edge(grid_);
  const bool labelled = !prepared.labels.table.empty();
  const std::size_t brick_bytes = edge * edge * edge * (texel_bytes_ + (labelled ? 1 : 0));
  const std::size_t budget = texture_budget(prepared.scene.render);
  if (budget < brick_bytes)
    throw LimitError("render.memory holds not even one brick of " + std::to_string(edge) +
                     " voxels an edge; raise it or make render.brick smaller");
  GLint limit = 0;
  gl_->GetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &limit);
  const int most = std::min(limit, static_cast<int>(most_texture_voxels)) / static_cast<int>(edge);
  if (most < 1)
    throw LimitError("a brick of " + std::to_string(edge) + " voxels an edge is larger than this driver's " +
                     std::to_string(limit) + "; make render.brick smaller");
  slots_along_ = arranged(std::min(wanted, budget / brick_bytes), budget / brick_bytes, most);
  std::array<int, 3> size{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    size[axis] = slots_along_[axis] * static_cast<int>(edge);
  voxels_ = gl::make_texture_3d(*gl_, spec_, size, std::span<const std::byte>{});
  if (labelled) {
    gl::TextureSpec spec;
    spec.format = GL_R8UI;
    spec.filter = GL_NEAREST;
    labels_ = gl::make_texture_3d(*gl_, spec, size, std::span<const std::byte>{});
  }
  slots_.resize(product(slots_along_));
  slot_of_.assign(grid_.count, nothing);
}

void BrickPool::fill_table(const PreparedScene& prepared) {
  for (const PageLevel& level : grid_.levels) {
    table_size_[0] = std::max(table_size_[0], level.pages[0]);
    table_size_[1] = std::max(table_size_[1], level.pages[1]);
    table_size_[2] = level.layer + level.pages[2];
  }
  entries_.assign(table_size_[0] * table_size_[1] * table_size_[2], glm::vec4(absent, 0, 0, 0));
  // Classified voxels of a page that is not loaded are transparent, others have its value.
  const bool values = prepared.scene.render.classification != Classification::pre;
  for (std::size_t page = 0; page < grid_.count && values; ++page) {
    const PageAddress address = address_of(grid_, page);
    const std::size_t layer = grid_.levels[address.level].layer + address.at[2];
    const glm::dvec2 value(coding_.value_from_texel);
    entries_[(layer * table_size_[1] + address.at[1]) * table_size_[0] + address.at[0]].w =
        static_cast<float>((static_cast<double>(contents_[page].value) - value.y) / value.x);
  }
  gl::TextureSpec spec;
  spec.format = GL_RGBA32F;
  spec.filter = GL_NEAREST;
  const auto size = [&](std::size_t axis) { return static_cast<int>(table_size_[axis]); };
  table_ = gl::make_texture_3d(*gl_, spec, {size(0), size(1), size(2)}, std::as_bytes(std::span(entries_)));
}

PoolCounts BrickPool::counts() const {
  PoolCounts counts;
  counts.pages = grid_.count;
  counts.needed = static_cast<std::size_t>(
      std::count_if(contents_.begin(), contents_.end(), [](const PageContent& page) { return page.needed; }));
  counts.capacity = slots_.size();
  counts.parts = static_cast<std::size_t>(calls_);
  counts.loads = loads_;
  counts.seconds = seconds_;
  counts.read_bytes = read_bytes_;
  const std::size_t edge = brick_edge(grid_);
  counts.texture_bytes = slots_.size() * edge * edge * edge * (texel_bytes_ + (labels_ ? 1 : 0)) +
                         entries_.size() * sizeof(glm::vec4);
  return counts;
}

std::array<int, 3> BrickPool::slot_at(std::size_t slot) const {
  const int i = static_cast<int>(slot);
  const int edge = static_cast<int>(brick_edge(grid_));
  return {i % slots_along_[0] * edge, i / slots_along_[0] % slots_along_[1] * edge,
          i / slots_along_[0] / slots_along_[1] * edge};
}

void BrickPool::place(std::uint32_t page, std::size_t slot) {
  const PageAddress address = address_of(grid_, page);
  const std::size_t layer = grid_.levels[address.level].layer + address.at[2];
  glm::vec4& entry = entries_[(layer * table_size_[1] + address.at[1]) * table_size_[0] + address.at[0]];
  if (slot == nothing) {
    entry.x = absent;
  } else {
    const std::array<int, 3> at = slot_at(slot);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      entry[axis] = static_cast<float>(at[a] + static_cast<int>(grid_.overlap) -
                                       static_cast<int>(address.at[a] * grid_.edge));
    }
  }
  slot_of_[page] = static_cast<std::uint32_t>(slot);
  table_changed_ = true;
}

/// Gives each page a slot; returns those that are to be filled, by ascending page.
std::vector<std::uint32_t> BrickPool::assign(std::span<const std::uint32_t> pages) {
  ++calls_;
  std::vector<std::uint32_t> missing;
  for (const std::uint32_t page : pages) {
    if (slot_of_[page] == nothing)
      missing.push_back(page);
    else
      slots_[slot_of_[page]].asked = calls_;
  }
  std::vector<std::uint32_t> free;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (slots_[i].page == nothing || slots_[i].asked < calls_)
      free.push_back(static_cast<std::uint32_t>(i));
  }
  if (free.size() < missing.size())
    throw GraphicsError("more pages are asked for at once than the pool has room for");
  std::stable_sort(free.begin(), free.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto age = [&](std::uint32_t i) { return slots_[i].page == nothing ? 0 : slots_[i].asked; };
    return age(a) < age(b);
  });
  free.resize(missing.size());
  for (std::size_t i = 0; i < missing.size(); ++i) {
    Slot& slot = slots_[free[i]];
    if (slot.page != nothing)
      place(slot.page, nothing);
    slot = {missing[i], calls_};
  }
  return free;
}

void BrickPool::upload(std::size_t slot, std::span<const std::byte> voxels,
                       std::span<const std::byte> labels) {
  const int edge = static_cast<int>(brick_edge(grid_));
  gl::update_texture_3d(*gl_, voxels_, spec_, slot_at(slot), {edge, edge, edge}, voxels);
  if (labels.empty())
    return;
  gl::TextureSpec spec;
  spec.format = GL_R8UI;
  gl::update_texture_3d(*gl_, labels_, spec, slot_at(slot), {edge, edge, edge}, labels);
}

/// Bricks are read and encoded on all cores, some dozens of MiB at a time, and handed to the driver by this
/// thread. A page is in the table only when it is in the pool.
void BrickPool::load(const PreparedScene& prepared, std::span<const std::uint32_t> slots) {
  std::vector<std::uint32_t> pages;
  for (const std::uint32_t slot : slots)
    pages.push_back(slots_[slot].page);
  EncodeRun encode = [this](const Volume& part, std::size_t first, std::size_t count, std::byte* out) {
    encode_run(part, coding_, first, count, out);
  };
  if (classifier_)
    encode = [this](const Volume& part, std::size_t first, std::size_t count, std::byte* out) {
      classifier_(part, first, {out, count * classified_voxel_bytes});
    };
  const std::size_t edge = brick_edge(grid_);
  const std::size_t bytes = edge * edge * edge * texel_bytes_;
  std::vector<BrickRow> rows =
      rows_of_bricks(grid_, pages, std::max<std::size_t>(1, staged_bytes / 16 / bytes));
  std::size_t next = 0; // in slots
  for (std::size_t begin = 0; begin < rows.size();) {
    std::size_t end = begin;
    for (std::size_t staged = 0; end < rows.size() && (end == begin || staged < staged_bytes); ++end)
      staged += rows[end].pages.size() * bytes;
    tbb::parallel_for(begin, end,
                      [&](std::size_t i) { fill_row(prepared, grid_, encode, texel_bytes_, rows[i]); });
    for (; begin < end; ++begin) {
      BrickRow& row = rows[begin];
      for (std::size_t i = 0; i < row.pages.size(); ++i, ++next) {
        const std::span<const std::byte> labels(row.labels);
        upload(slots[next], std::span<const std::byte>(row.voxels).subspan(i * bytes, bytes),
               labels.empty() ? labels : labels.subspan(i * edge * edge * edge, edge * edge * edge));
        place(row.pages[i], slots[next]);
      }
      row = {};
    }
  }
  loads_ += slots.size();
  if (is_streamed(prepared.volume))
    read_bytes_ = prepared.volume.streamed->stream->bytes_read() - read_before_;
}

void BrickPool::require(const PreparedScene& prepared, std::span<const std::uint32_t> pages) {
  const Stopwatch watch;
  const std::vector<std::uint32_t> slots = assign(pages);
  try {
    load(prepared, slots);
  } catch (...) {
    for (const std::uint32_t slot : slots) { // nothing is in the table that is not in the pool
      if (slots_[slot].page != nothing && slot_of_[slots_[slot].page] == nothing)
        slots_[slot] = {};
    }
    throw;
  }
  if (table_changed_) {
    gl::TextureSpec spec;
    spec.format = GL_RGBA32F;
    const auto size = [&](std::size_t axis) { return static_cast<int>(table_size_[axis]); };
    gl::update_texture_3d(*gl_, table_, spec, {0, 0, 0}, {size(0), size(1), size(2)},
                          std::as_bytes(std::span(entries_)));
    table_changed_ = false;
  }
  seconds_ += watch.seconds();
}

void BrickPool::bind(const gl::Functions& gl, const gl::Uniforms& program, GLenum voxel_unit,
                     GLenum table_unit) const {
  gl.ActiveTexture(GL_TEXTURE0 + voxel_unit);
  gl.BindTexture(GL_TEXTURE_3D, voxels_.name());
  set_uniform(gl, program, "volume_texture", static_cast<int>(voxel_unit));
  gl.ActiveTexture(GL_TEXTURE0 + table_unit);
  gl.BindTexture(GL_TEXTURE_3D, table_.name());
  set_uniform(gl, program, "page_texture", static_cast<int>(table_unit));
  const int edge = static_cast<int>(brick_edge(grid_));
  set_uniform(gl, program, "texture_from_pool",
              1.0F / glm::vec3(slots_along_[0] * edge, slots_along_[1] * edge, slots_along_[2] * edge));
  set_uniform(gl, program, "pages_from_voxels", 1.0F / static_cast<float>(grid_.edge));
  std::vector<glm::vec4> voxels;
  std::vector<glm::vec4> pages;
  const std::array<std::size_t, 3> finest = grid_.levels.front().voxels;
  for (std::size_t k = 0; k < grid_.levels.size(); ++k) {
    const PageLevel& level = grid_.levels[k];
    voxels.emplace_back(std::ldexp(static_cast<float>(finest[0]), -static_cast<int>(k)),
                        std::ldexp(static_cast<float>(finest[1]), -static_cast<int>(k)),
                        std::ldexp(static_cast<float>(finest[2]), -static_cast<int>(k)), 0.0F);
    pages.emplace_back(level.pages[0] - 1, level.pages[1] - 1, level.pages[2] - 1, level.layer);
  }
  set_uniform(gl, program, "level_voxels", std::span<const glm::vec4>(voxels));
  set_uniform(gl, program, "level_pages", std::span<const glm::vec4>(pages));
}

} // namespace slicelens
