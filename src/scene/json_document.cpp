#include "scene/json_document.h"

#include "core/errors.h"
#include "core/files.h"

#include <algorithm>
#include <cstdlib>

namespace slicelens::keys_json {

std::vector<std::string> split_key(const std::string& key) {
  std::vector<std::string> parts(1);
  for (const char c : key) {
    if (c == '.' || c == '[') {
      if (!parts.back().empty())
        parts.emplace_back();
    } else if (c != ']') {
      parts.back() += c;
    }
  }
  return parts;
}

namespace {

/// Groups of which only one member may stand in a section; setting one by --set removes the others.
struct Alternatives {
  const char* section;
  std::vector<std::vector<const char*>> members;
};

const std::vector<Alternatives>& alternatives() {
  static const std::vector<Alternatives> groups = {
      {"volume", {{"file"}, {"phantom"}}},
      {"transfer", {{"preset"}, {"points"}, {"shapes"}, {"file", "map", "range"}}},
      {"camera", {{"position"}, {"azimuth", "elevation", "roll"}, {"file"}}},
      {"image", {{"file"}, {"checkerboard"}, {"testcard"}}},
  };
  return groups;
}

void remove_alternatives(Json& section, const std::string& section_name, const std::string& key) {
  if (!section.is_object())
    return; // nothing set in it yet
  // A phantom's size goes with it: files know theirs, and a raw file's is set after its name.
  if (section_name == "volume" && key == "file" && section.contains("phantom"))
    section.erase("size");
  if (section_name == "camera" && key == "file") { // which says all of these itself
    for (const char* name : {"focal_point", "view_up", "view_angle", "parallel_scale", "projection"})
      section.erase(name);
  }
  for (const Alternatives& group : alternatives()) {
    if (section_name != group.section)
      continue;
    const auto has = [&](const std::vector<const char*>& member) {
      return std::any_of(member.begin(), member.end(), [&](const char* name) { return key == name; });
    };
    if (std::none_of(group.members.begin(), group.members.end(), has))
      continue;
    for (const auto& member : group.members) {
      if (has(member))
        continue;
      for (const char* name : member)
        section.erase(name);
    }
  }
}

Json value_of(const std::string& text) {
  Json value = Json::parse(text, nullptr, false);
  return value.is_discarded() ? Json(text) : value;
}

void apply(Json& scene, const KeyValue& change) {
  const std::vector<std::string> parts = split_key(change.key);
  Json* node = &scene;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (node->is_array()) {
      const std::size_t index = std::strtoul(parts[i].c_str(), nullptr, 10);
      if (parts[i].find_first_not_of("0123456789") != std::string::npos || index >= node->size()) {
        throw UsageError("--set " + change.key + ": the list has " + std::to_string(node->size()) +
                         " entries; name one from 0, or set the whole list");
      }
      node = &(*node)[index];
    } else {
      if (!node->is_object() && !node->is_null()) {
        throw UsageError("--set " + change.key + ": '" + parts[i] + "' is inside a value that has no keys");
      }
      node = &(*node)[parts[i]];
    }
  }
  if (!node->is_object() && !node->is_null())
    throw UsageError("--set " + change.key + ": set the whole list or value instead");
  const Json value = value_of(change.value);
  if (!value.is_null()) {
    if (parts.size() == 2)
      remove_alternatives(*node, parts[0], parts[1]);
    else if (parts.size() == 3 && parts[0] == "volumes") // volumes[1].file
      remove_alternatives(*node, "volume", parts[2]);
    else if (parts.size() == 4 && parts[0] == "volumes") // volumes[1].transfer.preset
      remove_alternatives(*node, parts[2], parts[3]);
  }
  (*node)[parts.back()] = value;
}

} // namespace

bool has_value(const Json& json, const char* section, const char* key) {
  const auto found = json.find(section);
  return found != json.end() && found->is_object() && found->contains(key) && !(*found)[key].is_null();
}

Json parse_text(const std::string& text, const std::string& source) {
  try {
    return Json::parse(text, nullptr, true, true);
  } catch (const Json::parse_error& error) {
    std::size_t line = 1;
    std::size_t column = 1;
    for (std::size_t i = 0; i + 1 < error.byte && i < text.size(); ++i) {
      ++column;
      if (text[i] == '\n') {
        ++line;
        column = 1;
      }
    }
    throw UsageError(source + ": not valid JSON at line " + std::to_string(line) + ", column " +
                     std::to_string(column) + "; look for a missing comma, quote or bracket");
  } catch (const Json::exception&) { // 1e999
    throw UsageError(source + ": holds a number beyond the range of doubles");
  }
}

Json parse_file(const std::filesystem::path& path, std::size_t limit) {
  try {
    return parse_text(read_text(path, limit), path.string());
  } catch (const UsageError& error) {
    throw FileError(path.string(), std::string(error.what()).substr(path.string().size() + 2));
  }
}

Json changed_document(const std::string& text, const std::string& source,
                      const std::vector<KeyValue>& changes) {
  Json json = parse_text(text, source);
  if (!json.is_object())
    throw UsageError(source + ": a scene is a JSON object { … }");
  for (const KeyValue& change : changes)
    apply(json, change);
  return json;
}

} // namespace slicelens::keys_json
