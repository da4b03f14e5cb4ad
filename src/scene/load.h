// From a scene's sections `volume` and `transfer` to the data they name.
#pragma once

#include "core/progress.h"
#include "scene/scene.h"
#include "volume/read.h"
#include "volume/transfer.h"

#include <filesystem>
#include <vector>

namespace slicelens {

/// The file that `volume.file` names: itself when absolute, else the first of `folders` it exists in, else
/// relative to the first. Throws FileError naming the places when it exists in none of them.
/// `key` is the scene key that the message proposes to set.
std::filesystem::path resolve_file(const std::string& file, const std::vector<std::filesystem::path>& folders,
                                   const std::string& key = "volume.file");

/// The reader's request for a scene's volume; `settings.file` must be set.
VolumeSource source_of(const VolumeSettings& settings, const std::vector<std::filesystem::path>& folders);

/// Reads the file or makes the phantom. The result has one component: several need `volume.component`, or a
/// UsageError says so.
Volume load_volume(const VolumeSettings& settings, const std::vector<std::filesystem::path>& folders,
                   const Progress& progress);

/// Puts what transfer.file (as points) and camera.file (as position, focal point …) hold in their place, so
/// that the scene stands alone. Tables without transfer.range are stretched over the data's range, those of
/// 256 rows for uint8 data over [0, 255]. Warns, one line for each file, of what was resampled, assumed or
/// left out, and when the data lie wholly outside of the points.
void load_transfer_and_camera(Scene& scene, const Volume& volume,
                              const std::vector<std::filesystem::path>& folders, const Progress& progress);

/// The values of the first and the last row of a table for this volume.
glm::dvec2 table_range(const Volume& volume, std::size_t rows);

/// The transfer function of the scene: its points, its preset, or without either the automatic one for this
/// volume (the phantom's own preset for phantoms). A file must have been loaded before; else
/// UsageError.
TransferFunction transfer_of(const Scene& scene, const Volume& volume);

} // namespace slicelens
