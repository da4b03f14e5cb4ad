// From a scene's label volume and its table to the data they name.
#pragma once

#include "scene/load.h"

#include <optional>
#include <vector>

namespace slicelens {

/// What mode `two-level` needs beside the volume.
struct LoadedLabels {
  Volume volume;
  /// One for each entry of scene.labels; none: the scene's own.
  std::vector<std::optional<TransferFunction>> transfers;
};

/// The phantom of that name, with the volume's own size, or the file. Throws UsageError, FileError.
Volume load_label_volume(const Scene& scene, const Volume& volume,
                         const std::vector<std::filesystem::path>& folders, const Progress& progress);

/// The transfer functions of the scene's table. Points of files take the place of the files in `scene`.
std::vector<std::optional<TransferFunction>>
load_label_transfers(Scene& scene, const Volume& volume, const std::vector<std::filesystem::path>& folders,
                     const Progress& progress);

/// Both, or nothing under other modes than `two-level`.
std::optional<LoadedLabels> load_labels(Scene& scene, const Volume& volume,
                                        const std::vector<std::filesystem::path>& folders,
                                        const Progress& progress);

/// The label volume's file, where it is one that the scene uses.
std::optional<std::filesystem::path> label_file(const Scene& scene,
                                                const std::vector<std::filesystem::path>& folders);

} // namespace slicelens
