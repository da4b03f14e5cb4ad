#include "scene/load_warps.h"

#include "core/errors.h"
#include "scene/landmark_files.h"
#include "scene/load.h"

#include <cmath>

namespace slicelens {

namespace fs = std::filesystem;

namespace {

void load_files(Landmarks& landmarks, const std::vector<fs::path>& folders) {
  if (landmarks.pairs)
    return;
  const bool texture = landmarks.space == LandmarkSpace::texture;
  if (landmarks.file) {
    const fs::path file = resolve_file(*landmarks.file, folders, "warp.file");
    landmarks.loaded = std::make_shared<const std::vector<LandmarkPair>>(read_landmark_pairs(file));
    landmarks.sha256 = sha256_of({file});
    return;
  }
  const fs::path source_file = resolve_file(landmarks.source.value_or(""), folders, "warp.source");
  const fs::path target_file = resolve_file(landmarks.target.value_or(""), folders, "warp.target");
  const std::vector<glm::dvec3> source = read_points(source_file, texture);
  const std::vector<glm::dvec3> target = read_points(target_file, texture);
  if (source.size() != target.size()) {
    throw UsageError("warp 'landmarks': " + *landmarks.source + " holds " + std::to_string(source.size()) +
                     " points and " + *landmarks.target + " " + std::to_string(target.size()) +
                     "; they must be as many, in the same order");
  }
  std::vector<LandmarkPair> pairs;
  for (std::size_t i = 0; i < source.size(); ++i)
    pairs.push_back({source[i], target[i]});
  landmarks.loaded = std::make_shared<const std::vector<LandmarkPair>>(std::move(pairs));
  landmarks.sha256 = sha256_of({source_file, target_file});
}

} // namespace

DisplacementField read_field(const fs::path& path, FieldVectors vectors, const Progress& progress) {
  VolumeSource source;
  source.file = path;
  const Volume volume = read_volume(source, progress);
  if (volume.components != 3) {
    throw FileError(path.string(), "has " + std::to_string(volume.components) +
                                       " component(s) a voxel; a displacement field has 3");
  }
  if (volume.non_finite > 0) {
    throw FileError(path.string(),
                    std::to_string(volume.non_finite) +
                        " of its numbers are NaN or infinite; a displacement field needs finite ones");
  }
  if (volume.frames > 1)
    throw FileError(path.string(),
                    "has " + std::to_string(volume.frames) + " frames; a displacement field has one");
  const bool ras =
      vectors == FieldVectors::ras || (vectors == FieldVectors::automatic && has_ras_displacements(path));
  const glm::dvec3 sign = ras ? glm::dvec3(-1, -1, 1) : glm::dvec3(1);
  DisplacementField field;
  field.dims = volume.dims;
  for (int axis = 0; axis < 3; ++axis)
    field.world_from_index[axis] = glm::dvec4(volume.direction[axis] * volume.spacing[axis], 0);
  field.world_from_index[3] = glm::dvec4(volume.origin, 1);
  const std::size_t count = voxel_count(volume);
  field.vectors.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 vector(scalar_at(volume, 3 * i), scalar_at(volume, 3 * i + 1),
                            scalar_at(volume, 3 * i + 2));
    field.vectors.emplace_back(sign * vector);
  }
  return field;
}

namespace {

void load_list(std::vector<Warp>& warps, const std::vector<fs::path>& folders, const Progress& progress) {
  for (Warp& warp : warps) {
    if (auto* landmarks = std::get_if<Landmarks>(&warp)) {
      load_files(*landmarks, folders);
    } else if (auto* field = std::get_if<Field>(&warp)) {
      const fs::path file = resolve_file(field->file, folders, "warp.file");
      field->loaded = std::make_shared<const DisplacementField>(read_field(file, field->vectors, progress));
      VolumeSource source;
      source.file = file;
      field->sha256 = sha256_of(files_of(source));
    }
  }
}

} // namespace

void load_warp_files(Scene& scene, const std::vector<fs::path>& folders, const Progress& progress) {
  load_list(scene.warp, folders, progress);
  for (VolumeLayer& layer : scene.others)
    load_list(layer.warp, folders, progress);
}

std::string loaded_sha256(const Warp& warp) {
  if (const auto* landmarks = std::get_if<Landmarks>(&warp))
    return landmarks->sha256;
  if (const auto* field = std::get_if<Field>(&warp))
    return field->sha256;
  return {};
}

} // namespace slicelens
