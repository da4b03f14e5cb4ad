#include "console.h"
#include "core/errors.h"
#include "options.h"
#include "study/sweep/run.h"

#include <cstdio>
#include <filesystem>

namespace slicelens::cli {

namespace {

namespace fs = std::filesystem;

/// "2/4": the second of four.
void take_shard(const std::string& text, RunChoice& choice) {
  std::size_t i = 0;
  std::size_t n = 0;
  int used = 0;
  const bool is_shard = std::sscanf(text.c_str(), "%zu/%zu%n", &i, &n, &used) == 2 &&
                        static_cast<std::size_t>(used) == text.size() && text.find('-') == std::string::npos;
  if (!is_shard || n < 1 || i < 1 || i > n)
    throw UsageError("--shard " + text + " is not valid; give i/n with i from 1 to n, for instance 2/4");
  choice.shard = i;
  choice.shards = n;
}

std::string command_line(const StudyOptions& options) {
  std::string text = "slicelens study " + options.input;
  for (const std::string& change : options.set)
    text += " --set '" + change + "'";
  if (options.quick)
    text += " --quick";
  if (!options.shard.empty())
    text += " --shard " + options.shard;
  for (const std::string& part : options.merge)
    text += " --merge " + part;
  return text + " -o " + options.output;
}

/// Says what did not work; returns how many rows.
std::size_t report_failures(const StudyResults& results, bool whole) {
  std::size_t count = 0;
  for (const Row& row : results.rows) {
    const bool failed = row.status == RowStatus::failed;
    const bool missing = whole && row.status == RowStatus::missing;
    if (!failed && !missing)
      continue;
    ++count;
    const std::string labels = label_text(row.combination.labels);
    std::fprintf(stderr, "slicelens: combination %zu%s: %s\n", row.combination.index,
                 labels.empty() ? "" : (" (" + labels + ")").c_str(),
                 failed ? row.error.c_str() : "was not measured; run the study, or its other shards");
  }
  return count;
}

} // namespace

void run_study_command(const StudyOptions& options) {
  StudyChoice study_choice;
  study_choice.quick = options.quick;
  for (const std::string& text : options.set)
    study_choice.set.push_back(parse_assignment(text));
  const Study study = read_study(options.input, study_choice);
  const fs::path folder = options.output.empty() ? fs::path(study.name) : fs::path(options.output);
  RunChoice choice;
  choice.fresh = options.fresh;
  StudyOptions said = options;
  said.output = folder.string();
  choice.command = command_line(said);
  if (!options.shard.empty())
    take_shard(options.shard, choice);
  if (!options.merge.empty() && (!options.shard.empty() || options.fresh))
    throw UsageError("--merge joins what was measured; it goes without --shard and --fresh");
  const Progress progress = console_progress();
  const std::vector<fs::path> parts(options.merge.begin(), options.merge.end());
  const StudyResults results = parts.empty() ? run_study(study, folder, choice, progress)
                                             : merge_studies(study, parts, folder, choice.command, progress);
  end_progress();
  const std::size_t failures = report_failures(results, choice.shards == 1);
  std::printf("%s\n", (folder / "report.html").string().c_str());
  if (failures > 0)
    throw FileError(folder.string(), std::to_string(failures) + " of " + std::to_string(results.rows.size()) +
                                         " combinations have no result; the others are kept");
}

} // namespace slicelens::cli
