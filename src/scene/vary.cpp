#include "scene/vary.h"

#include "core/errors.h"
#include "scene/json_document.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace slicelens {

using keys_json::Json;

namespace {

bool is_numeric(const Json& value) {
  if (value.is_array())
    return !value.empty() && std::all_of(value.begin(), value.end(), is_numeric);
  return value.is_number() && std::isfinite(value.get<double>());
}

Json numbers_of(const std::string& value, const std::string& text) {
  Json json = Json::parse(value, nullptr, false);
  if (json.is_discarded() || !is_numeric(json)) {
    throw UsageError("--vary " + text + ": '" + value +
                     "' is not a number or list of numbers; only those can vary (KEY=FROM:TO)");
  }
  return json;
}

bool same_shape(const Json& a, const Json& b) {
  if (!a.is_array() || !b.is_array())
    return a.is_array() == b.is_array();
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), same_shape);
}

Json between(const Json& from, const Json& to, double t, bool whole) {
  if (from.is_array()) {
    Json list = Json::array();
    for (std::size_t i = 0; i < from.size(); ++i)
      list.push_back(between(from[i], to[i], t, whole));
    return list;
  }
  const double value = (1 - t) * from.get<double>() + t * to.get<double>();
  if (whole && std::abs(value) < 9e15) // where every whole number is a double
    return std::llround(value);
  return value;
}

bool holds_whole(const Json& value) {
  if (value.is_array())
    return !value.empty() && std::all_of(value.begin(), value.end(), holds_whole);
  return value.is_number_integer();
}

} // namespace

Variation parse_variation(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::size_t colon = text.find(':', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || equals == 0 || colon == std::string::npos) {
    throw UsageError("--vary " + text +
                     ": is not KEY=FROM:TO; write for instance --vary camera.azimuth=0:360");
  }
  const Variation variation{text.substr(0, equals), text.substr(equals + 1, colon - equals - 1),
                            text.substr(colon + 1), false};
  const Json from = numbers_of(variation.from, text);
  const Json to = numbers_of(variation.to, text);
  if (!same_shape(from, to))
    throw UsageError("--vary " + text + ": FROM and TO must both be numbers, or lists of the same length");
  return variation;
}

std::vector<KeyValue> changes_at(const std::vector<Variation>& variations, double t) {
  std::vector<KeyValue> changes;
  for (const Variation& variation : variations) {
    const Json value = between(Json::parse(variation.from), Json::parse(variation.to), t, variation.whole);
    changes.push_back({variation.key, value.dump(-1, ' ', true, Json::error_handler_t::replace)});
  }
  return changes;
}

double time_of_frame(std::size_t index, std::size_t count, bool loop) {
  const std::size_t steps = loop ? count : count - 1;
  return steps == 0 ? 0.0 : static_cast<double>(index) / static_cast<double>(steps);
}

bool is_whole_key(const Scene& scene, const std::string& key) {
  const Json json = Json::parse(scene_to_json(scene, -1));
  const Json* node = &json;
  for (const std::string& part : keys_json::split_key(key)) {
    // A single warp may be named and written as a list of one or without the list.
    const bool names_entry = part.find_first_not_of("0123456789") == std::string::npos;
    const std::size_t index = names_entry ? std::strtoul(part.c_str(), nullptr, 10) : 0;
    if (node->is_array()) {
      if (index >= node->size())
        return false;
      node = &(*node)[index];
    } else if (names_entry && index != 0) {
      return false;
    }
    if (names_entry)
      continue;
    const auto found = node->find(part);
    if (found == node->end())
      return false;
    node = &*found;
  }
  return holds_whole(*node);
}

} // namespace slicelens
