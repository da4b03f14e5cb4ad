#include "scene/load.h"

#include "core/errors.h"
#include "core/text.h"
#include "scene/camera_files.h"
#include "scene/rules.h"
#include "scene/transfer_files.h"
#include "scene/volume_texture.h"
#include "volume/on_disk.h"
#include "volume/phantom.h"

#include <optional>
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

VoxelBudget budget_of(const Scene& scene) {
  VoxelBudget budget;
  const RenderSettings& render = scene.render;
  budget.levels = render.levels;
  if (render.footprint == Footprint::mip && render.levels == 1)
    budget.levels = max_levels; // as many as the picture will need
  budget.texture = render.volume_texture;
  if (!what_needs_voxels(scene))
    budget.bytes = std::uintmax_t{render.memory.value_or(default_memory)} << 20;
  return budget;
}

namespace {

/// A file that need not be there yet: relative names count from the scene's own folder.
fs::path beside_scene(const std::string& file, const std::vector<fs::path>& folders) {
  const fs::path path(file);
  return path.is_absolute() || folders.empty() ? path : folders.front() / path;
}

/// Whether the budget holds all voxels of a volume like this.
bool fits(const Volume& volume, const VoxelBudget& budget) {
  return voxel_count(volume) <= budget.bytes / texel_bytes(budget.texture, volume.type);
}

Volume stream_or_refuse(const VolumeSource& source, const VoxelBudget& budget, const Progress& progress) {
  if (budget.levels > 1)
    throw UsageError("volume.access 'stream' has no coarser levels, which render.levels and render.footprint "
                     "ask for; set it to cache or memory");
  std::optional<Volume> volume = stream_volume(source, progress);
  if (!volume) {
    throw UsageError("volume.access 'stream' needs the voxels as they are in the file (raw, raw NRRD and "
                     "MetaImage, DICOM) and one component; " +
                     source.file.string() + " has not; set it to cache or memory");
  }
  return std::move(*volume);
}

/// Files of formats whose headers are not read alone are taken for this many times their size at most, unless
/// they are read anyway.
constexpr std::uintmax_t usual_expansion = 8;

bool may_be_large(const VolumeSource& source, const VoxelBudget& budget) {
  std::uintmax_t bytes = 0;
  for (const fs::path& file : files_of(source))
    bytes += fs::file_size(file);
  return bytes > budget.bytes / usual_expansion;
}

/// volume.access `auto`: in memory what the budget holds, else streamed, else copied in bricks.
Volume read_by_size(const VolumeSource& source, const CacheRequest& cache, const Progress& progress,
                    const VoxelBudget& budget) {
  if (budget.bytes == std::numeric_limits<std::uintmax_t>::max())
    return read_volume(source, progress);
  const std::optional<VolumeOutline> outline = outline_of(source);
  if (outline) {
    const bool several = outline->volume.components > 1 && !source.component;
    if (several || fits(outline->volume, budget))
      return read_volume(source, progress);
    if (outline->streams && budget.levels == 1)
      return stream_or_refuse(source, budget, progress);
    return cached_volume(source, cache, progress);
  }
  if (may_be_large(source, budget)) {
    if (std::optional<Volume> copy = cached_already(source, cache, progress))
      return std::move(*copy);
  }
  Volume volume = read_volume(source, progress);
  if (volume.components > 1 || fits(volume, budget))
    return volume;
  return cached_volume(source, cache, progress, std::move(volume));
}

Volume read_as_asked(const VolumeSettings& settings, const std::vector<fs::path>& folders,
                     const Progress& progress, const VoxelBudget& budget) {
  const VolumeSource source = source_of(settings, folders);
  CacheRequest cache;
  cache.levels = budget.levels;
  if (settings.cache)
    cache.file = beside_scene(*settings.cache, folders);
  switch (settings.access) {
  case VolumeAccess::memory:
    return read_volume(source, progress);
  case VolumeAccess::stream:
    return stream_or_refuse(source, budget, progress);
  case VolumeAccess::cache:
    return cached_volume(source, cache, progress);
  case VolumeAccess::automatic:
    break;
  }
  return read_by_size(source, cache, progress, budget);
}

} // namespace

Volume load_volume(const VolumeSettings& settings, const std::vector<fs::path>& folders,
                   const Progress& progress, const VoxelBudget& budget) {
  if (!settings.file) {
    const std::string& name = settings.phantom.value_or("head");
    return make_phantom(name, settings.size.value_or(phantom_info(name).size), progress);
  }
  Volume volume = read_as_asked(settings, folders, progress, budget);
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
                                 " voxels are NaN or infinite and are drawn as " +
                                 (is_streamed(volume) ? "the smallest value" : "empty"));
  }
  return volume;
}

glm::dvec2 table_range(const Volume& volume, std::size_t rows) {
  if (volume.type == ScalarType::u8 && rows == 256)
    return {0, 255};
  return volume.min < volume.max ? glm::dvec2(volume.min, volume.max)
                                 : glm::dvec2(volume.min - 1, volume.min);
}

void load_transfer_file(TransferSettings& settings, const Volume& volume,
                        const std::vector<fs::path>& folders, const Progress& progress) {
  if (!settings.file)
    return;
  const fs::path path = resolve_file(*settings.file, folders, "transfer.file");
  const TransferFile file = read_transfer_file(path, settings.map.value_or(""));
  auto range = settings.range;
  if (file.rows && !range)
    range = table_range(volume, file.color.points.size());
  ReadTransfer read = transfer_of(file, path, range);
  const auto& points = read.transfer.points;
  std::string note = read.note;
  if (points.back().value < volume.min || points.front().value > volume.max) {
    note += (note.empty() ? "" : "; ") + std::string("its points lie from ") +
            number_text(points.front().value) + " to " + number_text(points.back().value) +
            ", the data from " + number_text(volume.min) + " to " + number_text(volume.max) +
            ": give transfer.range";
  }
  if (!note.empty())
    report_warning(progress, *settings.file + ": " + note);
  if (!settings.unit_distance)
    settings.unit_distance = read.transfer.unit_distance;
  settings.points.emplace();
  for (const TransferPoint& p : points)
    settings.points->push_back({p.value, p.r, p.g, p.b, p.opacity});
  settings.file.reset();
  settings.map.reset();
  settings.range.reset();
}

void load_camera_file(Scene& scene, const std::vector<fs::path>& folders, const Progress& progress) {
  if (!scene.camera.file)
    return;
  const std::string name = *scene.camera.file;
  const double zoom = scene.camera.zoom;
  const ReadCamera read = read_camera_file(resolve_file(name, folders, "camera.file"));
  if (!read.ignored.empty())
    report_warning(progress, name + ": not taken: " + read.ignored);
  scene.camera = read.camera;
  scene.camera.zoom = zoom;
  validate(scene);
}

TransferFunction transfer_of(const Scene& scene, const Volume& volume) {
  const TransferSettings& settings = scene.transfer;
  TransferFunction transfer;
  if (settings.file)
    throw UsageError("transfer.file " + *settings.file + " has not been read");
  if (!settings.shapes.empty()) {
    transfer = preset("grey-ramp", volume.min, volume.max); // for what shows single values
    transfer.name = "shapes";
  } else if (settings.points) {
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
  Scene one = scene_of_volume(scene, index);
  LoadedVolume loaded;
  loaded.volume = load_volume(one.volume, folders, progress, budget_of(scene));
  load_transfer_file(one.transfer, loaded.volume, folders, progress);
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
