// Scene keys that change linearly from one frame of an animation to the next.
#pragma once

#include "scene/scene_json.h"

#include <string>
#include <vector>

namespace slicelens {

/// A key and its values in the first and at the last frame: JSON numbers, or lists of the same shape.
struct Variation {
  std::string key;
  std::string from;
  std::string to;
  bool whole = false; ///< a key of whole numbers: what lies between is rounded
};

/// Splits KEY=FROM:TO. Throws UsageError naming `text` when '=' or ':' is missing, when a value is no finite
/// number or list of such, or when the two lists have different lengths.
Variation parse_variation(const std::string& text);

/// The values (1 − t)·from + t·to, t in [0,1], as changes for scene_from_json. Ends are met exactly.
std::vector<KeyValue> changes_at(const std::vector<Variation>& variations, double t);

/// t of frame `index` of `count`: from 0 to 1; for a closed loop 1 is left out, because it shows the first
/// frame again. A single frame is the first one.
double time_of_frame(std::size_t index, std::size_t count, bool loop);

/// Whether `scene` holds whole numbers under `key`. False where it holds nothing or something else there.
bool is_whole_key(const Scene& scene, const std::string& key);

} // namespace slicelens
