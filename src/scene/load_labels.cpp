#include "scene/load_labels.h"

#include "core/errors.h"
#include "volume/phantom.h"

#include <algorithm>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

bool is_phantom(const std::string& name) {
  const std::vector<PhantomInfo>& all = phantoms();
  return std::any_of(all.begin(), all.end(), [&](const PhantomInfo& info) { return info.name == name; });
}

} // namespace

std::optional<fs::path> label_file(const Scene& scene, const std::vector<fs::path>& folders) {
  const auto& labels = scene.volume.labels;
  if (scene.render.mode != Mode::two_level || !labels || is_phantom(*labels))
    return std::nullopt;
  return resolve_file(*labels, folders, "volume.labels");
}

Volume load_label_volume(const Scene& scene, const Volume& volume, const std::vector<fs::path>& folders,
                         const Progress& progress) {
  const std::string& name = *scene.volume.labels;
  if (is_phantom(name))
    return make_phantom(name, volume.dims, progress);
  VolumeSource source;
  source.file = *label_file(scene, folders);
  Volume labels = read_volume(source, progress);
  if (labels.components > 1)
    throw UsageError("volume.labels " + name + ": has " + std::to_string(labels.components) +
                     " components a voxel; a label volume has one");
  return labels;
}

std::vector<std::optional<TransferFunction>> load_label_transfers(Scene& scene, const Volume& volume,
                                                                  const std::vector<fs::path>& folders,
                                                                  const Progress& progress) {
  std::vector<std::optional<TransferFunction>> transfers;
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    std::optional<TransferSettings>& own = scene.labels[i].transfer;
    transfers.emplace_back();
    if (!own)
      continue;
    try {
      load_transfer_file(*own, volume, folders, progress);
      Scene alone;
      alone.volume = scene.volume;
      alone.transfer = *own;
      transfers.back() = transfer_of(alone, volume);
    } catch (const UsageError& error) {
      throw UsageError("labels[" + std::to_string(i) + "].transfer: " + error.what());
    }
  }
  return transfers;
}

std::optional<LoadedLabels> load_labels(Scene& scene, const Volume& volume,
                                        const std::vector<fs::path>& folders, const Progress& progress) {
  if (scene.render.mode != Mode::two_level)
    return std::nullopt;
  LoadedLabels loaded;
  loaded.transfers = load_label_transfers(scene, volume, folders, progress);
  loaded.volume = load_label_volume(scene, volume, folders, progress);
  return loaded;
}

} // namespace slicelens
