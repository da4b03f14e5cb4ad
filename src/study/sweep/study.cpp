#include "study/sweep/study.h"

#include "core/files.h"
#include "study/sweep/axes.h"
#include "study/sweep/combinations.h"
#include "study/sweep/quality.h"

#include <algorithm>

namespace slicelens {

using namespace study_json;

namespace {

namespace fs = std::filesystem;

Json parsed(const std::string& text, const std::string& source) {
  try {
    return Json::parse(text, nullptr, true, true);
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min<std::size_t>(error.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw UsageError(source + ": line " + std::to_string(line) +
                     ": this is no JSON; check commas, quotes and "
                     "brackets there");
  }
}

BaseScene base_scene(const Json& json, const std::string& name, const std::string& path,
                     const fs::path& folder) {
  if (json.is_object())
    return {name, json.dump(), path, folder};
  if (!json.is_string())
    refuse(path, json, "give the name of a scene file or a scene { … }");
  const fs::path file = folder / json.get<std::string>();
  return {name, read_text(file), file.string(), file.parent_path()};
}

void read_scenes(Object& object, Study& study) {
  const Json* one = object.find("scene");
  const Json* several = object.find("scenes");
  if (one != nullptr && several != nullptr)
    throw UsageError(object.path("scene") + " and scenes are both given; keep one of them");
  if (several == nullptr) {
    study.scenes = {one == nullptr ? BaseScene{"", "{}", object.path("scene"), study.folder}
                                   : base_scene(*one, "", object.path("scene"), study.folder)};
    return;
  }
  if (!several->is_object() || several->empty())
    refuse(object.path("scenes"), *several,
           "give an object of at least one scene, {\"name\": \"file.json\"}");
  for (const auto& [name, json] : several->items())
    study.scenes.push_back(base_scene(json, name, object.path("scenes: " + name), study.folder));
}

/// An axis of its own, unless cases choose among the scenes.
void add_scene_axis(Study& study) {
  const auto chosen = [](const SweepAxis& axis) {
    return std::any_of(axis.values.begin(), axis.values.end(),
                       [](const SweepValue& value) { return value.scene.has_value(); });
  };
  if (study.scenes.size() < 2 || std::any_of(study.axes.begin(), study.axes.end(), chosen))
    return;
  SweepAxis axis;
  for (std::size_t i = 0; i < study.scenes.size(); ++i)
    axis.values.push_back({{{"scene", study.scenes[i].name}}, {}, i});
  study.axes.insert(study.axes.begin(), std::move(axis));
}

/// The axis that has the column, or nothing.
const SweepAxis* axis_with(const Study& study, const std::string& column) {
  for (const SweepAxis& axis : study.axes) {
    for (const Label& label : axis.values.front().labels) {
      if (label.first == column)
        return &axis;
    }
  }
  return nullptr;
}

std::vector<std::string> labels_in(const SweepAxis& axis, const std::string& column) {
  std::vector<std::string> labels;
  for (const SweepValue& value : axis.values) {
    for (const Label& label : value.labels) {
      if (label.first == column && std::find(labels.begin(), labels.end(), label.second) == labels.end())
        labels.push_back(label.second);
    }
  }
  return labels;
}

std::vector<std::string> columns_in(const Study& study) {
  std::vector<std::string> columns;
  for (const SweepAxis& axis : study.axes) {
    for (const Label& label : axis.values.front().labels)
      columns.push_back(label.first);
  }
  return columns;
}

Condition condition_of(const Json& json, const std::string& path, const Study& study) {
  if (!json.is_object())
    refuse(path, json, "give an object of columns and labels, {\"render.spacing\": 0.5}");
  Condition condition;
  for (const auto& [column, given] : json.items()) {
    const SweepAxis* axis = axis_with(study, column);
    if (axis == nullptr)
      throw UsageError(path + ": " + column + " does not vary; varied: " + join(columns_in(study)));
    const std::vector<std::string> known = labels_in(*axis, column);
    std::vector<std::string> labels;
    const bool is_label = std::find(known.begin(), known.end(), label_of(given)) != known.end();
    for (const Json& value : given.is_array() && !is_label ? given : Json::array({given})) {
      labels.push_back(label_of(value));
      if (std::find(known.begin(), known.end(), labels.back()) == known.end())
        throw UsageError(path + ": " + column + " has no value " + shown(value) + "; it has " + join(known));
    }
    condition.emplace_back(column, labels);
  }
  return condition;
}

std::vector<Condition> conditions_of(Object& object, const std::string& key, const Study& study) {
  std::vector<Condition> conditions;
  const Json* json = object.find(key);
  if (json == nullptr)
    return conditions;
  if (!json->is_array())
    refuse(object.path(key), *json, "give a list of conditions, [{\"render.spacing\": 0.5}]");
  for (const Json& entry : *json) {
    conditions.push_back(condition_of(entry, object.path(key), study));
    if (conditions.back().empty())
      throw UsageError(object.path(key) + ": {} holds for every combination; name a column");
  }
  return conditions;
}

void read_timing(Object& parent, Study& study) {
  const Json* json = parent.find("timing");
  if (json == nullptr)
    return;
  TimingProtocol& timing = study.timing;
  if (json->is_boolean()) {
    timing.measure = json->get<bool>();
    return;
  }
  Object object(*json, parent.path("timing"));
  object.whole("warm_up", timing.warm_up, 1, 1000);
  object.whole("frames", timing.frames, 1, 10000);
  object.whole("batch", timing.batch, 1, 10000);
  object.whole("rounds", timing.rounds, 1, 10000);
  timing.most_rounds = timing.rounds;
  object.whole("most_rounds", timing.most_rounds, timing.rounds, 10000);
  object.number("confidence", timing.confidence, 0.5, 0.9999);
  object.number("precision", timing.precision, 0, 1);
  object.whole("seed", timing.seed, 0, std::size_t{1} << 53);
  object.flag("limits", timing.limits);
  if (const Json* baseline = object.find("baseline")) {
    for (const auto& [column, labels] : condition_of(*baseline, object.path("baseline"), study)) {
      if (labels.size() != 1)
        throw UsageError(object.path("baseline") + ": " + column + " needs a single value");
      timing.baseline.emplace_back(column, labels.front());
    }
  }
  std::string pairs = "round";
  object.text("pairs", pairs);
  if (pairs != "round" && pairs != "visit")
    throw UsageError(object.path("pairs") + ": \"" + pairs + "\" is not valid; give round or visit");
  timing.beside = pairs == "visit";
  timing.skip = conditions_of(object, "skip", study);
  object.finish();
}

void read_reference(Object& parent, Study& study) {
  const Json* json = parent.find("reference");
  if (json == nullptr)
    return;
  Object object(*json, parent.path("reference"));
  ReferenceScene reference;
  if (const Json* scene = object.find("scene"))
    reference.scene = base_scene(*scene, "", object.path("scene"), study.folder);
  if (const Json* set = object.find("set"))
    reference.changes = changes_of(*set, object.path("set"));
  object.finish();
  study.reference = std::move(reference);
}

void read_metrics(Object& object, Study& study) {
  if (object.find("metrics") == nullptr) {
    if (study.reference)
      study.metrics = {"psnr", "ssim", "rmse", "max_abs"};
    return;
  }
  object.texts("metrics", study.metrics);
  for (const std::string& name : study.metrics) {
    check_metric(name, object.path("metrics"));
    if (!study.reference && needs_reference(name))
      throw UsageError(object.path("metrics") + ": " + name +
                       " compares with a reference; give the study one, for instance \"reference\": "
                       "{\"set\": {\"render.pipeline\": \"reference\"}}");
  }
}

void read_paper(Object& parent, Study& study) {
  const Json* json = parent.find("paper");
  if (json == nullptr)
    return;
  if (!json->is_array())
    refuse(parent.path("paper"), *json, "give a list of {source, quantity, values}");
  for (const Json& entry : *json) {
    Object object(entry, parent.path("paper"));
    PaperValues paper;
    object.text("source", paper.source);
    object.text("quantity", paper.quantity);
    const Json* values = object.find("values");
    object.finish();
    if (paper.source.empty() || paper.quantity.empty() || values == nullptr || !values->is_array())
      throw UsageError(parent.path("paper") +
                       ": an entry needs source, quantity and values, a list of {when, "
                       "value}");
    for (const Json& one : *values) {
      Object value(one, parent.path("paper: values"));
      double number = NAN;
      value.number("value", number, -1e300, 1e300);
      const Json* when = value.find("when");
      value.finish();
      if (when == nullptr || std::isnan(number))
        throw UsageError(parent.path("paper: values") + ": " + shown(one) + " needs when and value");
      paper.values.emplace_back(condition_of(*when, parent.path("paper: when"), study), number);
    }
    study.paper.push_back(std::move(paper));
  }
}

void read_charts(Object& parent, Study& study) {
  const Json* json = parent.find("charts");
  if (json == nullptr)
    return;
  if (!json->is_array())
    refuse(parent.path("charts"), *json, "give a list of {title, x, y, by, log}");
  for (const Json& entry : *json) {
    Object object(entry, parent.path("charts"));
    StudyChart chart;
    object.text("title", chart.title);
    object.text("x", chart.x);
    object.text("y", chart.y);
    object.texts("by", chart.by);
    object.flag("log", chart.logarithmic);
    object.finish();
    if (chart.x.empty() || chart.y.empty())
      throw UsageError(parent.path("charts") + ": a chart needs x and y, columns of the results");
    for (const std::string& column : chart.by) {
      if (axis_with(study, column) == nullptr)
        throw UsageError(parent.path("charts") + ": by: " + column +
                         " does not vary; varied: " + join(columns_in(study)));
    }
    study.charts.push_back(std::move(chart));
  }
}

void read_text(Object& object, Study& study) {
  object.text("title", study.title);
  const Json* text = object.find("text");
  if (text == nullptr)
    return;
  if (text->is_string()) {
    study.text = text->get<std::string>();
    return;
  }
  std::vector<std::string> lines;
  object.texts("text", lines);
  study.text = join(lines, "\n");
}

void check_keys(const BaseScene& base, const std::vector<KeyValue>& changes) {
  if (is_image_scene(base.text))
    (void)image_scene_from_json(base.text, base.source, changes);
  else
    (void)scene_keys_from_json(base.text, base.source, changes);
}

/// Every scene is read once, so that a wrong key is found before anything is measured.
void check_scenes(const Study& study) {
  for (const Combination& combination : combinations_of(study)) {
    const BaseScene& base = study.scenes[combination.scene];
    check_keys(base, combination.changes);
    if (study.reference && !study.reference->scene) {
      std::vector<KeyValue> changes = combination.changes;
      changes.insert(changes.end(), study.reference->changes.begin(), study.reference->changes.end());
      check_keys(base, changes);
    }
  }
  if (study.reference && study.reference->scene)
    check_keys(*study.reference->scene, study.reference->changes);
}

} // namespace

Study study_from_json(const std::string& text, const std::string& source, const fs::path& folder,
                      const StudyChoice& choice) {
  Json json = parsed(text, source);
  if (json.is_object() && json.contains("quick")) {
    const Json quick = json["quick"];
    json.erase("quick");
    if (!quick.is_object())
      refuse(source + ": quick", quick, "give an object that changes the study");
    if (choice.quick)
      json.merge_patch(quick);
  }
  Study study;
  study.name = fs::path(source).stem().string();
  study.folder = folder;
  study.json = json.dump(2);
  Object object(json, source);
  read_text(object, study);
  read_scenes(object, study);
  if (const Json* set = object.find("set"))
    study.set = changes_of(*set, object.path("set"));
  study.set.insert(study.set.end(), choice.set.begin(), choice.set.end());
  if (const Json* vary = object.find("vary"))
    study.axes = axes_of(*vary, object.path("vary"), study.scenes);
  add_scene_axis(study);
  study.except = conditions_of(object, "except", study);
  read_reference(object, study);
  read_metrics(object, study);
  read_timing(object, study);
  read_paper(object, study);
  object.texts("columns", study.columns);
  read_charts(object, study);
  object.finish();
  check_scenes(study);
  return study;
}

Study read_study(const fs::path& file, const StudyChoice& choice) {
  return study_from_json(read_text(file), file.string(), file.parent_path(), choice);
}

} // namespace slicelens
