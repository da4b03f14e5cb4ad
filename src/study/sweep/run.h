// Measuring a study: every combination drawn and compared, then timed in rounds; what is measured stays.
#pragma once

#include "core/progress.h"
#include "study/sweep/results.h"

#include <filesystem>
#include <vector>

namespace slicelens {

struct RunChoice {
  std::size_t shard = 1; ///< of `shards`: measures the combinations whose index modulo shards is shard − 1
  std::size_t shards = 1;
  bool fresh = false;  ///< put an earlier journal aside as journal-1.jsonl … and start over
  std::string command; ///< as the user gave it, for the results
};

/// Measures what the folder's journal does not hold yet and writes study.json, results.csv, results.json,
/// report.html, pictures/ and references/ into `folder`, which is made where it is missing. A combination
/// that fails does not stop the others: its row says why. Progress: stages "picture 3/60, 2 min left" and
/// "timing 3/60, 2 min left". Throws UsageError for shards out of range, FileError where the folder cannot be
/// written or the disk is full (what was measured before is kept).
StudyResults run_study(const Study& study, const std::filesystem::path& folder, const RunChoice& choice,
                       const Progress& progress);

/// Joins folders of the study's shards into `folder`, which holds the same files afterwards as if one program
/// had measured all. Combinations that no part has are missing. Throws FileError where a part holds no
/// results of this study.
StudyResults merge_studies(const Study& study, const std::vector<std::filesystem::path>& parts,
                           const std::filesystem::path& folder, const std::string& command,
                           const Progress& progress);

} // namespace slicelens
