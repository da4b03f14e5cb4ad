// The studies that come with the program: nothing is drawn here.
#include "catch.h"
#include "core/files.h"
#include "study/metrics.h"
#include "study/sweep/combinations.h"
#include "study/sweep/study.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace slicelens;
namespace fs = std::filesystem;

namespace {

const fs::path& folder() {
  static const fs::path path = fs::path(SLICELENS_SOURCE_DIR) / "studies";
  return path;
}

std::vector<fs::path> study_files() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() == ".json")
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Columns that results may have (study/sweep/results.h, visits.h), beside what varies, metrics and papers.
std::set<std::string> known_columns(const Study& study) {
  std::set<std::string> known = {
      "slices",     "triangles",   "draw_calls",     "fragments",    "samples",       "texture_bytes",
      "peak_bytes", "upload_s",    "slice_s",        "tessellate_s", "deform_s",      "draw_s",
      "read_s",     "rate",        "processor_rate", "changed_rate", "samples_per_s", "fragments_per_s",
      "of_limit",   "brick_parts", "bricks_loaded",  "read_bytes"};
  known.insert(study.metrics.begin(), study.metrics.end());
  for (const SweepAxis& axis : study.axes) {
    for (const Label& label : axis.values.front().labels)
      known.insert(label.first);
  }
  for (const PaperValues& paper : study.paper)
    known.insert(paper.source);
  return known;
}

Study read(const fs::path& file, bool quick) {
  StudyChoice choice;
  choice.quick = quick;
  return read_study(file, choice);
}

} // namespace

TEST_CASE("every shipped study and its quick form names scenes that are accepted") {
  const std::vector<fs::path> files = study_files();
  CHECK(files.size() >= 15);
  for (const fs::path& file : files) {
    for (const bool quick : {false, true}) {
      CAPTURE(file.string(), quick);
      const Study study = read(file, quick);
      const std::vector<Combination> all = combinations_of(study);
      // More rows than that nobody reads, nor waits for in the quick form.
      CHECK(all.size() >= 5);
      CHECK(all.size() <= (quick ? 130U : 800U));
      for (const Combination& combination : all) {
        CAPTURE(label_text(combination.labels));
        CHECK_NOTHROW((void)input_of(study, combination));
        CHECK_NOTHROW((void)reference_of(study, combination));
        if (!study.timing.baseline.empty())
          CHECK(baseline_of(study, all, combination).has_value());
      }
    }
  }
}

TEST_CASE("every shipped study says what it shows, in columns that there are") {
  for (const fs::path& file : study_files()) {
    CAPTURE(file.string());
    const Study study = read(file, false);
    CHECK_FALSE(study.title.empty());
    CHECK(study.text.size() > 200);
    CHECK(read_text(file).find("\"quick\"") != std::string::npos);
    const std::set<std::string> known = known_columns(study);
    CHECK_FALSE(study.columns.empty());
    for (const std::string& column : study.columns) {
      CAPTURE(column);
      CHECK(known.count(column) == 1);
    }
    for (const StudyChart& chart : study.charts) {
      CAPTURE(chart.title);
      CHECK(known.count(chart.x) == 1);
      CHECK(known.count(chart.y) == 1);
    }
    for (const PaperValues& paper : study.paper)
      CHECK(known.count(paper.quantity) == 1);
  }
}

TEST_CASE("the quick form differs from the whole study") {
  for (const fs::path& file : study_files()) {
    CAPTURE(file.string());
    CHECK(read(file, false).json != read(file, true).json);
  }
}

TEST_CASE("the papers' fractions are those of the frames a second that they print") {
  const std::map<std::string, std::vector<double>> printed = {
      {"lamar-table3", {4.8 / 5.9, 4.6 / 5.9, 4.4 / 5.9, 4.3 / 5.9, 3.9 / 5.9, 3.6 / 5.9}},
      {"cohen-frame-rates", {18.0 / 43}},
      {"brunet-table1", {29.2 / 39, 29.0 / 39, 21.7 / 39}},
      {"brunet-table2", {1, 7.12 / 12.25, 6.57 / 12.25, 3.71 / 6.57, 3.55 / 6.57}},
      {"brunet-table3", {6.19 / 7.12, 1.63 / 7.12, 3.96 / 3.71, 1.41 / 3.71}}};
  for (const auto& [name, fractions] : printed) {
    CAPTURE(name);
    const Study study = read(folder() / (name + ".json"), false);
    const std::vector<Combination> all = combinations_of(study);
    REQUIRE(study.paper.size() == 1);
    REQUIRE(study.paper[0].values.size() == fractions.size());
    for (std::size_t i = 0; i < fractions.size(); ++i) {
      const auto& [when, value] = study.paper[0].values[i];
      CHECK(std::abs(value - fractions[i]) <= 0.0005); // three decimals stand in the file
      const bool shown =
          std::any_of(all.begin(), all.end(), [&, &condition = when](const Combination& combination) {
            return holds(condition, combination.labels);
          });
      CHECK(shown);
    }
  }
}
