// Between JSON and the key tables (scene/keys.h): reading, writing and listing. For
// the scene readers of this folder only.
#pragma once

#include "core/errors.h"
#include "core/text.h"
#include "scene/json_document.h"
#include "scene/keys.h"
#include "scene/names.h"
#include "scene/scene_json.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <type_traits>

namespace slicelens::keys_json {

[[noreturn]] inline void refuse(const std::string& path, const Json& value, const std::string& wanted) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace); // a name need not be UTF-8
  if (text.size() > 60)
    text = text.substr(0, 57) + "…";
  throw UsageError(path + ": " + text + " is not valid; " + wanted);
}

/// The sentence a range adds to "a number".
inline std::string range_text(Range range) {
  switch (range) {
  case Range::positive:
    return " above 0";
  case Range::non_negative:
    return " of 0 or more";
  case Range::unit:
    return " from 0 to 1";
  case Range::any:
    break;
  }
  return "";
}

inline bool in_range(double value, Range range) {
  if (!std::isfinite(value))
    return false;
  switch (range) {
  case Range::positive:
    return value > 0;
  case Range::non_negative:
    return value >= 0;
  case Range::unit:
    return value >= 0 && value <= 1;
  case Range::any:
    break;
  }
  return true;
}

// ---- from JSON: one overload for each kind of field
// -----------------------------------------------------------------

inline void read(const Json& json, const std::string& path, bool& value, Range) {
  if (!json.is_boolean())
    refuse(path, json, "give true or false");
  value = json.get<bool>();
}

inline void read(const Json& json, const std::string& path, double& value, Range range) {
  if (!json.is_number() || !in_range(json.get<double>(), range))
    refuse(path, json, "give a number" + range_text(range));
  value = json.get<double>();
}

inline void read(const Json& json, const std::string& path, std::size_t& value, Range) {
  const bool whole = json.is_number_unsigned() || (json.is_number_integer() && json.get<std::int64_t>() >= 0);
  if (!whole)
    refuse(path, json, "give a whole number of 0 or more");
  value = json.get<std::size_t>();
}

inline void read(const Json& json, const std::string& path, std::string& value, Range) {
  if (!json.is_string())
    refuse(path, json, "give a text in quotes");
  value = json.get<std::string>();
}

inline void read(const Json& json, const std::string& path, ScalarType& value, Range) {
  if (!json.is_string())
    refuse(path, json, "give a scalar type such as \"uint8\"");
  try {
    value = scalar_type_from_name(json.get<std::string>());
  } catch (const UsageError& error) {
    throw UsageError(path + ": " + error.what());
  }
}

template <class Enum, std::enable_if_t<std::is_enum_v<Enum>, int> = 0>
void read(const Json& json, const std::string& path, Enum& value, Range) {
  if (json.is_string()) {
    for (const auto& entry : names_of(value)) {
      if (json.get<std::string>() == entry.name) {
        value = entry.value;
        return;
      }
    }
  }
  refuse(path, json, "give one of " + join(words_of(value)));
}

/// An array of exactly `count` entries.
inline void require_array(const Json& json, const std::string& path, std::size_t count,
                          const std::string& of) {
  if (!json.is_array() || json.size() != count)
    refuse(path, json, "give a list of " + std::to_string(count) + " " + of);
}

template <int N>
void read(const Json& json, const std::string& path, glm::vec<N, double>& value, Range range) {
  require_array(json, path, static_cast<std::size_t>(N), "numbers");
  for (int i = 0; i < N; ++i)
    read(json[static_cast<std::size_t>(i)], path + "[" + std::to_string(i) + "]", value[i], range);
}

template <class T, std::size_t N>
void read(const Json& json, const std::string& path, std::array<T, N>& value, Range range) {
  require_array(json, path, N, std::is_class_v<T> ? "lists" : "numbers");
  for (std::size_t i = 0; i < N; ++i)
    read(json[i], path + "[" + std::to_string(i) + "]", value[i], range);
}

template <class T>
void read(const Json& json, const std::string& path, std::vector<T>& value, Range range) {
  if (!json.is_array())
    refuse(path, json, "give a list");
  value.clear();
  for (std::size_t i = 0; i < json.size(); ++i)
    read(json[i], path + "[" + std::to_string(i) + "]", value.emplace_back(), range);
}

template <class T>
void read(const Json& json, const std::string& path, std::optional<T>& value, Range range) {
  read(json, path, value.emplace(), range);
}

// ---- to JSON
// --------------------------------------------------------------------------------------------------------

template <class T>
Json written(const T& value) {
  if constexpr (std::is_enum_v<T>) {
    return word(value);
  } else {
    return value;
  }
}
inline Json written(const ScalarType& value) { return name_of(value); }
template <int N>
Json written(const glm::vec<N, double>& value) {
  Json list = Json::array();
  for (int i = 0; i < N; ++i)
    list.push_back(value[i]);
  return list;
}
inline Json written(const AxisRanges& value) {
  Json list = Json::array();
  for (const glm::dvec2& range : value)
    list.push_back(written(range));
  return list;
}
inline Json written(const std::vector<LandmarkPair>& value) {
  Json list = Json::array();
  for (const LandmarkPair& pair : value)
    list.push_back(Json::array({written(pair[0]), written(pair[1])}));
  return list;
}
template <class T>
Json written(const std::optional<T>& value) {
  return value ? written(*value) : Json(nullptr);
}

// ---- visitors of the key table
// --------------------------------------------------------------------------------------

/// Fills fields from one JSON object and refuses keys that no field took.
class Reader {
public:
  Reader(const Json& object, std::string path) : object_(object), path_(std::move(path)) {
    if (!object.is_object())
      refuse(path_.empty() ? "scene" : path_, object, "give an object { … }");
  }

  template <class T>
  void key(const char* name, T& field, const char*, Range range = Range::any) {
    if (const Json* value = take(name))
      read(*value, full(name), field, range);
  }

  void endian(const char* name, std::optional<bool>& field, const char*) {
    const Json* value = take(name);
    if (value == nullptr)
      return;
    if (*value != "little" && *value != "big")
      refuse(full(name), *value, "give little or big");
    field = *value == "big";
  }

  template <class T, class Keys>
  void section(const char* name, T& field, const char*, Keys keys) {
    if (const Json* value = take(name))
      read_object(*value, full(name), field, keys);
  }

  template <class T, class Keys>
  void option(const char* name, std::optional<T>& field, const char*, Keys keys) {
    if (const Json* value = take(name))
      read_object(*value, full(name), field.emplace(), keys);
  }

  template <class T, class Keys>
  void list(const char* name, std::vector<T>& field, const char*, Keys keys) {
    const Json* value = take(name);
    if (value == nullptr)
      return;
    if (!value->is_array())
      refuse(full(name), *value, "give a list of objects");
    for (std::size_t i = 0; i < value->size(); ++i) {
      read_object((*value)[i], full(name) + "[" + std::to_string(i) + "]", field.emplace_back(), keys);
    }
  }

  void segments(const char* name, std::optional<std::size_t>& field, const char*) {
    const Json* value = take(name);
    if (value == nullptr)
      return;
    if (*value == "adaptive") {
      field = std::nullopt;
    } else if (value->is_string()) {
      refuse(full(name), *value, "give a whole number or \"adaptive\"");
    } else {
      read(*value, full(name), field.emplace(), Range::any);
    }
  }

  /// Three numbers, or one for all axes.
  void per_axis(const char* name, glm::dvec3& field, const char*, Range range) {
    const Json* value = take(name);
    if (value == nullptr)
      return;
    double all = 0;
    if (value->is_array()) {
      read(*value, full(name), field, range);
    } else {
      read(*value, full(name), all, range);
      field = glm::dvec3(all);
    }
  }

  void per_axis(const char* name, std::array<std::size_t, 3>& field, const char*, Range range) {
    const Json* value = take(name);
    if (value == nullptr)
      return;
    std::size_t all = 0;
    if (value->is_array()) {
      read(*value, full(name), field, range);
    } else {
      read(*value, full(name), all, range);
      field.fill(all);
    }
  }

  /// One warp, or a list of warps.
  void warps(const char* name, std::vector<Warp>& field) {
    const Json* value = take(name);
    if (value == nullptr)
      return;
    if (value->is_array()) {
      for (std::size_t i = 0; i < value->size(); ++i) {
        read_warp((*value)[i], full(name) + "[" + std::to_string(i) + "]", field.emplace_back());
      }
    } else {
      read_warp(*value, full(name), field.emplace_back());
    }
  }

  /// A list of volumes in place of the sections of a single one.
  template <class Keys>
  void volumes(const char* name, Scene& scene, const char*, Keys keys) {
    const Json* value = take(name);
    if (value == nullptr)
      return;
    for (const char* single : {"volume", "transfer", "warp"}) {
      if (take(single) != nullptr)
        throw UsageError(full(name) + " and " + single + " are both given; an entry of " + full(name) +
                         " has its own, so keep one form");
    }
    if (!value->is_array() || value->empty() || value->size() > max_volumes)
      refuse(full(name), *value, "give a list of 1 to " + std::to_string(max_volumes) + " volumes");
    for (std::size_t i = 0; i < value->size(); ++i) {
      VolumeLayer layer;
      read_object((*value)[i], full(name) + "[" + std::to_string(i) + "]", layer, keys);
      if (!layer.volume.file && !layer.volume.phantom)
        layer.volume.phantom = "head";
      if (i > 0) {
        scene.others.push_back(std::move(layer));
        continue;
      }
      scene.volume = std::move(layer.volume);
      scene.transfer = std::move(layer.transfer);
      scene.warp = std::move(layer.warp);
      scene.placement = layer.placement;
    }
  }

  void finish() const {
    for (const auto& [name, value] : object_.items()) {
      if (known_.count(name) != 0)
        continue;
      const auto nearest = nearest_word(name, {known_.begin(), known_.end()});
      throw UsageError(full(name) + " is not a scene key" +
                       (nearest ? "; did you mean " + full(*nearest) + "?"
                                : "; known here: " + join({known_.begin(), known_.end()})));
    }
  }

private:
  static void read_warp(const Json& json, const std::string& path, Warp& warp) {
    Reader reader(json, path);
    std::vector<std::string> kinds;
    for (const WarpInfo& info : warp_infos())
      kinds.push_back(info.kind);
    const Json* kind = reader.take("kind");
    if (kind == nullptr)
      throw UsageError(path + ".kind is missing; give one of " + join(kinds));
    if (!kind->is_string() || !make_warp(kind->get<std::string>()))
      refuse(path + ".kind", *kind, "give one of " + join(kinds));
    warp = *make_warp(kind->get<std::string>());
    warp_keys(reader, warp);
    reader.finish();
  }

  template <class T, class Keys>
  static void read_object(const Json& json, const std::string& path, T& field, Keys keys) {
    Reader reader(json, path);
    keys(reader, field);
    reader.finish();
  }

  const Json* take(const char* name) {
    known_.insert(name);
    const auto found = object_.find(name);
    return found == object_.end() || found->is_null() ? nullptr : &*found;
  }

  std::string full(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }

  const Json& object_;
  std::string path_;
  std::set<std::string> known_;
};

/// Makes one JSON object from fields.
struct Writer {
  Json object = Json::object();

  template <class T>
  void key(const char* name, const T& field, const char*, Range = Range::any) {
    object[name] = written(field);
  }
  void endian(const char* name, const std::optional<bool>& field, const char*) {
    object[name] = field ? Json(*field ? "big" : "little") : Json(nullptr);
  }
  template <class T, class Keys>
  void section(const char* name, const T& field, const char*, Keys keys) {
    Writer writer;
    keys(writer, field);
    object[name] = writer.object;
  }
  template <class T, class Keys>
  void option(const char* name, const std::optional<T>& field, const char* help, Keys keys) {
    if (field)
      section(name, *field, help, keys);
    else
      object[name] = nullptr;
  }
  void segments(const char* name, const std::optional<std::size_t>& field, const char*) {
    object[name] = field ? Json(*field) : Json("adaptive");
  }
  void per_axis(const char* name, const glm::dvec3& field, const char*, Range) {
    object[name] = field.x == field.y && field.y == field.z ? Json(field.x) : written(field);
  }
  void per_axis(const char* name, const std::array<std::size_t, 3>& field, const char*, Range) {
    object[name] = field[0] == field[1] && field[1] == field[2] ? Json(field[0]) : written(field);
  }
  void warps(const char* name, const std::vector<Warp>& field) {
    Json entries = Json::array();
    for (const Warp& warp : field) {
      Writer writer;
      writer.object["kind"] = kind_of(warp);
      warp_keys(writer, warp);
      entries.push_back(writer.object);
    }
    object[name] = entries.size() == 1 ? entries[0] : entries;
  }
  /// The sections of a single volume have been written before.
  template <class Keys>
  void volumes(const char* name, const Scene& scene, const char* help, Keys keys) {
    if (scene.others.empty() && scene.placement == Placement{})
      return;
    std::vector<VolumeLayer> layers = {{scene.volume, scene.transfer, scene.warp, scene.placement}};
    layers.insert(layers.end(), scene.others.begin(), scene.others.end());
    for (const char* single : {"volume", "transfer", "warp"})
      object.erase(single);
    list(name, layers, help, keys);
  }

  template <class T, class Keys>
  void list(const char* name, const std::vector<T>& field, const char*, Keys keys) {
    Json entries = Json::array();
    for (const T& entry : field) {
      Writer writer;
      keys(writer, entry);
      entries.push_back(writer.object);
    }
    object[name] = entries;
  }
};

/// Collects names and help texts.
struct Lister {
  std::vector<std::pair<std::string, std::string>>& keys;
  std::string prefix;

  template <class T>
  void key(const char* name, const T&, const char* help, Range = Range::any) {
    keys.emplace_back(prefix + name, help);
  }
  void endian(const char* name, const std::optional<bool>&, const char* help) {
    keys.emplace_back(prefix + name, help);
  }
  template <class T, class Keys>
  void section(const char* name, const T& field, const char*, Keys visit_keys) {
    Lister lister{keys, prefix + name + "."};
    visit_keys(lister, field);
  }
  template <class T, class Keys>
  void option(const char* name, const std::optional<T>&, const char* help, Keys visit_keys) {
    section(name, T{}, help, visit_keys);
  }
  void segments(const char* name, const std::optional<std::size_t>&, const char* help) {
    keys.emplace_back(prefix + name, help);
  }
  void per_axis(const char* name, const glm::dvec3&, const char* help, Range) {
    keys.emplace_back(prefix + name, help);
  }
  void per_axis(const char* name, const std::array<std::size_t, 3>&, const char* help, Range) {
    keys.emplace_back(prefix + name, help);
  }
  void warps(const char* name, const std::vector<Warp>&) {
    for (const WarpInfo& info : warp_infos()) {
      Lister lister{keys, std::string(name) + "(" + info.kind + ")."};
      const Warp warp = *make_warp(info.kind);
      warp_keys(lister, warp);
    }
  }
  /// Those that a single volume does not have.
  template <class Keys>
  void volumes(const char* name, const Scene&, const char* help, Keys) {
    keys.emplace_back(std::string(name) + "[]", help);
    Lister lister{keys, std::string(name) + "[].placement."};
    const Placement placement;
    placement_keys(lister, placement);
  }

  template <class T, class Keys>
  void list(const char* name, const std::vector<T>&, const char*, Keys visit_keys) {
    Lister lister{keys, prefix + name + "[]."};
    const T entry{};
    visit_keys(lister, entry);
  }
};

} // namespace slicelens::keys_json
