#include "render/paged_draw.h"

#include "core/errors.h"

#include <algorithm>

namespace slicelens {

namespace {

const GpuScene& scene_of(const GpuScene& scene, std::size_t volume) {
  return volume == 0 ? scene : scene.others[volume - 1];
}

/// Of volume `index`; nothing for one that is held whole. What it needs depends on the view, so each drawing
/// asks again.
std::vector<PageNeed> needs_of(const PreparedScene& prepared, const GpuScene& scene, std::size_t index) {
  const auto& pool = scene_of(scene, index).pool;
  if (!pool)
    return {};
  return page_needs(volume_at(prepared, index), pool->grid(), pool->contents());
}

void require(const PreparedScene& prepared, const GpuScene& scene, const PagedPart& part) {
  for (std::size_t i = 0; i < volume_count(prepared); ++i) {
    const auto& pool = scene_of(scene, i).pool;
    if (pool)
      pool->require(volume_at(prepared, i), part.pages[i]);
  }
}

bool has_pools(const GpuScene& scene) {
  return scene.pool || std::any_of(scene.others.begin(), scene.others.end(),
                                   [](const GpuScene& other) { return other.pool != nullptr; });
}

} // namespace

std::vector<PoolCounts> pool_counts(const GpuScene& scene) {
  std::vector<PoolCounts> counts;
  if (scene.pool)
    counts.push_back(scene.pool->counts());
  for (const GpuScene& other : scene.others) {
    if (other.pool)
      counts.push_back(other.pool->counts());
  }
  return counts;
}

void draw_in_parts(const gl::Functions& gl, const PreparedScene& prepared, const GpuScene& scene,
                   std::span<const SliceNumbers> numbers, const gl::Target& target, Splitting splitting,
                   const std::string& what, const std::function<void(std::size_t, std::size_t)>& draw) {
  if (!has_pools(scene)) {
    draw(0, numbers.size());
    return;
  }
  std::vector<std::vector<PageNeed>> needs;
  for (std::size_t i = 0; i < volume_count(prepared); ++i)
    needs.push_back(needs_of(prepared, scene, i));
  std::vector<PagedVolume> volumes;
  for (std::size_t i = 0; i < needs.size(); ++i) {
    const auto& pool = scene_of(scene, i).pool;
    volumes.push_back({needs[i], pool ? pool->capacity() : 0});
  }
  const std::vector<PagedBand> bands = paged_bands(volumes, numbers, target.height);
  const bool parts =
      std::any_of(bands.begin(), bands.end(), [](const PagedBand& band) { return band.parts.size() > 1; });
  if ((bands.size() > 1 && splitting != Splitting::everywhere) ||
      (parts && splitting == Splitting::nowhere)) {
    throw LimitError(what +
                     " cannot be drawn in such small parts as render.memory holds bricks for; raise it");
  }
  for (const PagedBand& band : bands) {
    if (bands.size() > 1) {
      gl.Enable(GL_SCISSOR_TEST);
      gl.Scissor(0, band.bottom, target.width, band.top - band.bottom);
    }
    for (const PagedPart& part : band.parts) {
      require(prepared, scene, part);
      draw(part.begin, part.end);
    }
  }
  if (bands.size() > 1)
    gl.Disable(GL_SCISSOR_TEST);
}

} // namespace slicelens
