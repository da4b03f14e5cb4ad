// The results of a study as plain values, and as CSV and JSON.
#pragma once

#include "study/statistics.h"
#include "study/sweep/combinations.h"
#include "study/sweep/journal.h"
#include "study/sweep/machine.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace slicelens {

/// Repeated measurements in the order of their rounds.
struct Spread {
  std::vector<double> values;
  Quartiles quartiles;
  double least = 0;
  std::optional<double> deviation; ///< sample standard deviation; nothing for a single value
};
Spread spread_of(std::vector<double> values);

enum class RowStatus {
  done,
  failed, ///< `error` says why
  missing ///< not measured: another shard's, or the study was stopped
};

/// One combination.
struct Row {
  Combination combination;
  std::string id;    ///< names its pictures; empty where its scene is refused
  std::string scene; ///< the whole scene as JSON; empty where it is refused
  RowStatus status = RowStatus::missing;
  std::string error;
  std::vector<Value> values; ///< metrics and counts
  std::map<std::string, std::string> texts;
  std::vector<std::pair<std::string, Spread>> seconds; ///< by phase
  std::optional<std::size_t> baseline;                 ///< index of its row
  /// Baseline's time by its own (1 for the baseline; the paper's "fraction of the frame rate"), round by
  /// round.
  std::optional<Spread> rate;
  std::optional<Spread> processor_rate;     ///< the same of processor time
  std::vector<std::optional<double>> paper; ///< of each of Study::paper
};

struct StudyResults {
  Study study;
  Machine machine;
  std::vector<Row> rows; ///< of every combination, in their order
  std::vector<std::pair<std::string, Spread>>
      limits;          ///< fragments a second: untextured, textured, classified
  std::string command; ///< that made them
  double load_at_start = -1;
  double load_at_end = -1;
};

/// What the identity of a combination depends on: where any of it changes it is measured again.
struct CombinationState {
  std::string id; ///< of the scene with all its keys, the volumes' hashes and the peer
  std::string of; ///< of the reference and the metrics
};

/// Puts journal entries to the combinations. `states` and `errors` (empty: none) are by index.
StudyResults collect(const Study& study, const std::vector<Combination>& combinations,
                     const std::vector<std::optional<CombinationState>>& states,
                     const std::vector<std::string>& errors, const JournalContents& journal);

/// A column of the table: varied labels, metrics, counts, times.
struct Column {
  std::string name;
  bool text = false; ///< else numbers
};

/// All columns that any row has: index, what varies, status, metrics, counts, draw_s … (median, first and
/// third quartile, least, deviation, count for the drawing; medians of the other phases), rate with
/// quartiles, changed_rate (the frame's time at rest by that of deforming, slicing and drawing it),
/// fragments_per_s, of_limit (fragments a second by the machine's classified fill), the papers'
/// values, error.
std::vector<Column> columns_of(const StudyResults& results);

/// What stands in a column; empty for nothing. Numbers in full precision.
std::string cell(const StudyResults& results, const Row& row, const std::string& column);
/// The same as a number; nothing where it is none.
std::optional<double> number_in(const StudyResults& results, const Row& row, const std::string& column);

/// RFC 4180 with a heading, lines end in \n.
std::string results_csv(const StudyResults& results);

/// Everything: study, machine, rows with their scenes and all samples, limits.
std::string results_json(const StudyResults& results);

} // namespace slicelens
