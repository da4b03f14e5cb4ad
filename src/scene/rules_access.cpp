#include "core/errors.h"
#include "scene/names.h"
#include "scene/rules.h"

namespace slicelens {

std::optional<std::string> what_needs_voxels(const Scene& scene) {
  const RenderSettings& render = scene.render;
  if (render.pipeline == Pipeline::reference || render.pipeline == Pipeline::fixed_function)
    return "render.pipeline '" + word(render.pipeline) + "'";
  const bool own_texture =
      render.gradient == Gradient::prefiltered || render.gradient == Gradient::precomputed;
  if (uses_gradients(scene) && own_texture)
    return "render.gradient '" + word(render.gradient) + "'";
  return std::nullopt;
}

void validate_access(const Scene& scene) {
  const VolumeSettings& volume = scene.volume;
  const std::string access = "volume.access '" + word(volume.access) + "'";
  const bool on_disk = volume.access == VolumeAccess::stream || volume.access == VolumeAccess::cache;
  if (volume.cache && volume.cache->empty())
    throw UsageError("volume.cache is empty; name a file, or remove it for one in the user's cache folder");
  if (volume.cache && (volume.access == VolumeAccess::memory || volume.access == VolumeAccess::stream))
    throw UsageError("volume.cache names a copy of the voxels, which " + access +
                     " does not make; set volume.access to cache or auto, or remove volume.cache");
  if (on_disk && volume.phantom)
    throw UsageError(access + " leaves voxels in a file, and a phantom has none; set it to memory, or write "
                              "the phantom to a file first (slicelens phantom)");
  if (volume.cache && volume.phantom)
    throw UsageError("volume.cache is a copy of a file, and a phantom has none; remove it");
  if (!on_disk)
    return;
  if (const auto what = what_needs_voxels(scene))
    throw UsageError(*what + " needs all voxels at once, which " + access +
                     " does not hold; set volume.access to memory");
  if (volume.access == VolumeAccess::stream &&
      (scene.render.levels > 1 || scene.render.footprint == Footprint::mip))
    throw UsageError(std::string(scene.render.levels > 1 ? "render.levels" : "render.footprint 'mip'") +
                     " needs coarser copies of the volume, which " + access +
                     " does not make; set volume.access to cache or memory");
}

} // namespace slicelens
