#include "scene/load.h"

#include "core/errors.h"
#include "volume/phantom.h"

#include <system_error>
#include <utility>

namespace slicelens {

namespace fs = std::filesystem;

fs::path resolve_file(const std::string& file, const std::vector<fs::path>& folders, const std::string& key) {
  const fs::path path(file);
  if (path.is_absolute() || folders.empty())
    return path;
  std::string looked;
  for (const fs::path& folder : folders) {
    std::error_code error;
    // A pattern (slices_%03d.png, slices_*.png) exists as soon as its folder does.
    const bool pattern = file.find_first_of("*%") != std::string::npos;
    const fs::path candidate = folder / path;
    if (fs::exists(pattern ? candidate.parent_path() : candidate, error))
      return candidate;
    looked += (looked.empty() ? "" : " or ") + (folder.empty() ? std::string(".") : folder.string());
  }
  if (folders.size() == 1)
    throw FileError(file, "there is no such file or folder; check the name");
  throw FileError(file, "not found in " + looked + "; give another path with --set " + key + "=…");
}

VolumeSource source_of(const VolumeSettings& settings, const std::vector<fs::path>& folders) {
  VolumeSource source;
  source.file = resolve_file(*settings.file, folders);
  source.size = settings.size;
  source.type = settings.type;
  source.spacing = settings.spacing;
  source.big_endian = settings.big_endian;
  if (settings.component)
    source.component = static_cast<int>(std::min<std::size_t>(*settings.component, 1000));
  source.frame = settings.frame;
  source.series = settings.series;
  return source;
}

Volume load_volume(const VolumeSettings& settings, const std::vector<fs::path>& folders,
                   const Progress& progress) {
  if (!settings.file) {
    const std::string& name = settings.phantom.value_or("head");
    return make_phantom(name, settings.size.value_or(phantom_info(name).size), progress);
  }
  Volume volume = read_volume(source_of(settings, folders), progress);
  if (holds_colors(volume))
    return with_luminance(volume);
  if (volume.components > 1) {
    throw UsageError(*settings.file + ": has " + std::to_string(volume.components) + " components a voxel" +
                     (volume.components > 2 ? " that are no colours of 8 or 16 bits" : "") +
                     "; choose one with volume.component (0 to " + std::to_string(volume.components - 1) +
                     ")");
  }
  if (volume.non_finite > 0) {
    report_warning(progress, *settings.file + ": " + std::to_string(volume.non_finite) +
                                 " voxels are NaN or infinite and are drawn as empty");
  }
  return volume;
}

TransferFunction transfer_of(const Scene& scene, const Volume& volume) {
  const TransferSettings& settings = scene.transfer;
  TransferFunction transfer;
  if (settings.points) {
    for (const auto& [value, r, g, b, opacity] : *settings.points)
      transfer.points.push_back({value, r, g, b, opacity});
    transfer.name = "points";
  } else if (settings.preset) {
    transfer = preset(*settings.preset, volume.min, volume.max);
  } else if (scene.volume.phantom) {
    transfer = preset(phantom_info(*scene.volume.phantom).preset, volume.min, volume.max);
  } else {
    transfer = automatic_transfer(volume);
  }
  if (settings.unit_distance)
    transfer.unit_distance = settings.unit_distance;
  transfer = windowed(std::move(transfer), settings.window, settings.level);
  validate(transfer);
  return transfer;
}

LoadedVolume load_volume_of(const Scene& scene, std::size_t index, const std::vector<fs::path>& folders,
                            const Progress& progress) {
  const Scene one = scene_of_volume(scene, index);
  LoadedVolume loaded;
  loaded.volume = load_volume(one.volume, folders, progress);
  loaded.transfer = transfer_of(one, loaded.volume);
  return loaded;
}

std::vector<LoadedVolume> load_others(const Scene& scene, const std::vector<fs::path>& folders,
                                      const Progress& progress) {
  std::vector<LoadedVolume> others;
  for (std::size_t i = 1; i < volume_count(scene); ++i)
    others.push_back(load_volume_of(scene, i, folders, progress));
  return others;
}

} // namespace slicelens
