// From a scene's sections `volume` and `transfer` to the data they name.
#pragma once

#include "core/progress.h"
#include "scene/scene.h"
#include "volume/read.h"
#include "volume/transfer.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <vector>

namespace slicelens {

/// The file that `volume.file` names: itself when absolute, else the first of `folders` it exists in, else
/// relative to the first. Throws FileError naming the places when it exists in none of them.
/// `key` is the scene key that the message proposes to set.
std::filesystem::path resolve_file(const std::string& file, const std::vector<std::filesystem::path>& folders,
                                   const std::string& key = "volume.file");

/// The reader's request for a scene's volume; `settings.file` must be set.
VolumeSource source_of(const VolumeSettings& settings, const std::vector<std::filesystem::path>& folders);

/// What textures may hold of a volume, which decides where volume.access `auto` leaves its voxels.
struct VoxelBudget {
  std::uintmax_t bytes = std::numeric_limits<std::uintmax_t>::max(); ///< the default keeps all in memory
  VolumeTexture texture = VolumeTexture::automatic;                  ///< whose texels are counted
  std::size_t levels = 1; ///< of the pyramid that a volume on disk needs beside its voxels
};

/// render.memory, or no limit where the scene needs all voxels at once.
VoxelBudget budget_of(const Scene& scene);

/// Reads the file or makes the phantom. The result has one component: several need `volume.component`, or a
/// UsageError says so. RGB and RGBA without volume.component become luminances with colours (with_luminance)
/// and are always held in memory. volume.access says where the voxels of other files are: a streamed volume
/// (volume/streamed.h) with `stream` and `cache`, and with `auto` where they are more than the budget. Throws
/// UsageError where the format cannot be streamed.
Volume load_volume(const VolumeSettings& settings, const std::vector<std::filesystem::path>& folders,
                   const Progress& progress, const VoxelBudget& budget = {});

/// Puts the points that a transfer.file holds in its place, so that the scene stands alone; nothing to do
/// without one. Tables without transfer.range are stretched over the data's range, those of 256 rows for
/// uint8 data over [0, 255]. Warns in one line of what was resampled, assumed or left out, and when the data
/// lie wholly outside of the points.
void load_transfer_file(TransferSettings& transfer, const Volume& volume,
                        const std::vector<std::filesystem::path>& folders, const Progress& progress);

/// The same for camera.file: position, focal point and so on take its place.
void load_camera_file(Scene& scene, const std::vector<std::filesystem::path>& folders,
                      const Progress& progress);

/// The values of the first and the last row of a table for this volume.
glm::dvec2 table_range(const Volume& volume, std::size_t rows);

/// A volume and its transfer function.
struct LoadedVolume {
  Volume volume;
  TransferFunction transfer;
};

/// load_volume and transfer_of for volume `index` of the scene.
LoadedVolume load_volume_of(const Scene& scene, std::size_t index,
                            const std::vector<std::filesystem::path>& folders, const Progress& progress);

/// The same for the volumes after the first.
std::vector<LoadedVolume> load_others(const Scene& scene, const std::vector<std::filesystem::path>& folders,
                                      const Progress& progress);

/// The transfer function of the scene: its points, its preset, or without either the automatic one for this
/// volume (the phantom's own preset for phantoms), stretched by transfer.window and transfer.level. Throws
/// UsageError for a transfer.file that has not been loaded.
TransferFunction transfer_of(const Scene& scene, const Volume& volume);

} // namespace slicelens
