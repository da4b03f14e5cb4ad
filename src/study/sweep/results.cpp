#include "study/sweep/results.h"

#include "core/text.h"

#include <algorithm>
#include <set>

namespace slicelens {

namespace {

/// The visits of one combination by round, those of one shard only.
using Rounds = std::map<std::size_t, const TimedVisit*>;

std::optional<double> phase_of(const TimedVisit& visit, const std::string& phase) {
  for (const auto& [name, seconds] : visit.seconds) {
    if (name == phase)
      return seconds;
  }
  return std::nullopt;
}

/// Visits of every id, by shard.
std::map<std::string, std::map<std::size_t, Rounds>> by_id(const JournalContents& journal) {
  std::map<std::string, std::map<std::size_t, Rounds>> all;
  for (const TimedVisit& visit : journal.visits)
    all[visit.id][visit.shard][visit.round] = &visit;
  return all;
}

/// Of several shards that visited a combination the one that did so most often: the others needed it as a
/// baseline.
const std::pair<const std::size_t, Rounds>* best_shard(const std::map<std::size_t, Rounds>& shards) {
  const std::pair<const std::size_t, Rounds>* best = nullptr;
  for (const auto& shard : shards) {
    if (best == nullptr || shard.second.size() > best->second.size())
      best = &shard;
  }
  return best;
}

std::vector<std::pair<std::string, Spread>> spreads(const Rounds& rounds) {
  std::vector<std::string> order;
  std::map<std::string, std::vector<double>> values;
  for (const auto& [round, visit] : rounds) {
    for (const auto& [phase, seconds] : visit->seconds) {
      if (phase.rfind("baseline_", 0) == 0)
        continue;
      if (values[phase].empty())
        order.push_back(phase);
      values[phase].push_back(seconds);
    }
  }
  std::vector<std::pair<std::string, Spread>> result;
  for (const std::string& phase : order)
    result.emplace_back(phase, spread_of(values[phase]));
  return result;
}

/// The baseline's seconds by the own ones, of rounds that have both.
std::optional<Spread> rates(const Rounds& own, const Rounds& baseline, const std::string& phase) {
  std::vector<double> values;
  for (const auto& [round, visit] : own) {
    const auto mine = phase_of(*visit, phase);
    auto theirs = phase_of(*visit, "baseline_" + phase); // timed just before it
    const auto other = baseline.find(round);
    if (!theirs && other != baseline.end())
      theirs = phase_of(*other->second, phase);
    if (mine && theirs && *mine > 0)
      values.push_back(*theirs / *mine);
  }
  return values.empty() ? std::nullopt : std::optional<Spread>(spread_of(std::move(values)));
}

std::optional<double> value_named(const std::vector<Value>& values, const std::string& name) {
  for (const Value& value : values) {
    if (value.first == name)
      return value.second;
  }
  return std::nullopt;
}

const Spread* spread_named(const std::vector<std::pair<std::string, Spread>>& spreads,
                           const std::string& name) {
  for (const auto& [phase, spread] : spreads) {
    if (phase == name)
      return &spread;
  }
  return nullptr;
}

std::string status_text(RowStatus status) {
  switch (status) {
  case RowStatus::done:
    return "done";
  case RowStatus::failed:
    return "failed";
  case RowStatus::missing:
    break;
  }
  return "missing";
}

bool is_timed(const Study& study, const Combination& combination) {
  return study.timing.measure &&
         std::none_of(study.timing.skip.begin(), study.timing.skip.end(),
                      [&](const Condition& skip) { return holds(skip, combination.labels); });
}

/// Column "draw_q1" is the first quartile of the drawing's seconds, and so on.
std::optional<double> spread_column(const Spread& spread, const std::string& what) {
  if (what == "median" || what.empty())
    return spread.quartiles.median;
  if (what == "q1")
    return spread.quartiles.first;
  if (what == "q3")
    return spread.quartiles.third;
  if (what == "min")
    return spread.least;
  if (what == "sd")
    return spread.deviation;
  if (what == "n")
    return static_cast<double>(spread.values.size());
  return std::nullopt;
}

/// "draw_s_q1" → ("draw", "q1"); "upload_s" → ("upload", "").
std::optional<std::pair<std::string, std::string>> seconds_column(const std::string& column) {
  const std::size_t middle = column.find("_s_");
  if (middle != std::string::npos)
    return std::pair{column.substr(0, middle), column.substr(middle + 3)};
  if (column.ends_with("_s"))
    return std::pair{column.substr(0, column.size() - 2), std::string()};
  return std::nullopt;
}

std::optional<double> rate_column(const std::optional<Spread>& rate, const std::string& column,
                                  const std::string& name) {
  if (!rate || column.rfind(name, 0) != 0)
    return std::nullopt;
  return spread_column(*rate, column.size() > name.size() ? column.substr(name.size() + 1) : "");
}

std::optional<double> paper_column(const StudyResults& results, const Row& row, const std::string& column) {
  for (std::size_t i = 0; i < results.study.paper.size(); ++i) {
    if (results.study.paper[i].source == column)
      return row.paper[i];
  }
  return std::nullopt;
}

std::optional<double> derived(const StudyResults& results, const Row& row, const std::string& column) {
  const Spread* draw = spread_named(row.seconds, "draw");
  const bool peer = row.combination.peer.has_value();
  if (draw == nullptr || draw->quartiles.median <= 0 || peer)
    return std::nullopt;
  if (column == "samples_per_s") {
    const auto samples = value_named(row.values, "samples");
    return samples ? std::optional<double>(*samples / draw->quartiles.median) : std::nullopt;
  }
  if (column == "changed_rate") {
    const Spread* deform = spread_named(row.seconds, "deform");
    const Spread* slice = spread_named(row.seconds, "slice");
    const Spread* tessellate = spread_named(row.seconds, "tessellate");
    if (deform == nullptr || slice == nullptr || tessellate == nullptr)
      return std::nullopt;
    return draw->quartiles.median / (draw->quartiles.median + deform->quartiles.median +
                                     slice->quartiles.median + tessellate->quartiles.median);
  }
  const auto fragments = value_named(row.values, "fragments");
  if (!fragments)
    return std::nullopt;
  const double rate = *fragments / draw->quartiles.median;
  if (column == "fragments_per_s")
    return rate;
  const Spread* limit = spread_named(results.limits, "classified");
  return limit == nullptr ? std::nullopt : std::optional<double>(rate / limit->quartiles.median);
}

} // namespace

Spread spread_of(std::vector<double> values) {
  Spread spread;
  spread.quartiles = quartiles(values);
  spread.least = *std::min_element(values.begin(), values.end());
  if (values.size() > 1)
    spread.deviation = sample_standard_deviation(values);
  spread.values = std::move(values);
  return spread;
}

StudyResults collect(const Study& study, const std::vector<Combination>& combinations,
                     const std::vector<std::optional<CombinationState>>& states,
                     const std::vector<std::string>& errors, const JournalContents& journal) {
  StudyResults results;
  results.study = study;
  results.machine = this_machine();
  const auto visits = by_id(journal);
  std::map<std::string, const Quality*> qualities;
  for (const Quality& quality : journal.qualities)
    qualities[quality.id] = &quality;
  for (const Combination& combination : combinations) {
    Row row;
    row.combination = combination;
    row.error = errors[combination.index];
    row.baseline = baseline_of(study, combinations, combination);
    for (const PaperValues& paper : study.paper) {
      const auto found = std::find_if(paper.values.begin(), paper.values.end(), [&](const auto& value) {
        return holds(value.first, combination.labels);
      });
      row.paper.push_back(found == paper.values.end() ? std::nullopt : std::optional<double>(found->second));
    }
    const auto& state = states[combination.index];
    if (state) {
      row.id = state->id;
      const auto quality = qualities.find(state->id);
      bool complete = quality != qualities.end() && quality->second->of == state->of;
      if (complete) {
        row.values = quality->second->values;
        row.texts = quality->second->texts;
      }
      const auto timed = visits.find(state->id);
      const auto* shard = timed == visits.end() ? nullptr : best_shard(timed->second);
      if (is_timed(study, combination))
        complete = complete && shard != nullptr && shard->second.size() >= study.timing.rounds;
      if (shard != nullptr && is_timed(study, combination)) {
        row.seconds = spreads(shard->second);
        const auto& base_state = row.baseline ? states[*row.baseline] : state;
        const auto base = base_state ? visits.find(base_state->id) : visits.end();
        if (row.baseline && base != visits.end() && base->second.count(shard->first) != 0) {
          const Rounds& theirs = base->second.at(shard->first);
          row.rate = rates(shard->second, theirs, "draw");
          row.processor_rate = rates(shard->second, theirs, "draw_processor");
        }
      }
      row.status = complete ? RowStatus::done : RowStatus::missing;
    }
    if (!row.error.empty())
      row.status = RowStatus::failed;
    results.rows.push_back(std::move(row));
  }
  std::map<std::string, std::vector<double>> limits;
  for (const TimedVisit& visit : journal.visits) {
    if (visit.id != "limits")
      continue;
    for (const auto& [name, rate] : visit.seconds)
      limits[name].push_back(rate);
  }
  for (const char* name : {"untextured", "textured", "classified"}) {
    if (limits.count(name) != 0)
      results.limits.emplace_back(name, spread_of(limits[name]));
  }
  return results;
}

std::vector<Column> columns_of(const StudyResults& results) {
  std::vector<Column> columns;
  std::set<std::string> known;
  const auto add = [&](const std::string& name, bool text = false) {
    if (known.insert(name).second)
      columns.push_back({name, text});
  };
  add("index");
  for (const SweepAxis& axis : results.study.axes) {
    for (const Label& label : axis.values.front().labels)
      add(label.first, true);
  }
  add("status", true);
  for (const std::string& metric : results.study.metrics)
    add(metric);
  for (const Row& row : results.rows) {
    for (const Value& value : row.values)
      add(value.first);
  }
  for (const Row& row : results.rows) {
    for (const auto& [phase, spread] : row.seconds) {
      add(phase + "_s");
      if (phase == "draw") {
        for (const char* what : {"_q1", "_q3", "_min", "_sd", "_n"})
          add("draw_s" + std::string(what));
      }
    }
  }
  const auto any = [&](auto has) { return std::any_of(results.rows.begin(), results.rows.end(), has); };
  if (any([](const Row& row) { return row.rate.has_value(); })) {
    for (const char* name : {"rate", "rate_q1", "rate_q3"})
      add(name);
  }
  if (any([](const Row& row) { return row.processor_rate.has_value(); })) {
    for (const char* name : {"processor_rate", "processor_rate_q1", "processor_rate_q3"})
      add(name);
  }
  for (const char* name : {"changed_rate", "fragments_per_s", "samples_per_s", "of_limit"}) {
    if (any([&](const Row& row) { return derived(results, row, name).has_value(); }))
      add(name);
  }
  for (const PaperValues& paper : results.study.paper)
    add(paper.source);
  for (const char* name : {"renderer", "error"})
    add(name, true);
  return columns;
}

std::optional<double> number_in(const StudyResults& results, const Row& row, const std::string& column) {
  if (column == "index")
    return static_cast<double>(row.combination.index);
  for (const Label& label : row.combination.labels) {
    if (label.first != column)
      continue;
    char* end = nullptr;
    const double value = std::strtod(label.second.c_str(), &end);
    return end != label.second.c_str() && *end == '\0' ? std::optional<double>(value) : std::nullopt;
  }
  if (const auto value = value_named(row.values, column))
    return value;
  if (const auto value = rate_column(row.processor_rate, column, "processor_rate"))
    return value;
  if (const auto value = rate_column(row.rate, column, "rate"))
    return value;
  if (column == "changed_rate" || column == "fragments_per_s" || column == "samples_per_s" ||
      column == "of_limit")
    return derived(results, row, column);
  if (const auto seconds = seconds_column(column)) {
    if (const Spread* spread = spread_named(row.seconds, seconds->first))
      return spread_column(*spread, seconds->second);
  }
  return paper_column(results, row, column);
}

std::string cell(const StudyResults& results, const Row& row, const std::string& column) {
  if (column == "index")
    return std::to_string(row.combination.index);
  for (const Label& label : row.combination.labels) {
    if (label.first == column)
      return label.second;
  }
  if (column == "status")
    return status_text(row.status);
  if (column == "error")
    return row.error;
  const auto text = row.texts.find(column);
  if (text != row.texts.end())
    return text->second;
  const auto number = number_in(results, row, column);
  return number ? number_text(*number) : "";
}

} // namespace slicelens
