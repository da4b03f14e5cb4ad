// Scenes as JSON texts: reading, writing, changing single keys.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace slicelens {

/// "render.spacing=0.5": a scene key and a value, JSON or plain text.
struct KeyValue {
  std::string key;
  std::string value;
};

/// Splits KEY=VALUE. Throws UsageError when there is no '=' or no key.
KeyValue parse_assignment(const std::string& text);

/// Reads a scene from JSON with comments after applying `changes` in order. Missing keys take their defaults,
/// null means the default. Setting one of several alternatives (volume.file and volume.phantom,
/// transfer.preset and transfer.points, camera.position and the angles) removes the others. A scene that
/// names neither file nor phantom shows the phantom "head". `source` names the text in messages. Throws
/// UsageError for malformed JSON (with line and column), unknown keys (with the nearest known one), wrong
/// types and values out of range, and whatever validate(Scene) refuses.
Scene scene_from_json(const std::string& text, const std::string& source,
                      const std::vector<KeyValue>& changes = {});

/// The same without validate(Scene): the keys and the types and ranges of their values are right, whether
/// they go together is not yet asked.
Scene scene_keys_from_json(const std::string& text, const std::string& source,
                           const std::vector<KeyValue>& changes = {});

/// The scene with every key, in the order of the contract; values that stand for "decided by the data" are
/// null. `indent` < 0: one line.
std::string scene_to_json(const Scene& scene, int indent = 2);

/// Every key with its help text: {"render.spacing", "slice or step distance …"}.
std::vector<std::pair<std::string, std::string>> list_scene_keys();

} // namespace slicelens
