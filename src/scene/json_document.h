// Scene texts as JSON documents, before the key tables read them. For the scene readers of this folder only.
#pragma once

#include "scene/scene_json.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace slicelens::keys_json {

using Json = nlohmann::ordered_json;

/// The object that `text` holds (JSON with comments) after `changes` in order; setting one of several
/// alternatives removes the others. Throws UsageError, naming `source` with line and column for malformed
/// JSON and the key for a change that has no place.
Json changed_document(const std::string& text, const std::string& source,
                      const std::vector<KeyValue>& changes);

/// The value that `text` holds, an object or not. Throws UsageError as above.
Json parse_text(const std::string& text, const std::string& source);

/// The value that a file of at most `limit` bytes holds. Throws FileError: a damaged file is no wrong scene.
Json parse_file(const std::filesystem::path& path, std::size_t limit = std::size_t{64} << 20);

/// "warp[0].zoom" and "warp.0.zoom" are {"warp", "0", "zoom"}.
std::vector<std::string> split_key(const std::string& key);

/// Whether the document gives a value other than null for a key of a section.
bool has_value(const Json& json, const char* section, const char* key);

} // namespace slicelens::keys_json
