#include "study/sweep/scene_store.h"

#include <algorithm>
#include <iterator>

namespace slicelens {

namespace {

/// The same for scenes with the same volumes and labels.
std::string volumes_key(const SceneInput& input) {
  std::string key = input.folders.empty() ? "" : input.folders.front().string();
  for (std::size_t i = 0; i < volume_count(input.scene); ++i) {
    Scene alone;
    alone.volume = scene_of_volume(input.scene, i).volume;
    key += "\n" + scene_to_json(alone, -1);
  }
  return key;
}

std::size_t bytes_of(const PreparedScene& prepared) {
  std::size_t bytes = prepared.volume.voxels.size();
  for (const Volume& level : prepared.pyramid)
    bytes += level.voxels.size();
  for (const PreparedScene& other : prepared.others)
    bytes += bytes_of(other);
  return bytes;
}

} // namespace

const PreparedScene& SceneStore::get(const SceneInput& input, const Progress& progress) {
  const std::string key = volumes_key(input);
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.key == key; });
  if (found == entries_.end()) {
    make_room();
    entries_.push_front({key, load(input, progress)});
    return entries_.front().prepared;
  }
  entries_.splice(entries_.begin(), entries_, found);
  try {
    load_again(entries_.front().prepared, input, progress);
  } catch (...) {
    entries_.pop_front(); // it may be half of the old scene and half of the new one
    throw;
  }
  return entries_.front().prepared;
}

void SceneStore::make_room() {
  std::size_t held = 0;
  for (auto entry = entries_.begin(); entry != entries_.end();) {
    held += bytes_of(entry->prepared);
    entry = held > bytes_ ? entries_.erase(entry) : std::next(entry);
  }
}

std::string SceneStore::sha256(const SceneInput& input) {
  const std::string key = volumes_key(input);
  const auto found = hashes_.find(key);
  if (found != hashes_.end())
    return found->second;
  std::future<std::string> hashing = start_hash(input);
  return hashes_[key] = hashing.valid() ? hashing.get() : "";
}

} // namespace slicelens
