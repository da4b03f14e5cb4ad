#include "study/sweep/axes.h"

#include <algorithm>
#include <cmath>

namespace slicelens::study_json {

namespace {

constexpr std::size_t most_values = 100000;

/// Numbers print as people write them: 0.1·3 is 0.3, whole numbers have no fraction.
Json number_json(double value) {
  const double rounded = std::strtod(
      [&] {
        char text[40];
        std::snprintf(text, sizeof text, "%.12g", value);
        return std::string(text);
      }()
          .c_str(),
      nullptr);
  if (rounded == std::floor(rounded) && std::abs(rounded) < 1e15)
    return static_cast<std::int64_t>(rounded);
  return rounded;
}

struct Range {
  double from = NAN;
  double to = NAN;
  double step = NAN;
  double factor = NAN;
  std::size_t count = 0;
  bool logarithmic = false;
};

Range range_of(const Json& json, const std::string& path) {
  Object object(json, path);
  Range range;
  constexpr double most = 1e300;
  object.number("from", range.from, -most, most);
  object.number("to", range.to, -most, most);
  object.number("step", range.step, -most, most);
  object.number("factor", range.factor, 1e-6, 1e6);
  object.whole("count", range.count, 2, most_values);
  std::string scale = "linear";
  object.text("scale", scale);
  object.finish();
  if (scale != "linear" && scale != "log")
    throw UsageError(path + ": scale: \"" + scale + "\" is not valid; give linear or log");
  range.logarithmic = scale == "log";
  const int ways = !std::isnan(range.step) + !std::isnan(range.factor) + (range.count > 0);
  if (std::isnan(range.from) || std::isnan(range.to) || ways != 1)
    throw UsageError(path + ": a range needs from, to, and one of step, factor and count");
  return range;
}

std::vector<Json> counted(const Range& range, const std::string& path) {
  if (range.logarithmic && !(range.from > 0 && range.to > 0))
    throw UsageError(path + ": a range with scale log needs positive ends");
  std::vector<Json> values;
  for (std::size_t i = 0; i < range.count; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(range.count - 1);
    values.push_back(number_json(range.logarithmic
                                     ? std::exp(std::log(range.from) * (1 - t) + std::log(range.to) * t)
                                     : range.from * (1 - t) + range.to * t));
  }
  return values;
}

/// from, next(from) … as long as they do not pass `to` by more than rounding.
template <class Next>
std::vector<Json> stepped(const Range& range, double step, const std::string& path, Next next) {
  const double direction = range.to >= range.from ? 1 : -1;
  std::vector<Json> values;
  for (std::size_t i = 0;; ++i) {
    const double value = next(i);
    if ((value - range.to) * direction > 1e-9 * std::abs(step))
      return values;
    if (i == most_values)
      throw UsageError(path + ": the range has more than " + std::to_string(most_values) + " values");
    values.push_back(number_json(value));
  }
}

std::vector<Json> ranged(const Json& json, const std::string& path) {
  const Range range = range_of(json, path);
  if (range.count > 0)
    return counted(range, path);
  if (!std::isnan(range.step)) {
    if (range.step == 0 || (range.to - range.from) * range.step < 0)
      throw UsageError(path + ": step " + number_text(range.step) + " never leads from " +
                       number_text(range.from) + " to " + number_text(range.to));
    return stepped(range, range.step, path,
                   [&](std::size_t i) { return range.from + static_cast<double>(i) * range.step; });
  }
  if (!(range.from > 0 && range.to > 0) || range.factor == 1 || (range.to > range.from) != (range.factor > 1))
    throw UsageError(path + ": factor " + number_text(range.factor) + " never leads from " +
                     number_text(range.from) + " to " + number_text(range.to) +
                     "; both must be positive, and a factor below 1 goes down");
  return stepped(range, range.to * std::abs(range.factor - 1), path,
                 [&](std::size_t i) { return range.from * std::pow(range.factor, static_cast<double>(i)); });
}

std::string dumped(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// Keys whose values go together.
SweepAxis zipped(const Json& json, const std::string& path) {
  SweepAxis axis;
  std::string first;
  for (const auto& [key, given] : json.items()) {
    const std::vector<Json> values = values_of(given, path + ": " + key);
    if (first.empty()) {
      first = key;
      axis.values.resize(values.size());
    }
    if (values.size() != axis.values.size()) {
      throw UsageError(path + ": " + key + " has " + std::to_string(values.size()) + " values and " + first +
                       " " + std::to_string(axis.values.size()) +
                       "; keys of one axis go together and need equally many");
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      axis.values[i].labels.emplace_back(key, label_of(values[i]));
      axis.values[i].changes.push_back({key, dumped(values[i])});
    }
  }
  if (axis.values.empty())
    throw UsageError(path + ": an axis needs at least one key with its values");
  return axis;
}

std::size_t scene_index(const Json& name, const std::string& path, const std::vector<BaseScene>& scenes) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (name == scenes[i].name)
      return i;
    names.push_back(scenes[i].name);
  }
  refuse(path, name, "give one of the study's scenes: " + join(names));
}

SweepAxis cases(const Json& json, const std::string& path, const std::vector<BaseScene>& scenes) {
  Object object(json, path);
  std::string name;
  object.text("name", name);
  const Json* list = object.find("cases");
  object.finish();
  if (name.empty())
    throw UsageError(path + ": name is missing; it heads the column of the cases");
  if (list == nullptr || !list->is_object() || list->empty())
    throw UsageError(path +
                     ": cases must be an object of at least one case, {\"label\": {KEY: VALUE, …}, …}");
  SweepAxis axis;
  for (const auto& [label, keys] : list->items()) {
    const std::string at = path + ": " + label;
    SweepValue value;
    value.labels = {{name, label}};
    Json rest = keys;
    if (rest.is_object() && rest.contains("scene")) {
      value.scene = scene_index(rest["scene"], at + ": scene", scenes);
      rest.erase("scene");
    }
    value.changes = changes_of(rest, at);
    axis.values.push_back(std::move(value));
  }
  return axis;
}

} // namespace

std::vector<KeyValue> changes_of(const Json& json, const std::string& path) {
  if (!json.is_object())
    refuse(path, json, "give an object of scene keys, {\"render.spacing\": 0.5}");
  std::vector<KeyValue> changes;
  for (const auto& [key, value] : json.items())
    changes.push_back({key, dumped(value)});
  return changes;
}

std::vector<Json> values_of(const Json& json, const std::string& path) {
  std::vector<Json> values;
  if (json.is_object())
    values = ranged(json, path);
  else if (json.is_array())
    values.assign(json.begin(), json.end());
  else
    refuse(path, json, "give a list of values or a range {\"from\", \"to\", \"step\"}");
  if (values.empty())
    throw UsageError(path + ": has no values; give at least one, or leave the key out");
  return values;
}

std::vector<SweepAxis> axes_of(const Json& json, const std::string& path,
                               const std::vector<BaseScene>& scenes) {
  std::vector<SweepAxis> axes;
  if (json.is_object()) {
    for (const auto& [key, values] : json.items())
      axes.push_back(zipped(Json{{key, values}}, path));
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) {
      const std::string at = path + "[" + std::to_string(i) + "]";
      if (!json[i].is_object())
        refuse(at, json[i], "give an object of keys that go together, or of a name and cases");
      axes.push_back(json[i].contains("cases") ? cases(json[i], at, scenes) : zipped(json[i], at));
    }
  } else {
    refuse(path, json, "give an object of keys that are crossed, or a list of axes");
  }
  std::vector<std::string> columns;
  for (const SweepAxis& axis : axes) {
    for (const Label& label : axis.values.front().labels) {
      if (std::find(columns.begin(), columns.end(), label.first) != columns.end())
        throw UsageError(path + ": " + label.first + " is given twice");
      columns.push_back(label.first);
    }
  }
  return axes;
}

} // namespace slicelens::study_json
