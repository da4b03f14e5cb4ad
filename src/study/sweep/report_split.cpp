#include "study/sweep/report_split.h"

#include "core/text.h"
#include "study/sweep/report_charts.h"
#include "study/sweep/report_parts.h"
#include "study/sweep/study_json.h"

#include <algorithm>
#include <set>

namespace slicelens::report {

namespace {

std::string label_in(const Row& row, const std::string& column) {
  for (const Label& label : row.combination.labels) {
    if (label.first == column)
      return label.second;
  }
  return "";
}

} // namespace

std::optional<double> axis_number(const StudyResults& results, const Row& row, const std::string& column) {
  if (const auto number = number_in(results, row, column))
    return number;
  const auto json = study_json::Json::parse(label_in(row, column), nullptr, false);
  if (!json.is_array() || json.empty() || !json.front().is_number())
    return std::nullopt;
  const bool same =
      std::all_of(json.begin(), json.end(), [&](const auto& one) { return one == json.front(); });
  return same ? std::optional<double>(json.front().get<double>()) : std::nullopt;
}

Names labels_of(const Row& row, const Names& columns) {
  Names labels;
  for (const std::string& column : columns)
    labels.push_back(label_in(row, column));
  return labels;
}

std::vector<Names> tuples(const Rows& rows, const Names& columns) {
  std::vector<Names> all;
  std::set<Names> known;
  for (const Row* row : rows) {
    Names labels = labels_of(*row, columns);
    if (known.insert(labels).second)
      all.push_back(std::move(labels));
  }
  return all;
}

std::string tuple_text(const Names& columns, const Names& labels) {
  std::string text;
  for (std::size_t i = 0; i < columns.size(); ++i)
    text += (i == 0 ? "" : ", ") + columns[i] + " " + labels[i];
  return text;
}

Names texts_first(const StudyResults& results, Names columns) {
  std::stable_partition(columns.begin(), columns.end(), [&](const std::string& column) {
    return !std::all_of(results.rows.begin(), results.rows.end(),
                        [&](const Row& row) { return axis_number(results, row, column).has_value(); });
  });
  return columns;
}

Names other_columns(const StudyResults& results, const Rows& rows, const std::string& x) {
  Names others;
  for (const SweepAxis& axis : results.study.axes) {
    Names columns;
    for (const Label& label : axis.values.front().labels)
      columns.push_back(label.first);
    const bool own = contains(columns, x);
    if (own && tuples(rows, columns).size() == tuples(rows, {x}).size())
      continue;
    for (const std::string& column : columns) {
      const bool follows = own && axis_number(results, *rows.front(), column).has_value();
      if (column != x && !follows && tuples(rows, {column}).size() > 1)
        others.push_back(column);
    }
  }
  return texts_first(results, others);
}

namespace {

/// Leaves the rows with the first value of each column that has no place.
void hold(Split& split, const std::string& column) {
  const std::string value = label_in(*split.rows.front(), column);
  const std::size_t all = tuples(split.rows, {column}).size();
  Rows kept;
  for (const Row* row : split.rows) {
    if (label_in(*row, column) == value)
      kept.push_back(row);
  }
  split.rows = std::move(kept);
  split.notes.push_back("Drawn for " + column + " = " + value + " only, one of its " + std::to_string(all) +
                        " values; the tables have the others.");
}

void keep_first(Split& split, const Names& columns, std::size_t most, const std::string& what) {
  std::vector<Names> all = tuples(split.rows, columns);
  if (all.size() <= most)
    return;
  split.notes.push_back("Drawn are the first " + std::to_string(most) + " of " + std::to_string(all.size()) +
                        " " + what + " (" + join(columns) + "); the tables have the others.");
  all.resize(most);
  const std::set<Names> kept(all.begin(), all.end());
  split.rows.erase(std::remove_if(split.rows.begin(), split.rows.end(),
                                  [&](const Row* row) { return kept.count(labels_of(*row, columns)) == 0; }),
                   split.rows.end());
}

} // namespace

Split split_of(const Rows& rows, const Names& columns, const Names& wanted) {
  Split split;
  split.rows = rows;
  Names left;
  for (const std::string& column : columns) {
    Names more = split.series;
    more.push_back(column);
    const bool fits = wanted.empty() ? tuples(rows, more).size() <= most_series : contains(wanted, column);
    if (fits)
      split.series = more;
    else
      left.push_back(column);
  }
  if (split.series.empty() && !left.empty()) {
    split.series = {left.front()};
    left.erase(left.begin());
  }
  for (const std::string& column : left) {
    Names more = split.panels;
    more.push_back(column);
    if (tuples(rows, more).size() <= most_panels)
      split.panels = more;
    else
      hold(split, column);
  }
  keep_first(split, split.series, most_series, "lines");
  return split;
}

} // namespace slicelens::report
