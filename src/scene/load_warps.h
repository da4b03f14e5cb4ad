// From the warps of a scene to the files that they name.
#pragma once

#include "core/progress.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace slicelens {

/// Reads the files of the scene's landmarks and fields into the warps, with their SHA-256 (sha256_of: source
/// before target; all files of a field's volume). Paths are resolved as volume.file is.
/// Throws FileError for files that are missing, damaged or hold something else: a field needs three finite
/// components a voxel. UsageError for lists of different lengths.
void load_warp_files(Scene& scene, const std::vector<std::filesystem::path>& folders,
                     const Progress& progress);

/// The SHA-256 of what a warp has read, empty where it has read nothing.
std::string loaded_sha256(const Warp& warp);

/// A displacement field as it is in its file. `vectors`: of which axes. Throws as above.
DisplacementField read_field(const std::filesystem::path& path, FieldVectors vectors,
                             const Progress& progress);

} // namespace slicelens
