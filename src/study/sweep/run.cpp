#include "study/sweep/run.h"

#include "core/errors.h"
#include "image/image_io.h"
#include "image/pictures.h"
#include "study/sweep/estimate.h"
#include "study/sweep/output_folder.h"
#include "study/sweep/visits.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <new>
#include <numeric>
#include <random>
#include <set>
#include <system_error>

namespace slicelens {

namespace {

namespace fs = std::filesystem;

constexpr double heat_scale = 0.1; ///< error that has the last colour of the heat maps
constexpr std::size_t kept_references = 8;

/// The study's identity: everything that its combinations follow from.
std::string study_name(const Study& study) {
  std::string text = study.json;
  for (const BaseScene& scene : study.scenes)
    text += "\n" + scene.text;
  for (const KeyValue& change : study.set)
    text += "\n" + change.key + "=" + change.value;
  if (study.reference && study.reference->scene)
    text += "\n" + study.reference->scene->text;
  return content_name(text);
}

std::string machine_line() {
  const Machine machine = this_machine();
  return machine.processor + ", " + machine.system + ", slicelens " + machine.version + " " + machine.commit;
}

/// What `work` throws, as one line; nothing where all is well.
std::string failure_of(const std::function<void()>& work) {
  try {
    work();
    return "";
  } catch (const Error& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return "out of memory; use a smaller volume or picture";
  }
}

/// Whether half the interval of the median is small enough beside it.
bool is_precise(const std::vector<double>& seconds, double confidence, double precision) {
  const auto interval = median_interval(seconds, confidence);
  return interval && (interval->high - interval->low) / 2 <= precision * median(seconds);
}

/// The work of one call.
class Sweep {
public:
  Sweep(const Study& study, const fs::path& folder, const RunChoice& choice, const Progress& progress)
      : study_(study), folder_(folder), choice_(choice), outer_(progress), progress_(quiet(outer_, said_)),
        combinations_(combinations_of(study)), states_(combinations_.size()), errors_(combinations_.size()) {}

  StudyResults run();
  StudyResults collect_only(const JournalContents& contents);

private:
  bool is_own(const Combination& one) const { return one.index % choice_.shards == choice_.shard - 1; }
  bool is_timed(const Combination& one) const;
  void find_states(bool all);
  std::string reference_identity(const Combination& combination);
  void draw_pictures(Journal& journal);
  void draw_picture(Journal& journal, const Combination& combination);
  const Image& reference_image(const StudyInput& input, const std::string& name);
  void time_rounds(Journal& journal);
  void time_round(Journal& journal, std::size_t round, Estimate& estimate);
  void visit(Journal& journal, std::size_t index, std::size_t round);
  void visit_limits(Journal& journal, std::size_t round);
  std::vector<std::size_t> visited() const;
  bool needs_round(const JournalContents& contents, std::size_t round) const;

  const Study& study_;
  fs::path folder_;
  RunChoice choice_;
  const Progress& outer_;
  std::set<std::string> said_;
  Progress progress_;
  std::vector<Combination> combinations_;
  std::vector<std::optional<CombinationState>> states_;
  std::vector<std::string> errors_;
  Visitor visitor_;
  std::vector<std::pair<std::string, Image>> references_; ///< the one used last comes last
  std::set<std::pair<std::string, std::size_t>> done_;    ///< visits of this shard
};

bool Sweep::is_timed(const Combination& one) const {
  return study_.timing.measure &&
         std::none_of(study_.timing.skip.begin(), study_.timing.skip.end(),
                      [&](const Condition& skip) { return holds(skip, one.labels); });
}

/// Scene and data of what the combination is compared with; empty without a reference.
std::string Sweep::reference_identity(const Combination& combination) {
  std::string text;
  const std::string failure = failure_of([&] {
    if (const auto reference = reference_of(study_, combination))
      text = scene_text_of(*reference) + visitor_.sha256(*reference);
  });
  if (!failure.empty())
    throw UsageError("the reference cannot be drawn: " + failure);
  return text;
}

void Sweep::find_states(bool all) {
  std::set<std::size_t> baselines;
  for (const Combination& one : combinations_) {
    if (is_own(one)) {
      if (const auto baseline = baseline_of(study_, combinations_, one))
        baselines.insert(*baseline);
    }
  }
  std::string metrics;
  for (const std::string& name : study_.metrics)
    metrics += name + " ";
  for (const Combination& one : combinations_) {
    if (!all && !is_own(one) && baselines.count(one.index) == 0)
      continue;
    errors_[one.index] = failure_of([&] {
      const StudyInput input = input_of(study_, one);
      const std::string sha256 = visitor_.sha256(input);
      const std::string scene = scene_text_of(input);
      CombinationState state;
      state.id =
          content_name(label_text(one.labels) + "\n" + scene + "\n" + sha256 + "\n" + one.peer.value_or(""));
      state.of = metrics + reference_identity(one);
      state.of = content_name(state.of);
      states_[one.index] = state;
    });
  }
}

const Image& Sweep::reference_image(const StudyInput& input, const std::string& name) {
  const auto found = std::find_if(references_.begin(), references_.end(),
                                  [&](const auto& entry) { return entry.first == name; });
  if (found != references_.end()) {
    std::rotate(found, found + 1, references_.end());
    return references_.back().second;
  }
  if (references_.size() >= kept_references)
    references_.erase(references_.begin());
  try {
    references_.emplace_back(name, visitor_.draw(input, std::nullopt, progress_).image);
  } catch (const Error& error) {
    throw UsageError("the reference cannot be drawn: " + std::string(error.what()));
  }
  return references_.back().second;
}

void Sweep::draw_picture(Journal& journal, const Combination& combination) {
  const CombinationState& state = *states_[combination.index];
  Quality quality{state.id, state.of, {}, {}};
  Image picture;
  const Image* reference = nullptr;
  std::string reference_name;
  errors_[combination.index] = failure_of([&] {
    const StudyInput input = input_of(study_, combination);
    Shown compared_with;
    if (const auto reference_input = reference_of(study_, combination)) {
      reference_name = content_name(scene_text_of(*reference_input) + visitor_.sha256(*reference_input));
      reference = &reference_image(*reference_input, reference_name);
      compared_with = {reference, background_of(*reference_input)};
    }
    DrawnPicture drawn = visitor_.draw(input, combination.peer, progress_);
    quality.values = measure_quality(study_.metrics, visitor_.prepared(input, progress_),
                                     {&drawn.image, background_of(input)}, compared_with);
    quality.values.insert(quality.values.end(), drawn.counts.begin(), drawn.counts.end());
    quality.texts = drawn.texts;
    picture = std::move(drawn.image);
  });
  if (!errors_[combination.index].empty())
    return;
  quality.texts["picture"] = "pictures/" + state.id + ".png";
  write_image(picture, folder_ / quality.texts["picture"], PixelDepth::png8);
  if (reference != nullptr) {
    quality.texts["reference"] = "references/" + reference_name + ".png";
    if (!fs::exists(folder_ / quality.texts["reference"]))
      write_image(*reference, folder_ / quality.texts["reference"], PixelDepth::png8);
    quality.texts["heat_map"] = "pictures/" + state.id + "-heat.png";
    Image map = heat_map(picture, *reference, heat_scale);
    write_image(map, folder_ / quality.texts["heat_map"], PixelDepth::png8);
  }
  journal.add(quality);
}

void Sweep::draw_pictures(Journal& journal) {
  std::map<std::string, std::string> measured;
  for (const Quality& quality : journal.contents().qualities)
    measured[quality.id] = quality.of;
  std::vector<const Combination*> todo;
  for (const Combination& one : combinations_) {
    const auto& state = states_[one.index];
    if (!is_own(one) || !state)
      continue;
    const auto found = measured.find(state->id);
    if (found == measured.end() || found->second != state->of)
      todo.push_back(&one);
  }
  Estimate estimate(outer_, "picture", todo.size());
  for (const Combination* one : todo) {
    draw_picture(journal, *one);
    estimate.step();
  }
}

/// Own combinations that are timed, and the baselines of others that they need.
std::vector<std::size_t> Sweep::visited() const {
  std::set<std::size_t> indices;
  for (const Combination& one : combinations_) {
    if (!is_own(one) || !is_timed(one) || !states_[one.index] || !errors_[one.index].empty())
      continue;
    indices.insert(one.index);
    const auto baseline = baseline_of(study_, combinations_, one);
    if (baseline && states_[*baseline] && errors_[*baseline].empty())
      indices.insert(*baseline);
  }
  return {indices.begin(), indices.end()};
}

void Sweep::visit(Journal& journal, std::size_t index, std::size_t round) {
  const Combination& one = combinations_[index];
  TimedVisit entry{states_[index]->id, choice_.shard, round, {}};
  errors_[index] = failure_of([&] {
    const auto baseline = study_.timing.beside ? baseline_of(study_, combinations_, one) : std::nullopt;
    if (baseline && *baseline != index && states_[*baseline]) {
      const Combination& other = combinations_[*baseline];
      for (const auto& [phase, seconds] :
           visitor_.time(input_of(study_, other), other.peer, study_.timing, progress_)) {
        if (phase == "draw" || phase == "draw_processor")
          entry.seconds.emplace_back("baseline_" + phase, seconds);
      }
    }
    const Seconds own = visitor_.time(input_of(study_, one), one.peer, study_.timing, progress_);
    entry.seconds.insert(entry.seconds.begin(), own.begin(), own.end());
  });
  if (errors_[index].empty())
    journal.add(entry);
}

void Sweep::visit_limits(Journal& journal, std::size_t round) {
  TimedVisit entry{"limits", choice_.shard, round, {}};
  const std::string failure = failure_of(
      [&] { entry.seconds = visitor_.time_limits(input_of(study_, combinations_[visited().front()])); });
  if (failure.empty())
    journal.add(entry);
  else
    report_warning(outer_, "the machine's fill rates were not measured: " + failure);
}

void Sweep::time_round(Journal& journal, std::size_t round, Estimate& estimate) {
  constexpr std::size_t limits = static_cast<std::size_t>(-1);
  std::vector<std::size_t> order = visited();
  if (study_.timing.limits && !order.empty())
    order.push_back(limits);
  // Fisher and Yates by hand: std::shuffle's order differs between libraries.
  std::mt19937_64 random(study_.timing.seed + 1000003 * round);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[random() % i]);
  for (const std::size_t index : order) {
    const std::string id = index == limits ? "limits" : states_[index]->id;
    if (done_.count({id, round}) == 0) {
      if (index == limits)
        visit_limits(journal, round);
      else if (errors_[index].empty())
        visit(journal, index, round);
    }
    estimate.step();
  }
}

bool Sweep::needs_round(const JournalContents& contents, std::size_t round) const {
  if (round < study_.timing.rounds)
    return true;
  if (round >= study_.timing.most_rounds || study_.timing.precision <= 0)
    return false;
  std::map<std::string, std::vector<double>> draws;
  for (const TimedVisit& visit : contents.visits) {
    for (const auto& [phase, seconds] : visit.seconds) {
      if (phase == "draw" && visit.shard == choice_.shard)
        draws[visit.id].push_back(seconds);
    }
  }
  return std::any_of(draws.begin(), draws.end(), [&](const auto& one) {
    return !is_precise(one.second, study_.timing.confidence, study_.timing.precision);
  });
}

void Sweep::time_rounds(Journal& journal) {
  for (const TimedVisit& visit : journal.contents().visits) {
    if (visit.shard == choice_.shard)
      done_.insert({visit.id, visit.round});
  }
  const std::size_t each = visited().size() + (study_.timing.limits ? 1 : 0);
  Estimate estimate(outer_, "timing", each * study_.timing.rounds);
  for (std::size_t round = 0; needs_round(read_journal(folder_ / "journal.jsonl"), round); ++round)
    time_round(journal, round, estimate);
}

StudyResults Sweep::collect_only(const JournalContents& contents) {
  find_states(true);
  StudyResults results = collect(study_, combinations_, states_, errors_, contents);
  for (Row& row : results.rows) {
    if (states_[row.combination.index])
      row.scene = scene_text_of(input_of(study_, row.combination));
  }
  results.command = choice_.command;
  return results;
}

StudyResults Sweep::run() {
  make_folders(folder_);
  if (choice_.fresh)
    put_aside(folder_ / "journal.jsonl");
  const double load = load_average();
  Journal journal(folder_ / "journal.jsonl", {study_name(study_), machine_line()});
  find_states(false);
  draw_pictures(journal);
  if (study_.timing.measure)
    time_rounds(journal);
  const std::vector<std::string> errors = errors_;
  StudyResults results = collect_only(read_journal(folder_ / "journal.jsonl"));
  for (Row& row : results.rows) {
    const std::string& error = errors[row.combination.index];
    if (error.empty() || !is_own(row.combination))
      continue;
    row.error = error;
    row.status = RowStatus::failed;
  }
  results.load_at_start = load;
  results.load_at_end = load_average();
  return results;
}

} // namespace

StudyResults run_study(const Study& study, const fs::path& folder, const RunChoice& choice,
                       const Progress& progress) {
  if (choice.shards < 1 || choice.shard < 1 || choice.shard > choice.shards)
    throw UsageError("--shard " + std::to_string(choice.shard) + "/" + std::to_string(choice.shards) +
                     " is not valid; give i/n with i from 1 to n");
  StudyResults results = Sweep(study, folder, choice, progress).run();
  write_results(results, folder);
  return results;
}

StudyResults merge_studies(const Study& study, const std::vector<fs::path>& parts, const fs::path& folder,
                           const std::string& command, const Progress& progress) {
  std::vector<fs::path> journals;
  for (const fs::path& part : parts) {
    journals.push_back(part / "journal.jsonl");
    if (read_journal(journals.back()).header.study != study_name(study))
      throw FileError(part.string(),
                      "holds no results of this study, or of it before it was edited; name the "
                      "folders that its shards wrote");
  }
  make_folders(folder);
  join_journals(journals, folder / "journal.jsonl");
  for (const fs::path& part : parts)
    copy_pictures(part, folder);
  RunChoice choice;
  choice.command = command;
  StudyResults results =
      Sweep(study, folder, choice, progress).collect_only(read_journal(folder / "journal.jsonl"));
  write_results(results, folder);
  return results;
}

} // namespace slicelens
