// StudyResults as CSV and JSON.
#include "study/sweep/results.h"
#include "study/sweep/study_json.h"

#include <algorithm>

namespace slicelens {

using study_json::Json;

namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos)
    return text;
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c;
    if (c == '"')
      quoted += c;
  }
  return quoted + "\"";
}

Json spread_json(const Spread& spread) {
  return {{"median", spread.quartiles.median},
          {"q1", spread.quartiles.first},
          {"q3", spread.quartiles.third},
          {"min", spread.least},
          {"sd", spread.deviation ? Json(*spread.deviation) : Json(nullptr)},
          {"n", spread.values.size()},
          {"values", spread.values}};
}

Json spreads_json(const std::vector<std::pair<std::string, Spread>>& spreads) {
  Json json = Json::object();
  for (const auto& [name, spread] : spreads)
    json[name] = spread_json(spread);
  return json;
}

/// What drew the rows: usually one, or several of our pipelines and a peer.
Json drivers_json(const StudyResults& results) {
  Json drivers = Json::array();
  for (const Row& row : results.rows) {
    const auto renderer = row.texts.find("renderer");
    const auto version = row.texts.find("gl_version");
    if (renderer == row.texts.end())
      continue;
    const Json driver = {{"GL_RENDERER", renderer->second},
                         {"GL_VERSION", version == row.texts.end() ? "" : version->second}};
    if (std::find(drivers.begin(), drivers.end(), driver) == drivers.end())
      drivers.push_back(driver);
  }
  return drivers;
}

Json machine_json(const StudyResults& results) {
  const Machine& machine = results.machine;
  return {{"system", machine.system},          {"processor", machine.processor},
          {"threads", machine.threads},        {"memory_bytes", machine.memory},
          {"version", machine.version},        {"commit", machine.commit},
          {"compiler", machine.compiler},      {"load_at_start", results.load_at_start},
          {"load_at_end", results.load_at_end}};
}

Json row_json(const StudyResults& results, const Row& row) {
  Json labels = Json::object();
  for (const Label& label : row.combination.labels)
    labels[label.first] = label.second;
  Json values = Json::object();
  for (const Value& value : row.values)
    values[value.first] = value.second ? Json(*value.second) : Json(nullptr);
  Json json = {{"index", row.combination.index},
               {"varied", labels},
               {"status", cell(results, row, "status")},
               {"id", row.id},
               {"values", values},
               {"texts", row.texts},
               {"seconds", spreads_json(row.seconds)}};
  if (row.baseline)
    json["baseline"] = *row.baseline;
  if (row.rate)
    json["rate"] = spread_json(*row.rate);
  if (row.processor_rate)
    json["processor_rate"] = spread_json(*row.processor_rate);
  for (std::size_t i = 0; i < row.paper.size(); ++i) {
    if (row.paper[i])
      json["paper"][results.study.paper[i].source] = *row.paper[i];
  }
  if (!row.error.empty())
    json["error"] = row.error;
  if (!row.scene.empty())
    json["scene"] = Json::parse(row.scene, nullptr, false);
  return json;
}

} // namespace

std::string results_csv(const StudyResults& results) {
  const std::vector<Column> columns = columns_of(results);
  std::string text;
  for (std::size_t i = 0; i < columns.size(); ++i)
    text += (i == 0 ? "" : ",") + csv_field(columns[i].name);
  text += "\n";
  for (const Row& row : results.rows) {
    for (std::size_t i = 0; i < columns.size(); ++i)
      text += (i == 0 ? "" : ",") + csv_field(cell(results, row, columns[i].name));
    text += "\n";
  }
  return text;
}

std::string results_json(const StudyResults& results) {
  Json rows = Json::array();
  for (const Row& row : results.rows)
    rows.push_back(row_json(results, row));
  const Json json = {{"study", Json::parse(results.study.json, nullptr, false)},
                     {"command", results.command},
                     {"machine", machine_json(results)},
                     {"drivers", drivers_json(results)},
                     {"limits_fragments_per_s", spreads_json(results.limits)},
                     {"rows", rows}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace slicelens
