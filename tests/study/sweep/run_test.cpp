// Whole studies of small pictures: what they write, going on after a stop, shards, failures.
#include "catch.h"
#include "core/errors.h"
#include "core/files.h"
#include "image/image_io.h"
#include "study/metrics.h"
#include "study/sweep/run.h"
#include "temporary_folder.h"

#include <algorithm>
#include <set>

using namespace slicelens;

namespace {

const char* const study_text = R"({
  "scene": {"volume": {"phantom": "ball", "size": [16, 16, 16]}, "render": {"size": [32, 32], "target": "rgba32f"}},
  "vary": {"render.spacing": [2, 1], "render.pipeline": ["slices", "rays", "reference"]},
  "reference": {"set": {"render.pipeline": "reference", "render.spacing": 0.25}},
  "metrics": ["psnr", "max_abs", "over_2_255"],
  "timing": {"rounds": 2, "baseline": {"render.pipeline": "slices"}, "limits": false}})";

Study study(const std::string& text = study_text) { return study_from_json(text, "test.json", "."); }

RunChoice shard(std::size_t i, std::size_t n) {
  RunChoice choice;
  choice.shard = i;
  choice.shards = n;
  return choice;
}

/// The table without what differs from run to run.
std::string table(const StudyResults& results) {
  std::string text;
  for (const Column& column : columns_of(results)) {
    const std::string& name = column.name;
    const bool varies = name.find("_s") != std::string::npos || name.find("rate") != std::string::npos ||
                        name == "of_limit" || name == "peak_bytes";
    if (varies)
      continue;
    text += name + ":";
    for (const Row& row : results.rows)
      text += " " + cell(results, row, name);
    text += "\n";
  }
  return text;
}

bool all_done(const StudyResults& results) {
  return std::all_of(results.rows.begin(), results.rows.end(),
                     [](const Row& row) { return row.status == RowStatus::done; });
}

} // namespace

TEST_CASE("a study measures every combination and writes its table and pictures", "[one-driver]") {
  const TemporaryFolder folder;
  const StudyResults results = run_study(study(), folder / "out", {}, {});
  REQUIRE(results.rows.size() == 6);
  REQUIRE(all_done(results));
  for (const Row& row : results.rows) {
    const auto draw = std::find_if(row.seconds.begin(), row.seconds.end(),
                                   [](const auto& one) { return one.first == "draw"; });
    REQUIRE(draw->second.values.size() == 2);
    REQUIRE(row.rate.has_value());
    // The pictures on the disk have the metrics of the table to the 8 bits that PNG holds: errors of half a
    // step on either side.
    const Image picture = read_image(folder / "out" / row.texts.at("picture"));
    const Image reference = read_image(folder / "out" / row.texts.at("reference"));
    REQUIRE(*number_in(results, row, "max_abs") ==
            Approx(compare_images(picture, reference).max_abs).margin(1.01 / 255));
  }
  // Slices and rays take the same samples in an orthographic view (docs/accuracy.md).
  REQUIRE(*number_in(results, results.rows[0], "fragments") ==
          Approx(*number_in(results, results.rows[1], "samples")).epsilon(0.02));
  REQUIRE(read_text(folder / "out" / "results.csv") == results_csv(results));
  const std::string json = read_text(folder / "out" / "results.json");
  for (const char* key :
       {"\"GL_RENDERER\"", "\"GL_VERSION\"", "\"commit\"", "\"processor\"", "\"study\"", "\"scene\""}) {
    INFO(key);
    REQUIRE(json.find(key) != std::string::npos);
  }
  const std::string report = read_text(folder / "out" / "report.html");
  for (const Row& row : results.rows)
    REQUIRE(report.find("\"" + row.texts.at("picture") + "\"") != std::string::npos);
}

TEST_CASE("an interrupted study goes on, shards join, and both give the table of an uninterrupted one",
          "[one-driver]") {
  const TemporaryFolder folder;
  const std::string whole = table(run_study(study(), folder / "whole", {}, {}));
  // Stopped in the middle of an entry.
  const std::string journal = read_text(folder / "whole" / "journal.jsonl");
  for (const double share : {0.3, 0.8}) {
    INFO(share);
    std::filesystem::create_directories(folder / "part");
    const auto length = static_cast<std::size_t>(share * static_cast<double>(journal.size()));
    write_text_atomically(folder / "part" / "journal.jsonl", journal.substr(0, length));
    const StudyResults resumed = run_study(study(), folder / "part", {}, {});
    REQUIRE(all_done(resumed));
    REQUIRE(table(resumed) == whole);
    // What was measured before is still there, byte for byte.
    const std::string kept = journal.substr(0, journal.rfind('\n', length - 1) + 1);
    REQUIRE(read_text(folder / "part" / "journal.jsonl").rfind(kept, 0) == 0);
  }
  std::vector<std::filesystem::path> parts;
  for (std::size_t i = 1; i <= 3; ++i) {
    parts.push_back(folder / ("shard" + std::to_string(i)));
    const StudyResults one = run_study(study(), parts.back(), shard(i, 3), {});
    REQUIRE(std::count_if(one.rows.begin(), one.rows.end(),
                          [](const Row& row) { return row.status == RowStatus::done; }) >= 2);
  }
  const StudyResults merged = merge_studies(study(), parts, folder / "merged", "", {});
  REQUIRE(all_done(merged));
  REQUIRE(table(merged) == whole);
  for (const Row& row : merged.rows) {
    REQUIRE(row.rate.has_value());
    REQUIRE(std::filesystem::exists(folder / "merged" / row.texts.at("picture")));
  }
  parts.pop_back();
  const StudyResults incomplete = merge_studies(study(), parts, folder / "incomplete", "", {});
  REQUIRE_FALSE(all_done(incomplete));
}

TEST_CASE("a combination that fails does not stop the others", "[one-driver]") {
  const TemporaryFolder folder;
  const StudyResults results = run_study(study(R"({
    "scene": {"volume": {"phantom": "ball", "size": [16, 16, 16]}, "render": {"size": [32, 32]}},
    "vary": [{"name": "what", "cases": {"plain": {},
      "twist by tables": {"warp": {"kind": "twist"}, "render.pipeline": "axis"},
      "no such file": {"volume.file": "nothing_here.nrrd"}}}],
    "timing": {"rounds": 1}})"),
                                         folder / "out", {}, {});
  REQUIRE(results.rows[0].status == RowStatus::done);
  REQUIRE(results.rows[1].status == RowStatus::failed);
  REQUIRE(results.rows[1].error.find("twist") != std::string::npos);
  REQUIRE(results.rows[2].status == RowStatus::failed);
  REQUIRE(results.rows[2].error.find("nothing_here.nrrd") != std::string::npos);
}

TEST_CASE("a reference that fails is named, and pictures without it are not lost", "[one-driver]") {
  const TemporaryFolder folder;
  const std::string text = R"({
    "scene": {"volume": {"phantom": "ball", "size": [16, 16, 16]}, "render": {"size": [32, 32]}},
    "vary": {"render.spacing": [2, 1]},
    "reference": {"scene": {"volume": {"file": "nothing_here.nrrd"}}}, "timing": false})";
  const StudyResults results = run_study(study(text), folder / "out", {}, {});
  for (const Row& row : results.rows) {
    REQUIRE(row.status == RowStatus::failed);
    REQUIRE(row.error.find("nothing_here.nrrd") != std::string::npos);
  }
}

TEST_CASE("timing orders differ from round to round and repeat with the seed", "[one-driver]") {
  const TemporaryFolder folder;
  const auto order = [&](const std::string& name, const std::string& seed) {
    (void)run_study(
        study(R"({"scene": {"volume": {"phantom": "ball", "size": [8, 8, 8]}, "render": {"size": [8, 8]}},
      "vary": {"camera.azimuth": [0, 10, 20, 30, 40, 50]}, "timing": {"rounds": 2, "limits": false, "seed": )" +
              seed + "}}"),
        folder / name, {}, {});
    std::vector<std::string> ids;
    for (const TimedVisit& visit : read_journal(folder / name / "journal.jsonl").visits)
      ids.push_back(visit.id);
    return ids;
  };
  const std::vector<std::string> first = order("a", "1");
  REQUIRE(first == order("b", "1"));
  REQUIRE(first != order("c", "2"));
  REQUIRE(first.size() == 12);
  REQUIRE(std::set<std::string>(first.begin(), first.begin() + 6).size() == 6);
  REQUIRE_FALSE(std::equal(first.begin(), first.begin() + 6, first.begin() + 6));
}

TEST_CASE("folders and shards that cannot be are refused") {
  const TemporaryFolder folder;
  REQUIRE_THROWS_AS(run_study(study(), folder / "x", shard(3, 2), {}), UsageError);
  const auto file = folder.put("file", "text");
  REQUIRE_THROWS_AS(run_study(study(), file / "below", {}, {}), FileError);
  REQUIRE_THROWS_AS(merge_studies(study(), {folder / "none"}, folder / "merged", "", {}), FileError);
}

TEST_CASE("2D lenses are compared and timed as volumes are", "[one-driver]") {
  const TemporaryFolder folder;
  const StudyResults results = run_study(study(R"({
    "scene": {"image": {"testcard": {"size": [64, 64]}}, "render": {"target": "rgba32f", "filter": "linear-exact"}},
    "vary": {"render.pipeline": ["fragment", "lookup", "reference"]},
    "reference": {"set": {"render.pipeline": "reference"}}, "metrics": ["psnr"],
    "timing": {"rounds": 2, "batch": 3, "baseline": {"render.pipeline": "fragment"}}})"),
                                         folder / "out", {}, {});
  REQUIRE(all_done(results));
  REQUIRE_FALSE(number_in(results, results.rows[2], "psnr").has_value()); // equal
  // The formula at each fragment, against the same in doubles: floats of 24 bits (docs/tolerances.md).
  REQUIRE(*number_in(results, results.rows[0], "psnr") > 80);
  REQUIRE(results.rows[1].rate->values.size() == 2);
}

TEST_CASE("a warp's own phase is timed where there is a warp", "[one-driver]") {
  const TemporaryFolder folder;
  const Study small = study(R"({"scene": {"volume": {"phantom": "ball", "size": [8, 8, 8]},
      "render": {"pipeline": "fragment", "size": [8, 8]}},
    "vary": [{"name": "warp", "cases": {"none": {}, "landmarks": {"warp": {"kind": "landmarks", "space": "texture", "method": "bspline",
      "pairs": [[[0.3, 0.3, 0.3], [0.35, 0.3, 0.3]], [[0.7, 0.7, 0.6], [0.7, 0.65, 0.6]]]}}}}],
    "timing": {"rounds": 1, "limits": false}})");
  const StudyResults results = run_study(small, folder / "out", {}, {});
  REQUIRE(all_done(results));
  REQUIRE_FALSE(number_in(results, results.rows[0], "deform_s").has_value());
  REQUIRE(*number_in(results, results.rows[1], "deform_s") > 0);
  REQUIRE(*number_in(results, results.rows[1], "changed_rate") < 1);
}
