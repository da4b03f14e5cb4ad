#include "console.h"
#include "json_output.h"
#include "options.h"
#include "scene/load.h"
#include "study/inputs.h"
#include "volume/on_disk.h"
#include "volume/read.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <utility>

namespace slicelens::cli {

namespace {

/// Files from this size on are described without being held in memory, where their format allows it.
constexpr std::uintmax_t large_file = std::uintmax_t{1} << 30;

Volume volume_for(const SceneInput& input) {
  const VolumeSource source = source_of(input.scene.volume, input.folders);
  const VolumeAccess access = input.scene.volume.access;
  if (access == VolumeAccess::stream || access == VolumeAccess::cache)
    return load_volume(input.scene.volume, input.folders, console_progress());
  std::uintmax_t bytes = 0;
  for (const std::filesystem::path& file : files_of(source))
    bytes += std::filesystem::file_size(file);
  if (access == VolumeAccess::automatic && bytes > large_file) {
    if (std::optional<Volume> streamed = stream_volume(source, console_progress()))
      return std::move(*streamed);
  }
  return read_volume(source, console_progress());
}

} // namespace

void run_info(const InfoOptions& options) {
  std::vector<std::string> set = {"volume.file=" + options.input};
  set.insert(set.end(), options.set.begin(), options.set.end());
  const SceneInput input = scene_text_input("{}", options.input, set);
  const Volume volume = volume_for(input);
  end_progress();
  if (options.json) {
    std::printf("%s\n", volume_json(volume).c_str());
    return;
  }
  const auto vector = [](const char* name, const glm::dvec3& v) {
    std::printf("%-10s %.9g %.9g %.9g\n", name, v.x, v.y, v.z);
  };
  std::printf("%-10s %zu %zu %zu\n", "dims", volume.dims[0], volume.dims[1], volume.dims[2]);
  vector("spacing", volume.spacing);
  vector("origin", volume.origin);
  for (int axis = 0; axis < 3; ++axis)
    vector(axis == 0 ? "direction" : "", volume.direction[axis]);
  std::printf("%-10s %s\n%-10s %.9g %.9g\n%-10s %.9g\n%-10s %d\n%-10s %zu\n%-10s %s\n", "type",
              name_of(volume.type).c_str(), "range", volume.min, volume.max, "mean", volume.mean,
              "components", volume.components, "frames", volume.frames, "format", volume.format.c_str());
  if (volume.non_finite > 0)
    std::printf("%-10s %zu\n", "non-finite", volume.non_finite);
}

} // namespace slicelens::cli
