// Reading the JSON objects of this folder: keys are known or refused. For the readers of this folder only.
#pragma once

#include "core/errors.h"
#include "core/text.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace slicelens::study_json {

using Json = nlohmann::ordered_json;

/// One line of at most about 60 characters.
inline std::string shown(const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.size() > 60 ? text.substr(0, 57) + "…" : text;
}

[[noreturn]] inline void refuse(const std::string& path, const Json& value, const std::string& wanted) {
  throw UsageError(path + ": " + shown(value) + " is not valid; " + wanted);
}

/// An object whose keys are asked for one after the other; finish() refuses the rest.
class Object {
public:
  Object(const Json& json, std::string path) : json_(&json), path_(std::move(path)) {
    if (!json.is_object())
      refuse(path_, json, "give an object { … }");
  }

  /// The key's value, or null where it is absent or null.
  const Json* find(const std::string& key) {
    known_.insert(key);
    const auto found = json_->find(key);
    return found == json_->end() || found->is_null() ? nullptr : &*found;
  }

  std::string path(const std::string& key) const { return path_ + ": " + key; }

  void text(const std::string& key, std::string& value) {
    if (const Json* json = find(key)) {
      if (!json->is_string())
        refuse(path(key), *json, "give a text in quotes");
      value = json->get<std::string>();
    }
  }

  void flag(const std::string& key, bool& value) {
    if (const Json* json = find(key)) {
      if (!json->is_boolean())
        refuse(path(key), *json, "give true or false");
      value = json->get<bool>();
    }
  }

  /// A number from `low` to `high`.
  void number(const std::string& key, double& value, double low, double high) {
    if (const Json* json = find(key)) {
      const double given = json->is_number() ? json->get<double>() : NAN;
      if (!(given >= low && given <= high))
        refuse(path(key), *json, "give a number from " + number_text(low) + " to " + number_text(high));
      value = given;
    }
  }

  template <class Whole>
  void whole(const std::string& key, Whole& value, std::size_t low, std::size_t high) {
    if (const Json* json = find(key)) {
      const bool fits = json->is_number_unsigned() || (json->is_number_integer() && json->get<long>() >= 0);
      if (!fits || json->get<std::size_t>() < low || json->get<std::size_t>() > high)
        refuse(path(key), *json,
               "give a whole number from " + std::to_string(low) + " to " + std::to_string(high));
      value = json->get<Whole>();
    }
  }

  void texts(const std::string& key, std::vector<std::string>& values) {
    const Json* json = find(key);
    if (json == nullptr)
      return;
    if (!json->is_array())
      refuse(path(key), *json, "give a list of texts");
    for (const Json& entry : *json) {
      if (!entry.is_string())
        refuse(path(key), entry, "give a list of texts");
      values.push_back(entry.get<std::string>());
    }
  }

  void finish() const {
    for (const auto& [key, value] : json_->items()) {
      if (known_.count(key) != 0)
        continue;
      const std::vector<std::string> known(known_.begin(), known_.end());
      const auto nearest = nearest_word(key, known);
      throw UsageError(path_ + ": '" + key + "' is no key here; " +
                       (nearest ? "did you mean " + *nearest + "?" : "known: " + join(known)));
    }
  }

private:
  const Json* json_;
  std::string path_;
  std::set<std::string> known_;
};

/// A value as results and conditions name it: texts without quotes, everything else as JSON.
inline std::string label_of(const Json& value) {
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

} // namespace slicelens::study_json
